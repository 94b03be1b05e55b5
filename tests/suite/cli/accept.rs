//! `accept`: stores accepted figures beside a scenario, and reports which figures have changed since then.

use std::collections::BTreeSet;
use std::fs;

use serde_json::Value;

use super::tools::{Outcome, Place, texts};
use crate::common::expected::agrees_with;
use crate::common::{assert_within, shipped};

const FILE: &str = "scenarios/crank_rocker.accepted";
const SCENARIO: &str = "scenarios/crank_rocker.toml";

/// Number of channels of the four-bar.
fn channels() -> usize {
    shipped("crank_rocker.toml").case.channels().len()
}

/// A four-bar without published numbers, so that a changed length does not change its verdict.
/// The figures of this four-bar are accepted.
fn accepted() -> Place {
    let place = Place::new();
    let text = fs::read_to_string(place.path(SCENARIO)).unwrap();
    let text = &text[..text.find("[[oracle]]").unwrap()];
    fs::write(place.path(SCENARIO), text).unwrap();
    let told = place.ok(&format!("accept {SCENARIO}"));
    assert_eq!(told, format!("crank_rocker: accepted, {} channels in {FILE}.\n", channels()));
    place
}

/// Replaces the first occurrence of a text, which must occur.
fn edit(place: &Place, file: &str, old: &str, new: &str) {
    let text = fs::read_to_string(place.path(file)).unwrap();
    assert!(text.contains(old), "{old} is not in {file}");
    fs::write(place.path(file), text.replacen(old, new, 1)).unwrap();
}

fn check(place: &Place) -> Outcome {
    place.run(&format!("accept --check {SCENARIO}"))
}

#[test]
fn the_file_is_text_for_people_and_stays_as_it_is() {
    let place = accepted();
    let text = fs::read_to_string(place.path(FILE)).unwrap();
    let end = text.find("\n[[channels]]\nname = \"link.crank.x_m\"").unwrap();
    agrees_with("tests/suite/cli/accepted.txt", &text[..end], "cli::accept");
    let told = place.ok(&format!("accept --check {SCENARIO}"));
    let all = channels();
    assert_eq!(
        told,
        format!("AGREE: crank_rocker matches the figures accepted in {FILE}, {all} channels within their bounds.\n")
    );
    let told = place.ok(&format!("accept {SCENARIO}"));
    assert_eq!(told, format!("crank_rocker: all figures are unchanged, {FILE} stays as it is ({all} channels).\n"));
    assert_eq!(fs::read_to_string(place.path(FILE)).unwrap(), text);
    // No command mistakes the file of accepted figures for a scenario.
    let listed = place.run("list scenarios");
    assert!(!listed.stdout.contains("accepted") && !listed.stderr.contains("accepted"));
}

#[test]
fn a_length_change_of_a_tenth_of_a_nanometre_is_found() {
    let place = accepted();
    let before = fs::read_to_string(place.path(FILE)).unwrap();
    edit(&place, SCENARIO, "C = { x_mm = 150, y_mm = 15 }", "C = { x_mm = 150.0000001, y_mm = 15 }");
    let outcome = check(&place);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (1, ""), "{}", outcome.stdout);
    let told = format!("DISAGREE: crank_rocker differs from the figures accepted in {FILE}: ");
    assert!(outcome.stdout.starts_with(&told), "{}", outcome.stdout);
    assert!(outcome.stdout.contains(" channels moved."), "{}", outcome.stdout);
    let header = "channel figure accepted found moved by bound bounds";
    let is_header = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ") == header;
    assert!(outcome.stdout.lines().any(is_header), "{}", outcome.stdout);
    assert_eq!(fs::read_to_string(place.path(FILE)).unwrap(), before, "a check writes nothing");
    let json = place.run(&format!("accept --check {SCENARIO} --json -"));
    let json = json.json();
    let moved = json["files"][0]["comparison"]["moved"].as_array().unwrap().clone();
    assert!(!moved.is_empty());
    for row in &moved {
        let [accepted, found, bound, bounds] =
            ["accepted", "found", "bound", "bounds"].map(|key| row[key].as_f64().unwrap());
        assert!((found - accepted).abs() > bound && bounds > 1.0, "{row}");
        assert_within!(((found - accepted).abs() / bound - bounds).abs(), 1e-3 * bounds);
    }
    // Every reported figure is stored in the file under its name; the report lists the worst figure first.
    let kept: toml::Table = before.parse().unwrap();
    let of = |name: &Value| {
        let all = kept["channels"].as_array().unwrap();
        all.iter().find(|own| own["name"].as_str() == name.as_str()).unwrap()
    };
    let mut figures = BTreeSet::new();
    for row in &moved {
        let figure = row["figure"].as_str().unwrap();
        let wanted = match figure {
            "at" => {
                let times = kept["times_s"].as_array().unwrap();
                let place = times.iter().position(|time| time.as_float() == row["t_s"].as_f64()).unwrap();
                &of(&row["channel"])["at"][place]
            }
            _ => &of(&row["channel"])[figure],
        };
        assert_eq!(wanted.as_float(), row["accepted"].as_f64(), "{row}");
        figures.insert(figure.to_string());
    }
    assert_eq!(figures.into_iter().collect::<Vec<_>>(), ["at", "greatest", "least", "rms"]);
    let told = outcome.stdout.lines().skip_while(|line| !is_header(line)).skip(1);
    let bounds: Vec<f64> = told.map_while(|line| line.split_whitespace().last()?.parse().ok()).collect();
    assert!(bounds.len() > 3 && bounds.is_sorted_by(|a, b| a >= b), "{}", outcome.stdout);
    // The change does not affect the crank's motion, so the figures of the crank's channels are not rewritten.
    let told = place.ok(&format!("accept {SCENARIO}"));
    assert!(told.starts_with("crank_rocker: new figures accepted in "), "{told}");
    let after = fs::read_to_string(place.path(FILE)).unwrap();
    let of = |text: &str, name: &str| -> String {
        text.split("\n\n").find(|part| part.contains(&format!("\"{name}\""))).unwrap().to_string()
    };
    assert_eq!(of(&before, "link.crank.angle_rad"), of(&after, "link.crank.angle_rad"));
    assert_ne!(of(&before, "point.D.x_m"), of(&after, "point.D.x_m"));
    assert_eq!(check(&place).code, 0);
}

/// A difference within its bound does not count as a change, even if digits differ.
#[test]
fn a_figure_within_its_bound_has_not_moved() {
    let place = accepted();
    let text = fs::read_to_string(place.path(FILE)).unwrap();
    edit(&place, FILE, "greatest = 6.2831853071796", "greatest = 6.2831853071860");
    assert_eq!(check(&place).code, 0);
    let edited = fs::read_to_string(place.path(FILE)).unwrap();
    place.ok(&format!("accept {SCENARIO}"));
    assert_eq!(fs::read_to_string(place.path(FILE)).unwrap(), edited);
    fs::write(place.path(FILE), text).unwrap();
    edit(&place, FILE, "greatest = 6.2831853071796", "greatest = 6.2831853072000");
    let outcome = check(&place);
    assert_eq!(outcome.code, 1);
    assert!(outcome.stdout.contains(&format!("1 of {} channels moved.", channels())), "{}", outcome.stdout);
    // Angles that differ by a whole revolution count as equal.
    let turned = [
        ("at = [0.0, 1.5707963267949, 3.1415926535898,", "at = [6.2831853071796, 7.8539816339745, 9.4247779607694,"),
        ("4.7123889803847, 6.2831853071796]", "10.9955742875643, 12.5663706143592]"),
        ("least = 0.0\ngreatest = 6.2831853072000", "least = 6.2831853071796\ngreatest = 12.5663706143592"),
    ];
    for (old, new) in turned {
        edit(&place, FILE, old, new);
    }
    assert_eq!(check(&place).code, 0);
}

/// A motion may change although its extremes and its few stored instants stay the same. In such a case, only the root
/// mean square shows the change.
#[test]
fn a_changed_root_mean_square_is_reported() {
    let place = accepted();
    edit(&place, FILE, "rms = 13.61356816556\n", "rms = 13.62356816556\n");
    let outcome = check(&place);
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
    assert!(outcome.stdout.contains(&format!("1 of {} channels moved.", channels())), "{}", outcome.stdout);
}

#[test]
fn new_and_missing_channels_are_reported() {
    let place = accepted();
    edit(&place, FILE, "\"link.coupler.angle_rad\"", "\"link.handle.angle_rad\"");
    edit(&place, FILE, "rms = 13.61356816556\n", "");
    let outcome = check(&place);
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
    for line in [
        &format!("2 of {} channels new, 1 gone.", channels()),
        "new: link.crank.omega_rad_s, link.coupler.angle_rad",
        "gone: link.handle.angle_rad",
    ] {
        assert!(outcome.stdout.contains(line), "{line}: {}", outcome.stdout);
    }
    let json = place.run(&format!("accept --check {SCENARIO} --json -")).json();
    assert_eq!(json["files"][0]["comparison"]["gone"][0], "link.handle.angle_rad");
    place.ok(&format!("accept {SCENARIO}"));
    assert_eq!(check(&place).code, 0);
}

#[test]
fn another_grid_is_reported_without_comparing_values() {
    let place = accepted();
    // An instant that is changed by a millionth counts as a different instant.
    edit(&place, FILE, "times_s = [0.0, 0.11538461538461539", "times_s = [0.0, 0.11538473");
    let outcome = check(&place);
    assert!(outcome.code == 1 && outcome.stdout.contains("the instants differ"), "{}", outcome.stdout);
    place.ok(&format!("accept {SCENARIO}"));
    edit(&place, SCENARIO, "step_deg = 1\n", "step_deg = 2\n");
    let outcome = check(&place);
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
    assert!(
        outcome.stdout.contains("the instants differ from the accepted ones, so values are not compared."),
        "{}",
        outcome.stdout
    );
    place.ok(&format!("accept {SCENARIO}"));
    let text = fs::read_to_string(place.path(FILE)).unwrap();
    assert!(text.contains("instants = 181\n"), "{text}");
    assert_eq!(check(&place).code, 0);
}

#[test]
fn a_hundredfold_larger_bound_is_inconclusive() {
    let place = accepted();
    edit(&place, FILE, "bound = 6.6e-12", "bound = 6.6e-15");
    let outcome = check(&place);
    assert_eq!(outcome.code, 3, "{}", outcome.stdout);
    let told = format!("INCONCLUSIVE: it is undecided whether crank_rocker matches the figures accepted in {FILE}: ");
    assert!(outcome.stdout.starts_with(&told), "{}", outcome.stdout);
    assert!(
        outcome.stdout.contains("link.crank.angle_rad: its bound was 6.6e-15 rad, now 6.6e-12"),
        "{}",
        outcome.stdout
    );
    let json = place.run(&format!("accept --check {SCENARIO} --json -")).json();
    let wider = &json["files"][0]["comparison"]["wider"][0];
    assert_eq!([&wider["accepted_bound"], &wider["found_bound"]], [6.6e-15, 6.6e-12]);
}

/// Symptom: any result of a run counted as accepted if every stored bound was 1e300, or if the stored verdict was
/// `disagree`.
#[test]
fn regress_loosely_bounded_or_unproven_figures_are_inconclusive() {
    let place = accepted();
    let whole = fs::read_to_string(place.path(FILE)).unwrap();
    let mut lines: Vec<String> = whole.lines().map(String::from).collect();
    for line in lines.iter_mut().filter(|line| line.starts_with("bound = ")) {
        *line = "bound = 1e300".into();
    }
    fs::write(place.path(FILE), lines.join("\n")).unwrap();
    let outcome = check(&place);
    assert_eq!(outcome.code, 3, "{}", outcome.stdout);
    let all = channels();
    let told = format!("{all} of {all} channels accepted with a bound at least 100 times larger than now");
    assert!(outcome.unbroken().contains(&told), "{}", outcome.stdout);
    let json = place.run(&format!("accept --check {SCENARIO} --json -")).json();
    assert_eq!(json["files"][0]["comparison"]["looser"].as_array().unwrap().len(), all);
    // The figures are accepted anew, which restores the file.
    place.ok(&format!("accept {SCENARIO}"));
    assert_eq!(fs::read_to_string(place.path(FILE)).unwrap(), whole);
    for word in ["disagree", "inconclusive"] {
        fs::write(place.path(FILE), whole.replace("verdict = \"agree\"", &format!("verdict = \"{word}\""))).unwrap();
        let outcome = check(&place);
        assert_eq!(outcome.code, 3, "{}", outcome.stdout);
        assert!(
            outcome.unbroken().contains(&format!("the verdict was accepted as {word} and is agree")),
            "{}",
            outcome.stdout
        );
        place.ok(&format!("accept {SCENARIO}"));
        assert_eq!(fs::read_to_string(place.path(FILE)).unwrap(), whole);
    }
}

#[test]
fn unproven_figures_are_accepted_only_on_request() {
    let place = accepted();
    let before = fs::read_to_string(place.path(FILE)).unwrap();
    let coarse = "--dt 2e-2";
    for command in [format!("accept {SCENARIO} {coarse}"), format!("accept --check {SCENARIO} {coarse}")] {
        let outcome = place.run(&command);
        assert_eq!(outcome.code, 3, "{}", outcome.stdout);
        assert!(outcome.unbroken().contains("choose a smaller time step"), "{}", outcome.stdout);
        assert_eq!(fs::read_to_string(place.path(FILE)).unwrap(), before);
    }
    let wrong = "\n[[formula]]\nname = \"w\"\nexpression = \"phi\"\nchannel = \"link.crank.omega_rad_s\"\n";
    let text = fs::read_to_string(place.path(SCENARIO)).unwrap();
    fs::write(place.path(SCENARIO), format!("{text}{wrong}")).unwrap();
    let outcome = place.run(&format!("accept {SCENARIO}"));
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
    assert!(outcome.stdout.starts_with("crank_rocker: not accepted, the verdict is disagree.\n"), "{}", outcome.stdout);
    assert_eq!(check(&place).code, 1);
    let told = place.ok(&format!("accept {SCENARIO} --unproven"));
    assert!(told.contains("the verdict was accepted as agree and is disagree"), "{told}");
    let outcome = check(&place);
    assert_eq!(outcome.code, 1);
    assert!(outcome.stdout.contains("the verdict was accepted as disagree and still is"), "{}", outcome.stdout);
    // Without the wrong formula the verdict is agree again. The check still fails, because the stored figures were
    // accepted with the verdict disagree.
    fs::write(place.path(SCENARIO), text).unwrap();
    assert_eq!(check(&place).code, 3);
    place.ok(&format!("accept {SCENARIO}"));
    assert_eq!(check(&place).code, 0);
    place.refused(&format!("accept {SCENARIO} --unproven --check"), &["cannot be used with"]);
}

#[test]
fn an_unusable_accepted_file_is_refused_and_not_overwritten() {
    let place = accepted();
    let whole = fs::read_to_string(place.path(FILE)).unwrap();
    let cases = [
        (
            whole[..whole.len() / 2].trim_end_matches(']').to_string() + "\"",
            vec!["crank_rocker.accepted:", "not valid TOML"],
        ),
        (format!("<<<<<<< ours\n{whole}"), vec!["crank_rocker.accepted:1:", "not valid TOML"]),
        (String::new(), vec!["no accepted figures"]),
        (whole.replace("scenario = \"crank_rocker\"", "scenario = \"pendulum\""), vec!["of \"pendulum\", not of"]),
        (whole.replace("format = 1", "format = 7"), vec!["format 7"]),
        (whole.replace("verdict = \"agree\"", "verdict = \"fine\""), vec!["\"fine\" is not a verdict"]),
        (whole.replace("instants = 361", "instants = -1"), vec!["-1 instants"]),
        (whole.replacen("least = ", "last = ", 1), vec!["`least`", "did you mean"]),
        (whole.replacen("bound = ", "bound = -", 1), vec!["is negative"]),
        (whole.replacen("bound = 6.6e-12", "bound = inf", 1), vec!["a finite number is needed"]),
        (whole.replacen("at = [0.0, ", "at = [", 1), vec!["`at` has 4 values, but there are 5 instants"]),
        (whole.replace("link.crank.omega_rad_s", "link.crank.angle_rad"), vec!["link.crank.angle_rad is given twice"]),
    ];
    for (text, words) in cases {
        fs::write(place.path(FILE), &text).unwrap();
        for command in ["accept", "accept --check", "accept --unproven"] {
            place.refused(&format!("{command} {SCENARIO}"), &words);
            assert_eq!(fs::read_to_string(place.path(FILE)).unwrap(), text);
        }
    }
    fs::remove_file(place.path(FILE)).unwrap();
    place.refused(&format!("accept --check {SCENARIO}"), &["has no accepted figures", "linkproof accept scenarios/"]);
}

#[test]
fn a_bad_file_does_not_stop_the_others() {
    let place = accepted();
    let outcome = place.run(&format!("accept --check scenarios/missing.toml {SCENARIO} --json out.json"));
    assert_eq!(outcome.code, 2);
    assert!(outcome.stdout.starts_with("AGREE: crank_rocker"), "{}", outcome.stdout);
    let json: serde_json::Value = serde_json::from_slice(&fs::read(place.path("out.json")).unwrap()).unwrap();
    assert_eq!(texts(&json["files"], "scenario"), ["crank_rocker"]);
    assert_eq!(texts(&json["errors"], "scenario"), ["scenarios/missing.toml"]);
}
