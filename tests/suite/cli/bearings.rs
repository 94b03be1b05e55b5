//! `linkproof bearings`: the largest loads are found wherever they occur.

use std::fs;

use serde_json::Value;

use super::tools::{Place, Table};
use crate::common::assert_within;
use linkage::math::KeepNan;

/// Largest reaction in a joint (N) and the input at which it occurs, from the report of `bearings`.
fn largest(place: &Place, file: &str, joint: &str, input: &str) -> (f64, f64) {
    let value: Value = serde_json::from_str(&place.ok(&format!("bearings {file} --json -"))).unwrap();
    let own = value["joints"].as_array().unwrap().iter().find(|own| own["joint"] == joint).unwrap();
    (own["reaction"]["N"].as_f64().unwrap(), own["reaction"][input].as_f64().unwrap())
}

/// The reactions in a joint (N) in a table of `solve`.
fn magnitudes(solved: &str, joint: &str) -> Vec<f64> {
    let [x, y] = ["x", "y"].map(|axis| Table::of(solved).column(&format!("joint.{joint}.f{axis}_N")));
    x.iter().zip(&y).map(|(x, y)| x.hypot(*y)).collect()
}

/// The piston moves slowly near its dead points, where equal steps of the slide are long in time.
#[test]
fn regress_peaks_near_the_ends_of_a_law_are_found() {
    let place = Place::new();
    let solved = place.ok("solve scenarios/piston_engine.toml --times 0:0.25:0.0005 --only joint.O -o -");
    let expected = magnitudes(&solved, "O").into_iter().fold(0.0, f64::larger);
    let (force, at) = largest(&place, "scenarios/piston_engine.toml", "O", "slide_m");
    assert_within!((force / expected - 1.0).abs(), 1e-3, "{force} {expected}");
    assert!(force >= expected, "{force} {expected}");
    assert_within!((at - 0.227_895).abs(), 1e-5, "{at}");
}

/// A force that acts over a tenth of a degree only.
#[test]
fn regress_a_narrow_peak_of_a_load_is_found() {
    let place = Place::empty();
    place.ok("new four-bar");
    let load = "\n[[loads]]\ntype = \"force\"\nlink = \"rocker\"\npoint = \"B\"\ntable = [\n\
                { crank_deg = 0, x_N = 0, y_N = 0 }, { crank_deg = 100.2, x_N = 0, y_N = 0 },\n\
                { crank_deg = 100.25, x_N = 5000, y_N = 0 }, { crank_deg = 100.3, x_N = 0, y_N = 0 }]\n";
    let text = fs::read_to_string(place.path("four_bar.toml")).unwrap() + load;
    fs::write(place.path("spike.toml"), text).unwrap();
    let solved = place.ok("solve spike.toml --crank-deg 100.25 --only joint.C -o -");
    let expected = magnitudes(&solved, "C")[0];
    let (force, at) = largest(&place, "spike.toml", "C", "crank_rad");
    assert_within!((force / expected - 1.0).abs(), 1e-9, "{force} {expected}");
    assert_within!((at.to_degrees() - 100.25).abs(), 1e-9, "{at}");
}

/// Bearings of a free motion have the loads of its nominal motion, which is said.
#[test]
fn loads_of_a_nominal_motion_are_named_as_such() {
    let found = Place::new().run("bearings scenarios/pendulum.toml");
    assert!(found.code == 0 && found.stderr.contains("nominal motion"), "{}", found.stderr);
}
