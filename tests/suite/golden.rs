//! `golden`: the tables of true values equal those of `solve`, the models equal those of `export`, and the tables are
//! read back.

use std::collections::BTreeMap;
use std::fs;

use linkage::math::KeepNan;
use serde_json::Value;

use crate::cli::tools::Place;

/// Columns of a CSV table by name.
fn columns(text: &str) -> BTreeMap<String, Vec<String>> {
    let mut rows = text.lines().map(|line| line.split(',').map(String::from).collect::<Vec<_>>());
    let names = rows.next().unwrap();
    let rows: Vec<_> = rows.collect();
    names.iter().enumerate().map(|(k, name)| (name.clone(), rows.iter().map(|row| row[k].clone()).collect())).collect()
}

#[test]
fn the_truth_is_that_of_other_commands() {
    let place = Place::new();
    let said = place.ok("golden swinging_parallelogram boom_lift -o set");
    assert!(said.starts_with("2 mechanisms in set"), "{said}");
    let read = |file: &str| fs::read_to_string(place.path(file)).unwrap();
    for name in ["swinging_parallelogram", "boom_lift"] {
        let truth = read(&format!("set/{name}/truth.csv"));
        assert_eq!(truth, place.ok(&format!("solve scenarios/{name}.toml -o -")), "{name}");
        assert_eq!(read(&format!("set/{name}/{name}.toml")), read(&format!("scenarios/{name}.toml")));
        // `compare` reads the Parquet table and finds the numbers of the scenario in it.
        let compared = place.run(&format!("compare set/{name}/truth.parquet set/{name}/{name}.toml"));
        assert_eq!(compared.code, 0, "{name}: {}{}", compared.stdout, compared.stderr);
        // For every channel, `bounds.csv` states the range, and a bound far below the largest value with the same unit.
        let (truth, bounds) = (columns(&truth), columns(&read(&format!("set/{name}/bounds.csv"))));
        assert_eq!(bounds["channel"].len(), truth.len() - 2, "{name}");
        let number = |column: &str, k: usize| bounds[column][k].parse::<f64>().unwrap();
        let size = |k: usize| number("smallest", k).abs().larger(number("largest", k).abs());
        for (k, channel) in bounds["channel"].iter().enumerate() {
            let [low, high, bound] = ["smallest", "largest", "bound"].map(|column| number(column, k));
            let values = truth[channel].iter().map(|value| value.parse::<f64>().unwrap());
            let ends = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.smaller(v), b.larger(v)));
            assert_eq!((low, high), ends, "{name}: {channel}");
            let alike = (0..truth.len() - 2).filter(|&own| bounds["unit"][own] == bounds["unit"][k]);
            let largest = alike.map(size).fold(0.0, f64::larger);
            assert!(bound > 0.0 && bound < 1e-8 * largest, "{name}: {channel}: {bound} of {largest}");
        }
    }
    // If a format cannot hold the mechanism, there is no model in this format, and the manifest states why.
    let manifest: Value = serde_json::from_str(&read("set/manifest.json")).unwrap();
    let model = |k: usize| &manifest["mechanisms"][k]["models"]["xml"];
    assert_eq!(model(0), "swinging_parallelogram/swinging_parallelogram.xml");
    assert!(model(1)["missing"].as_str().unwrap().contains("cycloidal"));
    assert_eq!(
        read("set/swinging_parallelogram/swinging_parallelogram.xml"),
        place.ok("export scenarios/swinging_parallelogram.toml -o -")
    );
    assert!(!place.path("set/boom_lift/boom_lift.xml").exists());
    assert_eq!(read("set/boom_lift/boom_lift.json"), place.ok("export scenarios/boom_lift.toml -o -.json"));
    assert_eq!(manifest["mechanisms"][1]["models"]["json"], "boom_lift/boom_lift.json");
    for ending in ["sdf", "urdf", "usda"] {
        let made = read(&format!("set/swinging_parallelogram/swinging_parallelogram.{ending}"));
        assert_eq!(made, place.ok(&format!("export scenarios/swinging_parallelogram.toml -o -.{ending}")), "{ending}");
    }
}

#[test]
fn an_unknown_mechanism_is_refused_with_the_known_ones() {
    let place = Place::empty();
    let wrong = place.run("golden crank_rokcer");
    assert_eq!(wrong.code, 2);
    assert!(wrong.stderr.contains("crank_rokcer") && wrong.stderr.contains("double_rocker"), "{}", wrong.stderr);
    assert!(!place.path("golden").exists());
    assert_eq!(place.ok("golden --list").lines().count(), 22);
}

/// The files of a set belong together, so a set of other mechanisms is refused before anything is written.
#[test]
fn regress_a_set_is_written_whole_or_not_at_all() {
    let place = Place::new();
    place.ok("golden double_pendulum -o set");
    let other = place.run("golden swinging_parallelogram -o set");
    assert_eq!(other.code, 2, "{}", other.stderr);
    assert!(other.stderr.contains("name a new directory"), "{}", other.stderr);
    assert!(!place.path("set/swinging_parallelogram").exists());
    place.ok("golden double_pendulum -o set");
}
