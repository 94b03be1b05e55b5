//! Reports on a terminal: the verdict comes first, lines fit 80 columns, and only a terminal gets colours.
//! The number of jobs does not affect the output.

use std::fs;

use assert_cmd::Command;

use super::tools::{Place, listed};

/// Scenarios that agree, a scenario with a wrong published number, and a scenario with a step so coarse that the
/// verdict is inconclusive.
const FILES: [&str; 7] = [
    "crank_rocker",
    "ov7_new_tabulated",
    "five_bar_on_a_spring",
    "n_four_bar_2",
    "compressor_runup",
    "wrong",
    "crank_rocker --dt 2e-2",
];

fn place() -> Place {
    let place = Place::new();
    let edits =
        [("name = \"crank_rocker\"", "name = \"wrong\""), ("_N_m\", value = 17.7778", "_N_m\", value = 17.7781")];
    place.edited("crank_rocker.toml", "wrong.toml", &edits);
    place
}

#[test]
fn short_reports_start_with_the_verdict_and_fit_80_columns() {
    let place = place();
    for file in FILES {
        let (name, options) = file.split_once(' ').unwrap_or((file, ""));
        for how in ["", "--quiet"] {
            let report = place.run(&format!("run scenarios/{name}.toml --no-record {options} {how}")).stdout;
            let word = match (name, options) {
                ("wrong", _) => "DISAGREE",
                (_, "") => "AGREE",
                _ => "INCONCLUSIVE",
            };
            assert!(report.starts_with(&format!("{name}: {word}: ")), "{report}");
            for line in report.lines() {
                assert!(line.chars().count() <= 80, "{file}: {line}");
            }
            assert_eq!(how == "--quiet", report.lines().count() == 1, "{report}");
        }
    }
}

#[test]
fn no_line_ends_with_blanks() {
    let place = Place::new();
    for command in [
        "new",
        "list",
        "list --solvers",
        "list --channels scenarios/crank_rocker.toml",
        "inspect scenarios/ov7_base.toml",
        "inspect scenarios/tangent.toml --range",
        "plan scenarios/quick_return.toml",
        "drive scenarios/crank_rocker.toml --table",
        "bearings scenarios/compressor.toml",
        "clearance scenarios/crankcase.toml",
        "diagram scenarios/crank_rocker.toml --channel point.B.x_m",
        "mutate --list",
        "check scenarios/crank_rocker.toml phi --channel link.crank.angle_rad",
        "run scenarios/pendulum.toml --no-record --verbose --explain --tolerance-scale 0",
    ] {
        let text = place.ok(command);
        let blank = text.lines().find(|line| line.ends_with(' '));
        assert_eq!(blank, None, "{command}");
    }
}

#[test]
fn formula_reports_fit_80_columns() {
    let place = Place::new();
    let mut files: Vec<String> = fs::read_dir(place.path("scenarios/formulas"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    files.sort();
    for file in files.iter().take(8) {
        for how in ["", "--verbose", "--quiet"] {
            let report = place.ok(&format!("check scenarios/formulas/{file} {how}"));
            let name = file.trim_end_matches(".toml");
            assert!(report.starts_with(&format!("{name}: AGREE: ")), "{report}");
            let long: Vec<&str> = report.lines().filter(|line| line.chars().count() > 80).collect();
            assert!(long.is_empty(), "{file}: {long:?}");
        }
    }
    let wrong = place.run("check scenarios/crank_rocker.toml sin(phi)*180/pi --channel link.crank.angle_deg").stdout;
    assert!(wrong.contains("formula 0.99995 deg") && wrong.contains("180.0"), "both values: {wrong}");
    assert!(wrong.lines().all(|line| line.chars().count() <= 80), "{wrong}");
}

/// The short report shows both compared values at the worst instant, with the digits in which they differ.
/// The short report also has everything that the user needs to act.
#[test]
fn a_disagreement_keeps_its_reasons_in_the_short_report() {
    let place = place();
    let short = place.run("run scenarios/wrong.toml --no-record").stdout;
    let header = |text: &str| text.lines().find(|line| line.starts_with("worst channel")).map(str::to_string);
    // All channels agree, so none of them is shown.
    assert_eq!(header(&short), None, "{short}");
    let reason = short.find("reduced_resistance_mean_N_m: 3.2").expect(&short);
    let words: Vec<&str> = short[reason..].split_whitespace().collect();
    assert!(words.join(" ").contains("is beyond the bound 5e-5 N·m"), "{short}");
    assert!(!short.contains("closure of all joints"), "{short}");
    let long = place.run("run scenarios/wrong.toml --no-record --verbose").stdout;
    assert!(long.starts_with(short.lines().next().unwrap()) && long.contains("closure of all joints"), "{long}");

    let open = place.run("run scenarios/crank_rocker.toml --no-record --dt 2e-2").stdout;
    let words = header(&open).unwrap();
    let words: Vec<&str> = words.split_whitespace().collect();
    assert_eq!(words, ["worst", "channel", "at", "deg", "assur", "rapier", "error", "bound", "unit"]);
    let open: Vec<&str> = open.split_whitespace().collect();
    assert!(open.join(" ").contains("choose a smaller time step, such as --dt 1e-2"), "{open:?}");
}

#[test]
fn any_number_of_jobs_prints_the_same_bytes() {
    let place = place();
    let files = "scenarios/five_bar_on_a_spring.toml scenarios/crank_rocker.toml scenarios/none.toml scenarios/wrong.toml scenarios/pendulum.toml";
    let run = |how: &str| place.run(&format!("run {files} --record {how}"));
    let [one, two, many] = ["1 --jobs 1", "2 --jobs 2", "3 --jobs 64"].map(run);
    let text = |outcome: &super::tools::Outcome, own: &str| outcome.stdout.replace(&format!("{own}/"), "");
    assert_eq!(text(&one, "1"), text(&two, "2"));
    assert_eq!(text(&one, "1"), text(&many, "3"));
    assert_eq!([one.code, two.code, many.code], [2; 3]);
    assert_eq!(one.stderr, two.stderr);
    for file in ["five_bar_on_a_spring", "crank_rocker", "wrong", "pendulum"] {
        let [one, two] = ["1", "2"].map(|own| fs::read(place.path(own).join(format!("{file}.mcap"))).unwrap());
        assert!(one == two, "{file}");
    }
    // The report ends with one table for all files.
    let close = one.stdout.split("\nscenario ").nth(1).expect(&one.stdout);
    assert!(close.ends_with("\n\n5 scenarios: 1 error, 1 disagree, 3 agree\n"), "{close}");
    for [name, verdict] in [["wrong", "disagree"], ["scenarios/none.toml", "error"], ["pendulum", "agree"]] {
        let row = close.lines().find(|line| line.starts_with(name)).expect(close);
        assert_eq!(row.split_whitespace().nth(1), Some(verdict), "{row}");
    }
    assert!(one.stdout.lines().all(|line| line.chars().count() <= 80), "{}", one.stdout);
}

/// If a file is given twice and the settings are written to it, the second proof uses the new settings, with any number
/// of jobs.
#[test]
fn settings_are_written_in_the_order_of_the_files() {
    let texts = ["1", "8"].map(|jobs| {
        let place = Place::new();
        let file = "scenarios/crank_rocker.toml";
        let report = place.ok(&format!("run {file} ./{file} --write -v --no-record --jobs {jobs}"));
        assert_eq!(report.matches("settings   found").count(), 1, "{report}");
        (report, fs::read_to_string(place.path(file)).unwrap())
    });
    assert_eq!(texts[0], texts[1]);
}

#[test]
fn colours_are_printed_only_to_a_terminal() {
    let place = place();
    let run = |variables: &[(&str, &str)]| {
        let mut command = Command::cargo_bin("linkproof").unwrap();
        command.current_dir(place.path("")).env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
        command.args(["run", "scenarios/wrong.toml", "scenarios/pendulum.toml", "--no-record"]);
        let output = command.envs(variables.iter().copied()).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let piped = run(&[]);
    assert!(!piped.contains('\u{1b}'), "{piped}");
    assert_eq!(run(&[("NO_COLOR", "1")]), piped);
    let forced = run(&[("CLICOLOR_FORCE", "1")]);
    for word in ["\u{1b}[31mDISAGREE\u{1b}[0m", "\u{1b}[32mAGREE\u{1b}[0m"] {
        assert!(forced.contains(word), "{forced:?}");
    }
    assert!(!run(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]).contains('\u{1b}'));
}

#[test]
fn completions_and_manual_name_every_command() {
    let place = Place::new();
    let help = place.ok("--help");
    let names: Vec<&str> = listed(&help).collect();
    assert!(names.len() > 15 && names.contains(&"run") && names.contains(&"man"), "{names:?}");
    let groups = ["Prove:", "Look:", "Design:", "Study:"].map(|group| help.find(&format!("\n{group}\n")).unwrap());
    assert!(
        groups.is_sorted() && groups[0] < help.find("  run ").unwrap() && help.find("  bench ").unwrap() > groups[3]
    );
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let text = place.ok(&format!("completions {shell}"));
        for name in &names {
            assert!(text.contains(name), "{shell}: {name}");
        }
    }
    let page = place.ok("man");
    place.ok("man -o deep/man1");
    // In a written manual page, a seal (the mark that the program wrote the file) precedes the text.
    let file = fs::read_to_string(place.path("deep/man1/linkproof.1")).unwrap();
    assert_eq!(file.split_once('\n').unwrap().1, page);
    for name in names.iter().filter(|name| **name != "help") {
        assert!(page.contains(&format!("linkproof\\-{name}(1)")), "{name}");
        let own = fs::read_to_string(place.path(&format!("deep/man1/linkproof-{name}.1"))).unwrap();
        assert!(own.contains("Examples:"), "{name}");
    }
    place.refused("completions csh", &["csh"]);
    fs::write(place.path("plain"), "a file").unwrap();
    place.refused("man -o plain/below", &["plain/below", "-o"]);
}

/// No number in a report has a machine format such as `1.0e0`, `-0.000`, or zero with an exponent.
#[test]
fn numbers_have_no_needless_exponent_or_signed_zero() {
    let place = Place::new();
    for command in [
        "run scenarios/crank_rocker.toml --no-record -v",
        "check scenarios/formulas/slider_crank_centric.toml -v",
        "tune scenarios/crank_rocker.toml --within 1e-3 --engine rapier --channel positions",
        "drive scenarios/crank_rocker.toml --table",
        "inspect scenarios/quick_return.toml --range",
        "inspect scenarios/quick_return.toml --modes",
        "inspect scenarios/compressor.toml",
        "bearings scenarios/quick_return.toml",
        "plan scenarios/quick_return.toml --crank-deg 90",
    ] {
        let report = place.ok(command);
        let words = report.split(|sign: char| sign.is_whitespace() || matches!(sign, ',' | ';' | '(' | ')' | ':'));
        for word in words.filter(|word| word.parse::<f64>().is_ok()) {
            let signed_zero = word.starts_with('-') && word.parse::<f64>() == Ok(0.0);
            let exponent = word.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
            let needless = exponent.is_some_and(|exponent| (-3..5).contains(&exponent));
            assert!(!signed_zero && !needless, "{command}: {word}\n{report}");
        }
    }
}
