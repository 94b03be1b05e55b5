//! `--mode` of `run` and `solve`, and the start in the output of `inspect`.

use std::fs;

use serde_json::{Value, json};

use super::tools::{Place, Table};
use crate::common::assert_within;

const FOURTH: &str = "link_2,link_3,link_4,link_5";

/// Angle of the rocker at the start with the given `--mode` (rad).
fn rocker(place: &Place, mode: &str) -> f64 {
    let command = format!("solve scenarios/crank_rocker.toml --with assur --crank-deg 0:0:1 {mode}");
    Table::of(&place.ok(&command)).column("link.rocker.angle_rad")[0]
}

#[test]
fn a_dyad_starts_in_the_requested_mode() {
    let place = Place::new();
    let left = rocker(&place, "");
    assert_eq!(rocker(&place, "--mode coupler,rocker=left"), left);
    // The pivot C is at (0.15, 0.015) m, the crank pin A on the x axis at 0.025995627740337 m.
    // The two modes are mirror images about the line AC.
    let axis = 0.015f64.atan2(0.15 - 0.025995627740337);
    let mirrored = |angle: f64| 2.0 * axis - angle;
    let away = |a: f64, b: f64| ((a - b).sin()).abs() + (1.0 - (a - b).cos());
    let right = rocker(&place, "--mode coupler,rocker=right");
    assert_within!(away(right, mirrored(left)), 1e-12, "{right} {left}");
    // With the links in the reverse order, left and right are exchanged.
    // Configurations are numbered as in `inspect --modes`.
    assert_eq!(rocker(&place, "--mode rocker,coupler=left"), right);
    assert_eq!(rocker(&place, "--mode coupler,rocker=2"), right);
    assert_eq!(rocker(&place, "--mode coupler,rocker=1"), left);
}

#[test]
fn a_higher_group_starts_in_the_numbered_configuration() {
    let place = Place::new();
    let shown = place.ok("inspect scenarios/fourth_class.toml --modes --json -");
    let found: Value = serde_json::from_str(&shown).unwrap();
    let modes = found["modes"]["groups"][0]["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 2);
    for (index, mode) in modes.iter().enumerate() {
        for solver in ["assur", "newton"] {
            let number = index + 1;
            let command = format!(
                "solve scenarios/fourth_class.toml --with {solver} --crank-deg 70:70:1 --mode {FOURTH}={number}"
            );
            let table = Table::of(&place.ok(&command));
            for link in mode["links"].as_array().unwrap() {
                let name = link["name"].as_str().unwrap();
                let angle = table.column(&format!("link.{name}.angle_rad"))[0];
                let away = (angle - link["angle_rad"].as_f64().unwrap()).abs();
                assert_within!(away, 1e-12, "{solver} {number} {name}: {away}");
            }
        }
    }
}

#[test]
fn another_mode_is_proven_without_the_published_numbers() {
    let place = Place::new();
    let run = |mode: &str| {
        let outcome = place.run(&format!("run scenarios/crank_rocker.toml --no-record --json - {mode}"));
        (outcome.code, outcome.json()["runs"][0].clone())
    };
    let published = |proof: &Value| proof["checks"].to_string().contains("published with");
    let agree = |proof: &Value| {
        let channels = proof["engines"][0]["channels"].as_array().unwrap();
        !channels.is_empty() && channels.iter().all(|channel| channel["verdict"] == json!("agree"))
    };
    let (code, own) = run("");
    assert!(published(&own), "{own}");
    let (same_code, same) = run("--mode coupler,rocker=left");
    assert_eq!((same_code, &same["checks"]), (code, &own["checks"]), "the same start keeps its published numbers");
    let (_, other) = run("--mode coupler,rocker=right");
    assert!(agree(&other) && !published(&other), "{other}");
}

#[test]
fn invalid_modes_are_refused() {
    let place = Place::new();
    for command in ["run scenarios/crank_rocker.toml --no-record", "solve scenarios/crank_rocker.toml --with assur"] {
        for (mode, words) in [
            ("coupler,rocker", ["does not name a group and a mode", "\"coupler,rocker=left\""]),
            ("crank,rocker=left", ["no Assur group (crank, rocker)", "\"coupler,rocker=left\""]),
            ("coupler,wheel=left", ["no Assur group (coupler, wheel)", "\"coupler,rocker=left\""]),
            (
                "coupler,rocker=ahead",
                ["not an assembly mode of the group (coupler, rocker)", "\"left\", \"right\", or a number"],
            ),
            ("coupler,rocker=3", ["configuration 3 is requested, but the group has 2 here", "from 1 to 2"]),
            ("coupler,rocker=0", ["configuration 0 is requested, but the group has 2 here", "from 1 to 2"]),
        ] {
            place.refused(&format!("{command} --mode {mode}"), &words);
        }
    }
    let solve = "solve scenarios/fourth_class.toml --with assur --mode";
    place.refused(&format!("{solve} {FOURTH}=left"), &["not an assembly mode of the group", "inspect FILE --modes"]);
    place.refused(&format!("{solve} {FOURTH}=9"), &["the group has 2 here", "from 1 to 2"]);
}

#[test]
fn inspect_reports_how_unambiguous_the_start_is() {
    let place = Place::new();
    // `inspect` reports how far point E is from its approximate position in two configurations: the selected one and
    // the next-nearest one.
    // The two reported distances must follow from the positions that `--modes` lists.
    let found: Value = serde_json::from_str(&place.ok("inspect scenarios/fourth_class.toml --modes --json -")).unwrap();
    let at = |mode: usize| {
        let points = found["modes"]["groups"][0]["modes"][mode]["links"][2]["points"].as_array().unwrap().clone();
        let e = points.into_iter().find(|point| point["name"] == json!("E")).unwrap();
        (e["x_m"].as_f64().unwrap() - 58.6e-3).hypot(e["y_m"].as_f64().unwrap() + 0.7e-3)
    };
    let group = &found["groups"][0];
    assert_within!((group["from_rough_place_m"].as_f64().unwrap() - at(0)).abs(), 1e-12, "{group}");
    assert_within!((group["next_from_rough_place_m"].as_f64().unwrap() - at(1)).abs(), 1e-12, "{group}");
    let text = place.ok("inspect scenarios/fourth_class.toml");
    let [first, next] = [0, 1].map(|mode| at(mode) * 1e3);
    let words = format!("{first:.1} mm from the approximate position in the file, the next configuration {next:.0} mm");
    assert!(text.contains(&words), "`{words}` is not in:\n{text}");
    assert!(!place.ok("inspect scenarios/ov7_base.toml").contains("approximate position"));
}

/// Text of a scenario with slots for its joints and for `near`: a crank and a group of six links.
/// The group has two base links, which are pinned to each other, on four leads; one lead is hinged to the crank.
const SIX: &str = r#"format = 1
name = "six"
title = "A group of six links"
[ground.points]
O = { x_mm = 0, y_mm = 0 }
K = { x_mm = 200, y_mm = -20 }
L = { x_mm = 480, y_mm = -30 }
M = { x_mm = 640, y_mm = 120 }
[links.crank.points]
O = { x_mm = 0, y_mm = 0 }
A = { x_mm = 30, y_mm = 0 }
[links.lead_1.points]
A = { x_mm = 0, y_mm = 0 }
B = { x_mm = 130, y_mm = 0 }
[links.base_1.points]
B = { x_mm = 0, y_mm = 0 }
C = { x_mm = 150, y_mm = -20 }
D = { x_mm = 210, y_mm = 30 }
[links.lead_2.points]
K = { x_mm = 0, y_mm = 0 }
C = { x_mm = 140, y_mm = 0 }
[links.base_2.points]
D = { x_mm = 0, y_mm = 0 }
E = { x_mm = 170, y_mm = -50 }
F = { x_mm = 260, y_mm = 10 }
[links.lead_3.points]
L = { x_mm = 0, y_mm = 0 }
E = { x_mm = 130, y_mm = 0 }
[links.lead_4.points]
M = { x_mm = 0, y_mm = 0 }
F = { x_mm = 90, y_mm = 0 }
JOINTS
[drive]
joint = "O"
speed_rpm = 60
[start]
crank_deg = 0
[[start.groups]]
links = ["lead_1", "base_1", "lead_2", "base_2", "lead_3", "lead_4"]
NEAR
[grid]
from_deg = 0
to_deg = 10
step_deg = 5
[engine]
dt_ms = 1
"#;

fn six(place: &Place, near: &str) {
    let joints = [
        ("O", "ground", "crank"),
        ("A", "crank", "lead_1"),
        ("B", "lead_1", "base_1"),
        ("K", "ground", "lead_2"),
        ("C", "lead_2", "base_1"),
        ("D", "base_1", "base_2"),
        ("L", "ground", "lead_3"),
        ("E", "lead_3", "base_2"),
        ("M", "ground", "lead_4"),
        ("F", "lead_4", "base_2"),
    ];
    let joint = |(name, a, b): (&str, &str, &str)| {
        format!("[[joints]]\nname = \"{name}\"\ntype = \"revolute\"\nlinks = [\"{a}\", \"{b}\"]\n")
    };
    let joints: String = joints.into_iter().map(joint).collect();
    let text = SIX.replace("JOINTS", &joints).replace("NEAR", near);
    fs::write(place.path("scenarios/six.toml"), text).unwrap();
}

fn near(points: &[(&str, f64, f64)]) -> String {
    let one = |(name, x, y): &(&str, f64, f64)| format!("{{ point = \"{name}\", x_mm = {x}, y_mm = {y} }}");
    format!("near = [{}]", points.iter().map(one).collect::<Vec<_>>().join(", "))
}

#[test]
fn a_group_of_six_links_starts_from_a_rough_drawing() {
    let place = Place::new();
    let drawn =
        [("B", 50.0, 120.0), ("C", 200.0, 110.0), ("D", 260.0, 160.0), ("E", 450.0, 100.0), ("F", 560.0, 160.0)];
    six(&place, &near(&drawn));
    let text = place.ok("inspect scenarios/six.toml");
    let words = " mm from the approximate position in the file\n";
    assert!(text.contains("mode followed") && text.contains(words), "{text}");
    let [assur, newton] = ["assur", "newton"]
        .map(|solver| Table::of(&place.ok(&format!("solve scenarios/six.toml --with {solver} --crank-deg 0:10:5"))));
    for (point, x, y) in drawn {
        for (axis, drawn) in [("x", x), ("y", y)] {
            let name = format!("point.{point}.{axis}_m");
            let (own, other) = (assur.column(&name), newton.column(&name));
            own.iter().zip(&other).for_each(|(a, b)| assert_within!((a - b).abs(), 1e-12, "{name}"));
            // A point may be half a link away from its approximate position, as docs/scenario.md states.
            // The shortest link of the group is 90 mm long.
            assert_within!((own[0] * 1e3 - drawn).abs(), 45.0, "{name}: {} for {drawn}", own[0]);
        }
    }
    // Approximate positions of three points are enough, as docs/scenario.md states. The poses of links without an
    // approximate position follow from the joints.
    six(&place, &near(&[drawn[0], drawn[1], drawn[3]]));
    let few = Table::of(&place.ok("solve scenarios/six.toml --with assur --crank-deg 0:10:5"));
    for point in ["B", "D", "F"] {
        let name = format!("point.{point}.x_m");
        few.column(&name)
            .iter()
            .zip(assur.column(&name))
            .for_each(|(a, b)| assert_within!((a - b).abs(), 1e-12, "{name}"));
    }
}

#[test]
fn a_group_of_six_links_lists_its_followed_configuration() {
    let place = Place::new();
    let drawn = [("B", 50.0, 120.0), ("C", 200.0, 110.0), ("E", 450.0, 100.0)];
    six(&place, &near(&drawn));
    let text = place.ok("inspect scenarios/six.toml --modes --crank-deg 5");
    let words = "only the configuration chosen by the scenario is shown; \
                 the configurations of a group of 6 links of class 3 are not all known";
    assert!(text.contains(words) && text.contains("1, chosen by the scenario"), "{text}");
    let found: Value =
        serde_json::from_str(&place.ok("inspect scenarios/six.toml --modes --crank-deg 5 --json -")).unwrap();
    let group = &found["modes"]["groups"][0];
    assert_eq!((&group["all_known"], group["modes"].as_array().unwrap().len()), (&json!(false), 1), "{group}");
    assert!(group["others_absent"].as_str().unwrap().contains("not all known"), "{group}");
    let table = Table::of(&place.ok("solve scenarios/six.toml --with newton --crank-deg 5:5:1"));
    for link in group["modes"][0]["links"].as_array().unwrap() {
        for (key, column) in [("angle_rad", "angle_rad"), ("omega_rad_s", "omega_rad_s")] {
            let name = format!("link.{}.{column}", link["name"].as_str().unwrap());
            let (own, newton) = (link[key].as_f64().unwrap(), table.column(&name)[0]);
            // The bound allows for the rounding of angular velocities up to ten times that of the crank.
            assert_within!((own - newton).abs(), 1e-10, "{name}: {own} {newton}");
        }
    }
    let dyad = place.ok("inspect scenarios/crank_rocker.toml --modes --json -");
    let found: Value = serde_json::from_str(&dyad).unwrap();
    assert_eq!(found["modes"]["groups"][0]["all_known"], json!(true));
}

#[test]
fn an_unsuitable_rough_drawing_is_refused() {
    let place = Place::new();
    let inspect = "inspect scenarios/six.toml";
    six(&place, &near(&[("B", 50.0, 120.0)]));
    place.refused(inspect, &["do not determine where link \"base_1\" of the group lies", "two points of the link"]);
    six(&place, "near = { point = \"B\", x_mm = 50, y_mm = 120 }");
    place.refused(inspect, &["do not determine where link"]);
    six(&place, "");
    place.refused(inspect, &["are not all known", "give `near` for enough points"]);
    six(&place, "near = [{ point = \"X\", x_mm = 50, y_mm = 120 }]");
    place.refused(inspect, &["no link of the group has a point \"X\""]);
    let far =
        [("B", 900.0, 120.0), ("C", 200.0, 900.0), ("D", 260.0, -700.0), ("E", 450.0, 900.0), ("F", 560.0, -860.0)];
    six(&place, &near(&far));
    place.refused(inspect, &["approximate positions", "nearer to the intended configuration"]);
}
