//! `clearance`: its messages, its output files and its exit codes.

use std::fs;

use serde_json::Value;

use super::tools::Place;
use crate::common::assert_within;

#[test]
fn the_crankcase_is_reported_as_clear() {
    let place = Place::new();
    let text = place.ok("clearance scenarios/crankcase.toml");
    for part in
        ["clearance over crank angles 0.0000 to 360.0000 deg", "piston, head ", "1.0000", "swept area", "\nclear: "]
    {
        assert!(text.contains(part), "`{part}` is not in:\n{text}");
    }
    let again = place.ok("clearance scenarios/crankcase.toml -o files.svg -o files.csv");
    assert_eq!(again, text, "same input, same bytes");
    let svg = place.ok("clearance scenarios/crankcase.toml --svg -");
    let drawing = roxmltree::Document::parse(&svg).unwrap();
    let titles: Vec<&str> =
        drawing.descendants().filter(|node| node.has_tag_name("title")).filter_map(|n| n.text()).collect();
    assert!(titles.contains(&"swept by rod") && titles.contains(&"head"), "{titles:?}");
    // The drawing has the marks of all drawings: pins, numbers of links, the drive's arrow, a scale.
    let with = |key: &str, value: &str| drawing.descendants().filter(|node| node.attribute(key) == Some(value)).count();
    assert_eq!((with("r", "1.2"), with("r", "2.3")), (3, 3), "pins O, A, B and the numbers of three links");
    assert!(svg.contains("smallest distance 0.5000 mm: piston and cylinder_left") && svg.contains(">50 mm<"), "{svg}");
    let table = place.ok("clearance scenarios/crankcase.toml --csv -");
    assert!(table.starts_with("t_s,crank_rad,crank.piston.distance_m,"), "{table}");
    assert_eq!(table.lines().count(), 182);
    for (file, same) in [("files.svg", &svg), ("files.csv", &table)] {
        assert!(std::fs::read_to_string(place.path(file)).unwrap() == *same, "{file}");
    }
}

#[test]
fn a_collision_is_an_outcome_and_no_error() {
    let place = Place::new();
    // Swept areas cost the most work. This test does not use them, so they are computed roughly.
    let rough = |wanted: &str| format!("wanted_mm = {wanted}\narea_rel = 0.01");
    place.edited(
        "crankcase.toml",
        "longer.toml",
        &[("x_mm = 130,", "x_mm = 132,"), ("wanted_mm = 0.4", &rough("0.4"))],
    );
    let outcome = place.run("clearance scenarios/longer.toml --json out.json");
    assert_eq!((outcome.code, outcome.stderr.as_str()), (1, ""));
    assert!(outcome.stdout.contains("first collision: piston and head at crank angle"), "{}", outcome.stdout);
    let found: Value = serde_json::from_str(&std::fs::read_to_string(place.path("out.json")).unwrap()).unwrap();
    let first = &found["scenarios"][0]["first_collision"];
    assert_eq!(first["bodies"], serde_json::json!(["piston", "head"]));
    // The expected crank angle a puts the crown at 201 mm: 40 sin a + sqrt(132^2 - 40^2 cos^2 a) + 30 = 201.
    let crank = first["at"]["crank_rad"].as_f64().unwrap();
    let height = 40.0 * crank.sin() + (132.0f64.powi(2) - (40.0 * crank.cos()).powi(2)).sqrt() + 30.0;
    assert_within!((height - 201.0).abs(), 1e-6, "{first}");
    // The distance is less than the required distance, but there is no collision.
    place.edited("crankcase.toml", "near.toml", &[("wanted_mm = 0.4", &rough("0.6"))]);
    let outcome = place.run("clearance scenarios/near.toml");
    assert_eq!(outcome.code, 1, "{}", outcome.stdout);
    assert!(
        outcome.stdout.contains("first closer than the required 0.6000 mm: piston and cylinder_left"),
        "{}",
        outcome.stdout
    );
}

/// If several drives have varying speeds, the range and all instants are times.
#[test]
fn several_drives_with_laws_are_answered_over_the_time() {
    let place = Place::new();
    place.edited("robot_arm.toml", "asked.toml", &[("[grid]", "[clearance]\nradius_mm = 5\n\n[grid]")]);
    let told = place.run("clearance scenarios/asked.toml --svg arm.svg --csv arm.csv").stdout;
    assert!(told.contains("clearance over times 0.0000 to 1.5000 s") && told.contains("time, s"), "{told}");
    let found = place.run("clearance scenarios/asked.toml --json -").json();
    let found = &found["scenarios"][0];
    assert_eq!(found["range_s"], serde_json::json!([0.0, 1.5]), "{found}");
    for pair in found["pairs"].as_array().unwrap() {
        let (t, crank) = (pair["t_s"].as_f64().unwrap(), pair["crank_rad"].as_f64().unwrap());
        // The crank follows a cycloid of 1.6 s; the last row of the CSV table is at 1.5 s.
        let gone = |t: f64| t / 1.6 - (std::f64::consts::TAU * t / 1.6).sin() / std::f64::consts::TAU;
        let share = gone(t) / gone(1.5);
        let csv = fs::read_to_string(place.path("arm.csv")).unwrap();
        let row = |line: &str| line.split(',').map(|cell| cell.parse::<f64>().unwrap()).collect::<Vec<_>>();
        let (first, last) = (row(csv.lines().nth(1).unwrap())[1], row(csv.lines().last().unwrap())[1]);
        assert!((crank - (first + (last - first) * share)).abs() < 1e-12, "{pair}");
    }
}

#[test]
fn unanswerable_questions_are_refused() {
    let place = Place::new();
    place.refused("clearance scenarios/crank_rocker.toml", &["has no section `[clearance]`", "[clearance]"]);
    let asks = [("[grid]", "[clearance]\nradius_mm = 5\n\n[grid]")];
    place.edited("cam_follower.toml", "asked.toml", &asks);
    place.refused("clearance scenarios/asked.toml", &["not proven for cams"]);
    let outcome = place.run("clearance scenarios/crankcase.toml scenarios/crank_rocker.toml --json -");
    assert_eq!(outcome.code, 2);
    let found: Value = serde_json::from_str(&outcome.stdout).unwrap();
    assert_eq!(found["scenarios"][0]["standing"], "clear");
    assert!(found["scenarios"][1]["error"].as_str().unwrap().contains("has no section"), "{found}");
    let files = "scenarios/crankcase.toml scenarios/crankcase.toml";
    place.refused(&format!("clearance {files} --svg out.svg"), &["2 scenarios", "give one scenario"]);
    let twice = "clearance scenarios/crankcase.toml --svg a.svg --csv ./a.svg";
    place.refused(twice, &["two results go to a.svg", "two files"]);
}
