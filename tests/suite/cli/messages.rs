//! `inspect`, `list`, help, and error messages.

use std::fs;

use serde_json::{Value, json};

use super::tools::Place;
use crate::common::{assert_within, rapiers};

#[test]
fn inspect_shows_the_structure() {
    let place = Place::new();
    let text = place.ok("inspect scenarios/ov7_base.toml");
    let formula =
        "I(ground, crank) -> II.2 RRR(rod_23, rocker_43) -> II.2 RRR(rod_35, rocker_65) -> II.2 RRR(rod_57, rocker_87)";
    for part in [
        "mobility   W = 3*7 - 2*10 = 1",
        formula,
        "points 8 7 9",
        "m = 0.5076 kg",
        "1              revolute, ground - crank, driven",
        "class 2, order 2, RRR, mode right",
    ] {
        assert!(text.contains(part), "`{part}` is not in:\n{text}");
    }
    let ground = text.lines().find(|line| line.trim_start().starts_with("ground ")).unwrap();
    assert!(ground.ends_with("fixed"), "{ground}");
}

#[test]
fn inspect_lists_all_configurations() {
    let place = Place::new();
    let shown = place.ok("inspect scenarios/fourth_class.toml --modes --crank-deg 70 --json -");
    let found: Value = serde_json::from_str(&shown).unwrap();
    let modes = found["modes"]["groups"][0]["modes"].as_array().unwrap();
    assert_eq!(modes.iter().map(|mode| mode["followed"] == json!(true)).collect::<Vec<_>>(), [true, false]);
    for (link, (degrees, speed)) in modes[0]["links"].as_array().unwrap().iter().zip([
        (-53.70258, 2.03890),
        (2.58635, -8.39961),
        (20.59796, -31.87948),
        (151.55247, 30.91372),
    ]) {
        assert_within!((link["angle_rad"].as_f64().unwrap().to_degrees() - degrees).abs(), 0.5e-5, "{link}");
        assert_within!((link["omega_rad_s"].as_f64().unwrap() - speed).abs(), 0.5e-5, "{link}");
    }
    let text = place.ok("inspect scenarios/ov7_base.toml --modes");
    assert_eq!(text.matches("2 real configurations").count(), 3, "{text}");
    assert_eq!(text.matches("right, chosen by the scenario").count(), 3, "{text}");
    assert_eq!(place.run("inspect scenarios/ov7_base.toml --crank-deg 70").code, 2);
}

/// A platform on three rods of given length has up to six configurations; Hunt 1978, chapter on parallel manipulators.
/// The rod lengths in this test are those of one known pose, so one configuration is known.
#[test]
fn a_structure_without_a_drive_is_inspected_and_drawn() {
    let place = Place::new();
    let pin = |name: &str, links: [&str; 2]| {
        format!("[[joints]]\nname = \"{name}\"\ntype = \"revolute\"\nlinks = [\"{}\", \"{}\"]\n", links[0], links[1])
    };
    let point = |name: &str, x: f64, y: f64| format!("{name} = {{ x_m = {x}, y_m = {y} }}\n");
    // The platform stands at (0.3, 0.2) without rotation.
    let (base, eyes) = ([(0.0, 0.0), (0.5, 0.0), (0.2, 0.45)], [(0.0, 0.0), (0.15, 0.0), (0.06, 0.12)]);
    let mut text = String::from("format = 1\nname = \"truss\"\ntitle = \"Truss\"\n[ground.points]\n");
    let [mut platform, mut rods, mut joints] = [const { String::new() }; 3];
    for (k, ((x, y), (u, v))) in base.into_iter().zip(eyes).enumerate() {
        text += &point(&format!("A{k}"), x, y);
        platform += &point(&format!("B{k}"), u, v);
        let length = (0.3 + u - x).hypot(0.2 + v - y);
        rods += &format!("[links.rod{k}.points]\n{}", point(&format!("A{k}"), 0.0, 0.0));
        rods += &point(&format!("B{k}"), length, 0.0);
        joints += &pin(&format!("A{k}"), ["ground", &format!("rod{k}")]);
        joints += &pin(&format!("B{k}"), [&format!("rod{k}"), "platform"]);
    }
    text += &format!("{rods}[links.platform.points]\n{platform}{joints}");
    fs::write(place.path("truss.toml"), &text).unwrap();
    let shown = place.ok("inspect truss.toml --modes");
    assert!(shown.contains("mobility 0, 4 moving links, 6 joints") && shown.contains("class 3, order 3"), "{shown}");
    let found: Value = serde_json::from_str(&place.ok("inspect truss.toml -o -.json")).unwrap();
    let all = found["configurations"].as_array().unwrap();
    assert!(
        all.len() >= 2 && all.len() <= 6 && shown.contains(&format!("{} real configurations", all.len())),
        "{shown}"
    );
    let angles: Vec<f64> = all.iter().map(|own| own["links"][3]["angle_rad"].as_f64().unwrap()).collect();
    assert!(angles.iter().any(|angle| angle.abs() < 1e-9), "{angles:?}");
    for configuration in all {
        let at = |link: usize, point: usize, axis: &str| {
            configuration["links"][link]["points"][point][axis].as_f64().unwrap()
        };
        for k in 0..3 {
            for axis in ["x_m", "y_m"] {
                assert_within!((at(k, 1, axis) - at(3, k, axis)).abs(), 1e-9, "rod {k}");
            }
        }
    }
    for picture in ["draw truss.toml -o one.svg", "draw truss.toml --each-mode -o all.svg"] {
        let run = place.run(picture);
        assert!(run.code == 0 && !run.stderr.contains("warning"), "{}", run.stderr);
    }
    let refused = place.run("inspect truss.toml --range");
    assert!(refused.code == 2 && refused.stderr.contains("nothing moves"), "{}", refused.stderr);
    let refused = place.run("run truss.toml");
    assert!(refused.code == 2 && refused.stderr.contains("`drive` is missing"), "{}", refused.stderr);
    // Without one joint the truss can move, and a mechanism that moves needs a drive.
    fs::write(place.path("loose.toml"), text.replace(&pin("B2", ["rod2", "platform"]), "")).unwrap();
    assert_eq!(place.run("inspect loose.toml").code, 2);
}

#[test]
fn inspect_as_json() {
    let place = Place::new();
    let shown = place.ok("inspect scenarios/ov7_base.toml --json -");
    let text = place.ok("inspect scenarios/ov7_base.toml");
    assert_eq!(place.ok("inspect scenarios/ov7_base.toml --json out.json"), text);
    assert_eq!(fs::read_to_string(place.path("out.json")).unwrap(), shown);
    let found: Value = serde_json::from_str(&shown).unwrap();
    let count = |key: &str| found[key].as_array().unwrap().len();
    assert_eq!((&found["schema"], &found["mobility"]), (&json!(1), &json!(1)));
    assert_eq!((count("links"), count("joints"), count("groups")), (8, 10, 3));
    assert_eq!(found["drivers"], json!([{"link": "crank", "joint": "1", "input": "crank angle"}]));
    let group = &found["groups"][1];
    assert_eq!(group["links"], json!(["rod_35", "rocker_65"]));
    assert_eq!(
        (&group["inner_joints"], &group["kind"], &group["mode"]),
        (&json!(["5a"]), &json!("RRR"), &json!("right"))
    );
    assert_eq!((&group["class"], &group["order"]), (&json!(2), &json!(2)));
    assert_eq!(found["joints"][0], json!({"name": "1", "type": "revolute", "links": ["ground", "crank"]}));
    assert_eq!(found["links"][7]["points"][0], json!({"name": "8", "x_m": 0.0, "y_m": 0.0}));
}

#[test]
fn list_shows_scenarios_and_the_errors_of_bad_ones() {
    let place = Place::new();
    let text = place.ok("list");
    assert!(text.contains("scenarios/crank_rocker.toml\n    Crank-rocker of a design course"), "{text}");
    assert!(text.contains("scenarios/ov7_base.toml\n") && text.contains("II.2 RRR(rod_57, rocker_87)"), "{text}");

    place.edited("crank_rocker.toml", "aaa.toml", &[("mass_kg = 2.6", "mass_kg = -2.6")]);
    let text = place.ok("list scenarios");
    assert!(text.starts_with("scenarios/aaa.toml\n    cannot be read: "), "{text}");
    assert!(text.contains("must not be negative") && text.contains("scenarios/crank_rocker.toml\n    Crank"), "{text}");

    fs::create_dir(place.path("empty")).unwrap();
    assert_eq!(
        place.ok("list empty"),
        "no scenario files (.toml) in empty\n`linkproof new` writes a scenario file, `linkproof new --shipped` writes the examples\n"
    );
}

#[test]
fn list_shows_channels_and_solvers() {
    let place = Place::new();
    let channels = place.ok("list --channels");
    let [table, computed] = channels.split_once("\n\n").map(|(table, computed)| [table, computed]).unwrap();
    assert_eq!(table.lines().count(), linkage::trajectory::CHANNELS.len());
    assert!(computed.contains("link.NAME.dangle_dphi"), "{computed}");
    for part in [
        "link.NAME.angle_rad ",
        "point.NAME.ay_m_s2 ",
        "joint.NAME.fx_N ",
        "frame.moment_N_m ",
        "drive.torque_N_m ",
        "\"balancing_moment\"",
    ] {
        assert!(channels.contains(part), "{part}");
    }
    let solvers = place.ok("list --solvers");
    let names: Vec<&str> = solvers.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let simbody = cfg!(feature = "simbody").then_some("simbody");
    assert_eq!(names, [vec!["assur", "newton"], rapiers(), Vec::from_iter(simbody)].concat());
    assert!(solvers.contains("rapier2d-f64 0."));
    place.refused("list --solvers --channels", &["cannot be used with"]);
}

#[test]
fn every_help_shows_valid_examples() {
    let place = Place::empty();
    for command in [
        "", "run", "accept", "solve", "bench", "inspect", "list", "new", "docs", "bearings", "plan", "diagram", "drive",
    ] {
        // The directory contains only what the examples create.
        let place = Place::empty();
        let help = place.ok(&format!("{command} --help"));
        let examples = help.split("Examples:\n").nth(1).unwrap_or_else(|| panic!("{command}: no examples in\n{help}"));
        let lines = examples.lines().take_while(|line| line.starts_with("  linkproof "));
        let mut count = 0;
        for line in lines {
            // The text after two blanks is an explanation.
            let words = line.trim().trim_start_matches("linkproof ").split("  ").next().unwrap();
            let words = words.replace("scenarios/*.toml", "scenarios/crank_rocker.toml scenarios/ov7_base.toml");
            let outcome = place.run(&words);
            // Single precision proves less than double precision, so a proof with all engines is inconclusive.
            let code = if cfg!(feature = "f32") && words.contains("--engine all") { 3 } else { 0 };
            assert_eq!((outcome.code, outcome.stderr.as_str()), (code, ""), "{words}: {}", outcome.stdout);
            count += 1;
        }
        assert!(count >= 2, "{command}: {count} examples");
    }
    assert!(place.ok("--version").starts_with("linkproof 0."));
    assert!(place.ok("--help").contains("Exit codes: 0 all agree, 1 something disagrees, 2 bad input or usage, 3"));
}

#[test]
fn unreadable_files_are_named_with_a_remedy() {
    let place = Place::new();
    fs::write(place.path("junk.toml"), (0..4096u32).map(|k| (k * 151 % 256) as u8).collect::<Vec<_>>()).unwrap();
    fs::write(place.path("zeros.toml"), [0u8; 512]).unwrap();
    fs::write(place.path("empty.toml"), "").unwrap();
    fs::write(place.path("text.toml"), "Dear reader,\n").unwrap();
    for file in ["gone.toml", "scenarios", "junk.toml", "zeros.toml", "empty.toml", "text.toml", "-"] {
        for command in ["run FILE --no-record", "solve FILE --with assur", "inspect FILE"] {
            let outcome = place.refused(&command.replace("FILE", file), &[file, "help: "]);
            assert_eq!(outcome.stdout, "", "{command} {file}");
        }
    }
    let gone = place.run("inspect gone.toml").stderr;
    let lines: Vec<&str> = gone.lines().collect();
    assert!(lines.len() == 2 && lines[0].starts_with("error: ") && lines[1].starts_with("  = help: "), "{gone}");
    for directory in ["gone", "empty.toml"] {
        place.refused(&format!("list {directory}"), &[directory, "linkproof list DIR"]);
    }
    // Missing arguments and unknown commands are answered with the usage.
    for command in ["", "run", "solve", "inspect", "prove"] {
        let outcome = place.run(command);
        assert_eq!(outcome.code, 2, "{command}");
        assert!(outcome.stderr.contains("Usage: linkproof"), "{command}: {}", outcome.stderr);
    }
}

#[test]
fn unwritable_files_are_named_with_a_remedy() {
    let place = Place::new();
    fs::write(place.path("plain"), "a file, not a directory").unwrap();
    let scenario = "scenarios/crank_rocker.toml";
    for (command, path) in [
        (format!("run {scenario} --record plain"), "plain"),
        (format!("run {scenario} --record plain/below"), "plain/below"),
        (format!("run {scenario} --no-record --json plain/out.json"), "plain/out.json"),
        (format!("run {scenario} --no-record --json scenarios"), "scenarios"),
        (format!("solve {scenario} --with assur --csv plain/out.csv"), "plain/out.csv"),
        (format!("inspect {scenario} --json plain/out.json"), "plain/out.json"),
    ] {
        place.refused(&command, &[path, "expected "]);
    }
    assert_eq!(fs::read_to_string(place.path("plain")).unwrap(), "a file, not a directory");
    place.refused(&format!("run {scenario} --no-record --record there"), &["cannot be used with"]);
    for option in ["--slow 20", "--record-hz 10", "--record-forces"] {
        place.refused(&format!("run {scenario} --no-record {option}"), &["cannot be used with --no-record", "--live"]);
    }
    #[cfg(not(feature = "live"))]
    place
        .refused(&format!("run {scenario} --live"), &["does not include it", "cargo install --path . --features live"]);
    place.refused(&format!("run {scenario} --engine magic"), &["magic", "rapier"]);
    place.refused(&format!("run {scenario} --reference rapier"), &["rapier", "assur, newton"]);
}

#[test]
fn a_scenario_is_never_used_as_an_output_file() {
    let place = Place::new();
    let (scenario, other) = ("scenarios/crank_rocker.toml", "scenarios/ov7_base.toml");
    let before = fs::read(place.path(other)).unwrap();
    for command in [
        // A shell turns `--json scenarios/*.toml` into arguments like these.
        format!("run --no-record --json {other} {scenario}"),
        format!("solve {scenario} --with assur --csv {other}"),
        format!("inspect {scenario} --json {other}"),
        format!("synthesize slider-crank --stroke-mm 100 --rod-mm 150 -o {other}"),
    ] {
        place.refused(&command, &[other, "would be overwritten"]);
    }
    assert!(fs::read(place.path(other)).unwrap() == before);
}

#[test]
fn a_closed_output_pipe_is_no_error() {
    use std::process::{Command, Stdio};
    let place = Place::new();
    let mut child = Command::new(env!("CARGO_BIN_EXE_linkproof"))
        .current_dir(place.path(""))
        .args(["solve", "scenarios/ov7_base.toml", "--with", "assur"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
}
