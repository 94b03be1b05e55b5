//! The options `--times`, `--crank-deg` and `--start-crank-deg` of `run` and `solve`.
//! Also tested: grids that list their values, starts that the file leaves ambiguous, and wrong starts.

use std::fs;

use serde_json::{Value, json};

use super::tools::{Place, Table};
use crate::common::{assert_within, from_outside};

const AMBIGUOUS: (&str, &str) = ("mode = \"left\"", "near = { point = \"B\", x_mm = 90, y_mm = 10 }");

const OWN_GRID: &str = "from_s = 0\nto_s = 3\nstep_s = 0.01";

/// Asserts that all columns of two tables except the times agree to `bound`, and angles up to whole revolutions.
fn assert_same_branch(one: &str, other: &str, bound: f64) {
    let [one, other] = [one, other].map(Table::of);
    assert_eq!(one.header, other.header);
    for name in one.header.iter().filter(|name| *name != "t_s") {
        for (a, b) in one.column(name).iter().zip(other.column(name)) {
            let off =
                if name.ends_with("_rad") { ((a - b) / 2.0).sin().abs() } else { (a - b).abs() / (1.0 + b.abs()) };
            assert_within!(off, bound, "{name}: {a} {b}");
        }
    }
}

#[test]
fn run_accepts_another_grid() {
    let place = Place::new();
    for (command, instants) in [
        ("crank_rocker --crank-deg 0:360:2", 181),
        ("crank_rocker --crank-deg 0,30,45:90:15", 6),
        ("crank_rocker --times 0,0.1,0.3", 3),
        ("pendulum --times 0:0.5:0.1", 6),
        // The times need not be in order.
        ("pendulum --times 0.2,0,0.1", 3),
    ] {
        let (name, grid) = command.split_once(' ').unwrap();
        let text = place.ok(&format!("run scenarios/{name}.toml --verbose --no-record {grid}"));
        assert!(
            text.contains(&format!("{instants} instants")) && text.starts_with(&format!("{name}: AGREE: ")),
            "{command}: {text}"
        );
    }
    // Published numbers are still checked if an option replaces the grid.
    let text = place.ok("run scenarios/fourth_class.toml -v --no-record --crank-deg 70,80");
    assert!(text.contains("published"), "{text}");
    for (command, words) in [
        ("pendulum.toml --crank-deg 0,10", ["the motion is free", "--times"]),
        ("crank_rocker.toml --crank-deg 0,10,0", ["values 1 and 3 of the list are the same", "crank-deg"]),
        ("crank_rocker.toml --times 0,a", ["not a number", "0:360:30 or 0,45,90"]),
        ("crank_rocker.toml --times 0:1e300:1e300", ["turns from zero; the limit is", "--times"]),
        ("crank_rocker.toml --times 0 --crank-deg 0", ["cannot be used with", "--crank-deg"]),
        ("crank_rocker.toml --start-crank-deg inf", ["finite number", "--start-crank-deg"]),
    ] {
        place.refused(&format!("run scenarios/{command} --no-record"), &words);
    }
}

#[test]
fn grids_in_files_may_list_values() {
    let place = Place::new();
    let text = fs::read_to_string(place.path("scenarios/pendulum.toml")).unwrap();
    let listed =
        |list: &str| place.edited("pendulum.toml", "listed.toml", &[(OWN_GRID, list), (from_outside(&text), "")]);
    let solved = |list: &str| {
        listed(list);
        place.ok("solve scenarios/listed.toml --with assur")
    };
    let by_option = place.ok("solve scenarios/pendulum.toml --with assur --times 0,0.1,0.3");
    assert_eq!(solved("times_s = [0, 0.1, 0.3]"), by_option);
    assert_eq!(solved("times_ms = [0, 100, 300]"), by_option);
    assert_eq!(Table::of(&solved("times_s = [0.3, 0.1]")).column("t_s"), [0.3, 0.1]);
    let grid = "from_deg = 0\nto_deg = -360\nstep_deg = -1";
    place.edited("ov7_base.toml", "listed.toml", &[(grid, "angles_deg = [0, -30, -77.5]")]);
    let by_option = place.ok("solve scenarios/ov7_base.toml --with newton --crank-deg 0,-30,-77.5");
    assert_eq!(place.ok("solve scenarios/listed.toml --with newton"), by_option);
    listed("angles_deg = [0, 10]");
    place.refused("run scenarios/listed.toml --no-record", &["listed.toml", "grid", "the motion is free", "times_s"]);
    // An invalid grid in the file does not block the grid that replaces it.
    place.ok("solve scenarios/listed.toml --with assur --times 0,0.1,0.3");
}

/// `--start-crank-deg` replaces `crank_deg` of the file.
/// At constant speed, the start angle does not change the pose at a given crank angle.
#[test]
fn the_start_angle_option_overrides_the_file() {
    let place = Place::new();
    let option = "--start-crank-deg 90 --times 0,0.01,0.1";
    place.edited("crank_rocker_runup.toml", "moved.toml", &[("crank_deg = 0\n", "crank_deg = 90\n")]);
    for solver in ["assur", "newton"] {
        let moved = place.ok(&format!("solve scenarios/moved.toml --with {solver} --times 0,0.01,0.1"));
        let asked = place.ok(&format!("solve scenarios/crank_rocker_runup.toml --with {solver} {option}"));
        assert_eq!(asked, moved, "{solver}");
    }
    // The dyads of ov7_base have modes, which apply at the new start.
    // The groups of class III (ov7_new) and IV (fourth_class) have approximate positions.
    // These positions apply at the crank angle in the file; from this angle, the configuration is followed to the new
    // start.
    for (name, start, cranks) in
        [("ov7_base", -200, "0,-30,-250"), ("ov7_new", -70, "-60,-70,-80"), ("fourth_class", 200, "70,150,290")]
    {
        let solve = format!("solve scenarios/{name}.toml --with newton --crank-deg {cranks}");
        let own = place.ok(&solve);
        let moved = place.ok(&format!("{solve} --start-crank-deg {start}"));
        assert_ne!(Table::of(&moved).column("t_s"), Table::of(&own).column("t_s"));
        assert_same_branch(&moved, &own, 1e-9);
    }
}

#[test]
fn published_numbers_apply_only_to_their_branch() {
    let place = Place::new();
    let run =
        |options: &str| place.run(&format!("run scenarios/{options} --no-record --json -")).json()["runs"][0].clone();
    // The distance of two points at t = 0 depends on the start, so the check of this distance is not counted.
    let published = |proof: &Value| {
        let checks = proof["checks"].as_array().unwrap().iter();
        let stays = |check: &&Value| !check["name"].as_str().unwrap().contains("distance");
        checks
            .filter(stays)
            .filter(|check| ["published", "derived"].contains(&check["origin"].as_str().unwrap()))
            .count()
    };
    for name in ["crank_rocker", "fourth_class"] {
        let own = published(&run(&format!("{name}.toml")));
        let moved = run(&format!("{name}.toml --start-crank-deg 100"));
        assert_eq!((own > 0, published(&moved), &moved["verdict"]), (true, own, &json!("agree")), "{name}");
    }
    assert_eq!(published(&run("crank_rocker.toml --start-crank-deg 100 --mode coupler,rocker=right")), 0);
    // At a changing speed, velocities at a crank angle depend on the start angle of the crank. With another start
    // angle, derived numbers are therefore not checked.
    let ramp = ("law = \"constant\"", "law = \"ramp\"\ntime_s = 1");
    let speed = ("[drive]\n", "[drive]\nlaw = \"constant\"\n");
    place.edited("crank_rocker.toml", "ramp.toml", &[speed, ramp]);
    let moved = run("ramp.toml --start-crank-deg 100 --crank-deg 110:200:10");
    assert!(moved["checks"].as_array().unwrap().iter().all(|check| check["origin"] != "derived"), "{moved}");
}

/// Symptom: if the approximate position in a file fits two configurations, the command that lists configurations and
/// the option that chooses a configuration were refused.
/// Cause: the start in the file was evaluated before the request.
#[test]
fn regress_an_ambiguous_start_does_not_block_its_resolution() {
    let place = Place::new();
    place.edited("crank_rocker.toml", "open.toml", &[AMBIGUOUS]);
    let solve =
        |mode: &str| place.ok(&format!("solve scenarios/open.toml --with assur --crank-deg 0,30 --mode {mode}"));
    let own = |mode: &str| {
        place.ok(&format!("solve scenarios/crank_rocker.toml --with assur --crank-deg 0,30 --mode {mode}"))
    };
    for mode in ["coupler,rocker=left", "rocker,coupler=left", "coupler,rocker=2"] {
        assert_eq!(solve(mode), own(mode), "{mode}");
    }
    let run = place.ok("run scenarios/open.toml --no-record --mode coupler,rocker=left");
    assert!(run.starts_with("crank_rocker: AGREE: "), "{run}");
    let words = ["it decides for neither", "inspect FILE --modes", "open.toml:"];
    place.refused("solve scenarios/open.toml --with assur", &words);
    place.refused("inspect scenarios/open.toml", &words);
    let text = place.ok("inspect scenarios/open.toml --modes");
    assert!(text.contains("2 real configurations\n  not chosen by the scenario: the approximate position"), "{text}");
    assert!(!text.contains(", chosen by the scenario"), "{text}");
    let chosen = place.ok("inspect scenarios/open.toml --modes --mode coupler,rocker=2");
    assert!(chosen.contains("2, right, chosen by the scenario"), "{chosen}");
}

/// The approximate position of the group is halfway between its two configurations, so the position selects neither.
#[test]
fn all_configurations_of_an_open_group_are_listed() {
    let place = Place::new();
    let text = std::fs::read_to_string(place.path("scenarios/fourth_class.toml")).unwrap();
    let near = text.lines().find(|line| line.starts_with("near = ")).unwrap();
    // The approximate position is halfway between the points E of the two configurations.
    let found: Value = serde_json::from_str(&place.ok("inspect scenarios/fourth_class.toml --modes --json -")).unwrap();
    let modes = found["modes"]["groups"][0]["modes"].as_array().unwrap();
    let mean = |axis: &str| {
        let of = |mode: &Value| {
            let points = mode["links"][2]["points"].as_array().unwrap().clone();
            points.iter().find(|point| point["name"] == "E").unwrap()[axis].as_f64().unwrap()
        };
        modes.iter().map(of).sum::<f64>() / 2.0 * 1e3
    };
    let between = format!("near = {{ point = \"E\", x_mm = {}, y_mm = {} }}", mean("x_m"), mean("y_m"));
    place.edited("fourth_class.toml", "open.toml", &[(near, &between)]);
    let open: Value = serde_json::from_str(&place.ok("inspect scenarios/open.toml --modes --json -")).unwrap();
    let group = &open["modes"]["groups"][0];
    assert!(group["undecided"].as_str().unwrap().contains("it decides for neither"), "{group}");
    assert_eq!(open["groups"][0]["mode"], Value::Null);
    let places = |found: &Value| -> Vec<Value> {
        let modes = found["modes"]["groups"][0]["modes"].as_array().unwrap();
        modes.iter().map(|mode| mode["links"].clone()).collect()
    };
    assert_eq!(places(&open), places(&found));
    assert!(group["modes"].as_array().unwrap().iter().all(|mode| mode["followed"] == json!(false)), "{group}");
}

/// Symptom: if the mode of the first group was wrong, the error named the second group and its lengths.
#[test]
fn regress_a_wrong_mode_is_reported_for_its_own_group() {
    let place = Place::new();
    let first = "links = [\"rod_23\", \"rocker_43\"]\nmode = ";
    let edit = (format!("{first}\"right\""), format!("{first}\"left\""));
    place.edited("ov7_base.toml", "wrong.toml", &[(&edit.0, &edit.1)]);
    let words = [
        "`start.groups (rod_23, rocker_43)`: this configuration",
        "does not fit the group (rod_35, rocker_65), but mode \"right\" does",
        "give mode \"right\" of the group (rod_23, rocker_43)",
    ];
    let outcome = place.refused("inspect scenarios/wrong.toml", &words);
    let text = std::fs::read_to_string(place.path("scenarios/wrong.toml")).unwrap();
    let line = text[..text.find(first).unwrap()].lines().count();
    assert!(outcome.stderr.contains(&format!("wrong.toml:{line}:")), "{line}: {}", outcome.stderr);
    for mode in ["left", "1"] {
        let solve = format!("solve scenarios/ov7_base.toml --with assur --mode rod_23,rocker_43={mode}");
        let outcome = place.refused(&solve, &words);
        assert!(!outcome.stderr.contains("ov7_base.toml:"), "{}", outcome.stderr);
    }
    // The right mode on the command line repairs the start, and the list shows both modes.
    place.ok("solve scenarios/wrong.toml --with assur --crank-deg 0 --mode rod_23,rocker_43=right");
    let list = place.ok("inspect scenarios/wrong.toml --modes");
    assert!(
        list.contains("not chosen by the scenario: this configuration") && list.contains("for configuration 2 of"),
        "{list}"
    );
    // A later group may have both a mode and an approximate position that fits the mode.
    let last = "links = [\"rod_35\", \"rocker_65\"]\nmode = \"right\"";
    let near = format!("{last}\nnear = {{ point = \"5\", x_mm = 101.4, y_mm = 46 }}");
    place.edited("ov7_base.toml", "near.toml", &[(last, &near)]);
    place.ok("inspect scenarios/near.toml");
    // If no change of an earlier group helps, the message names the group whose mode was requested.
    let short = place.refused(
        "solve scenarios/crank_rocker.toml --with assur --mode coupler,rocker=3",
        &["`start.groups (coupler, rocker)`: configuration 3"],
    );
    assert!(!short.stderr.contains("does not fit"), "{}", short.stderr);
}
