//! `linkproof export`.

use std::fs;

use super::tools::Place;
use crate::common::assert_within;

#[test]
fn mjcf_is_written_to_the_given_file() {
    let place = Place::new();
    let text = place.ok("export scenarios/crank_rocker.toml --mjcf -");
    let document = roxmltree::Document::parse(&text).unwrap();
    assert_eq!(document.root_element().attribute("model"), Some("crank_rocker"));
    // The scenario gives no step, so the step is a quarter of a degree of the crank unless an option sets it.
    let step = |text: &str| {
        let document = roxmltree::Document::parse(text).unwrap();
        let option = document.descendants().find(|node| node.has_tag_name("option")).unwrap();
        option.attribute("timestep").unwrap().parse::<f64>().unwrap()
    };
    assert_within!((step(&text) * 130.0 * 6.0 - 0.25).abs(), 1e-12);
    assert_eq!(step(&place.ok("export scenarios/crank_rocker.toml --mjcf - --dt 2e-5")), 2e-5);
    assert_eq!(place.ok("export scenarios/crank_rocker.toml --mjcf model.mjcf"), "");
    assert_eq!(fs::read_to_string(place.path("model.mjcf")).unwrap(), text);
    // If the user does not choose a file name, the command prints the name that it chooses.
    for option in ["", "--mjcf"] {
        assert_eq!(place.ok(&format!("export scenarios/crank_rocker.toml {option}")), "crank_rocker.xml\n");
    }
    let written = fs::read_to_string(place.path("crank_rocker.xml")).unwrap();
    assert_eq!(
        written.rsplit_once("<!--").map(|(model, _)| model),
        Some(text.as_str()),
        "the seal is at the end of the file"
    );
}

#[test]
fn the_ending_selects_the_format() {
    let place = Place::new();
    for (ending, begin) in [("sdf", "<?xml"), ("urdf", "<?xml"), ("usda", "#usda 1.0\n")] {
        let text = place.ok(&format!("export scenarios/quick_return.toml -o -.{ending}"));
        assert!(text.starts_with(begin), "{text}");
        assert_eq!(place.ok(&format!("export scenarios/quick_return.toml -o own.{ending}")), "");
        let written = fs::read_to_string(place.path(&format!("own.{ending}"))).unwrap();
        assert!(written.starts_with(&text), "{written}");
    }
    let step = |text: &str| text.split("max_step_size>").nth(1).unwrap().trim_end_matches("</").to_string();
    assert_eq!(step(&place.ok("export scenarios/quick_return.toml -o -.sdf --dt 1e-4")), "0.0001");
}

#[test]
fn loads_are_left_out_on_request() {
    let place = Place::new();
    let message = "a load of type \"moment\" cannot be written to SDF";
    place.refused("export scenarios/four_bar_relative.toml -o -.sdf", &[message, "--no-loads"]);
    // The header of the model says that loads are omitted, except for a scenario without loads.
    for ending in ["xml", "sdf", "urdf", "usda"] {
        for (scenario, notes) in [("four_bar_relative", 1), ("quick_return", 0)] {
            let text = place.ok(&format!("export scenarios/{scenario}.toml --no-loads -o -.{ending}"));
            assert_eq!(text.matches(" without the loads of the scenario; SI units").count(), notes, "{text}");
        }
    }
    let text = place.ok("export scenarios/crank_rocker.toml --no-loads -o -.urdf --mimic 3");
    assert!(text.contains(" without the loads of the scenario;"), "{text}");
}

#[test]
fn a_model_starts_in_another_pose_with_another_mass() {
    let place = Place::new();
    let changed = "--start-crank-deg 70 --set links.crank.mass_kg=9";
    let text = place.ok(&format!("export scenarios/crank_rocker.toml {changed} -o -.json"));
    let case: serde_json::Value = serde_json::from_str(&text).unwrap();
    let link = |name: &str| case["links"].as_array().unwrap().iter().find(|link| link["name"] == name).unwrap();
    let angle = |name: &str| link(name)["start"]["angle_rad"].as_f64().unwrap();
    assert_eq!(link("crank")["mass_kg"], 9.0);
    let solved = place.ok("solve scenarios/crank_rocker.toml --crank-deg 70 --only positions");
    let rows: Vec<Vec<&str>> = solved.lines().map(|line| line.split(',').collect()).collect();
    let column = rows[0].iter().position(|name| *name == "link.rocker.angle_rad").unwrap();
    assert_within!((angle("crank") - 70_f64.to_radians()).abs(), 1e-12);
    assert_within!((angle("rocker") - rows[1][column].parse::<f64>().unwrap()).abs(), 1e-12);
}

#[test]
fn relations_belong_to_urdf() {
    let place = Place::new();
    let text = place.ok("export scenarios/crank_rocker.toml -o -.urdf --mimic 1");
    assert_eq!(text.matches("<mimic joint=\"O\"").count(), 2, "{text}");
    let text = place.ok("export scenarios/crank_rocker.toml -o -.urdf --mimic 7");
    assert!(!text.contains("<mimic") && text.contains("\"degree\": 7"), "{text}");
    place.refused("export scenarios/crank_rocker.toml -o -.sdf --mimic 3", &["--mimic", "-o FILE.urdf"]);
    for wrong in ["0", "61", "1.5", "x"] {
        place.refused(
            &format!("export scenarios/crank_rocker.toml -o -.urdf --mimic {wrong}"),
            &["--mimic", "expected a whole number from 1 to 60"],
        );
    }
    place.refused("export scenarios/five_bar.toml -o -.urdf --mimic 3", &["several drives", "without relations"]);
}

#[test]
fn the_mode_changes_the_start_pose() {
    let place = Place::new();
    let text = place.ok("export scenarios/crank_rocker.toml --mjcf -");
    let other = place.ok("export scenarios/crank_rocker.toml --mjcf - --mode coupler,rocker=right");
    let pose = |text: &str| {
        let document = roxmltree::Document::parse(text).unwrap();
        document.descendants().find_map(|node| node.attribute("qpos").map(str::to_string)).unwrap()
    };
    assert_ne!(pose(&text), pose(&other));
}

#[test]
fn the_case_as_json_has_what_a_solver_needs() {
    let place = Place::new();
    let text = place.ok("export scenarios/crank_rocker_runup.toml --json -");
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    let count = |key: &str| found[key].as_array().unwrap().len();
    assert_eq!((count("links"), count("joints"), count("drives"), count("loads"), count("times_s")), (4, 4, 1, 1, 501));
    assert_eq!(found["drives"][0]["motion"]["motor"]["torque"]["law"], "linear");
    assert_eq!(found["loads"][0]["type"], "resistance");
    // The exported state at t = 0 equals the state that `solve` computes.
    let solved = place.ok("solve scenarios/crank_rocker_runup.toml --with newton --times 0");
    let rows: Vec<Vec<&str>> = solved.lines().map(|line| line.split(',').collect()).collect();
    let column = rows[0].iter().position(|name| *name == "link.rocker.alpha_rad_s2").unwrap();
    let rocker = &found["links"][3];
    assert_eq!(rocker["name"], "rocker");
    let alpha: f64 = rows[1][column].parse().unwrap();
    assert_within!((rocker["start"]["alpha_rad_s2"].as_f64().unwrap() / alpha - 1.0).abs(), 1e-9);
    let channels = found["channels"].as_array().unwrap();
    let names: Vec<&str> = channels.iter().map(|channel| channel["name"].as_str().unwrap()).collect();
    assert_eq!(names, rows[0][2..], "the columns of solve, in their order");
    assert_eq!(place.ok("export scenarios/crank_rocker.toml --json"), "crank_rocker.json\n");
}

#[test]
fn wrong_requests_are_refused() {
    let place = Place::new();
    place.refused(
        "export scenarios/crank_rocker.toml -o model.txt",
        &["--output", "FILE.xml, FILE.sdf, FILE.urdf, FILE.usda, FILE.json, FILE.csv, FILE.dxf; found .txt"],
    );
    place.refused("export --mjcf scenarios/crank_rocker.toml", &["scenario file"]);
    place.refused("export scenarios/crank_rocker.toml --mjcf - --dt -1e-3", &["--dt", "greater than 0"]);
    let nowhere = "export scenarios/crank_rocker.toml --mjcf no/such/place.xml";
    place.refused(nowhere, &["the directory no/such does not exist"]);
    place.refused("export scenarios/crank_rocker.toml --mjcf - --mode coupler,rocker=up", &["--mode"]);
    place.refused("export scenarios/none.toml --mjcf -", &["cannot be read"]);
}
