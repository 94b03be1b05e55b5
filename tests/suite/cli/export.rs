//! `linkproof export`.

use std::fs;

use super::tools::Place;
use crate::common::assert_within;

#[test]
fn mjcf_goes_where_it_is_told() {
    let place = Place::new();
    let text = place.ok("export scenarios/crank_rocker.toml --mjcf -");
    let document = roxmltree::Document::parse(&text).unwrap();
    assert_eq!(document.root_element().attribute("model"), Some("crank_rocker"));
    // The scenario gives no step: a quarter of a degree of the crank, unless another is given.
    let step = |text: &str| {
        let document = roxmltree::Document::parse(text).unwrap();
        let option = document.descendants().find(|node| node.has_tag_name("option")).unwrap();
        option.attribute("timestep").unwrap().parse::<f64>().unwrap()
    };
    assert_within!((step(&text) * 130.0 * 6.0 - 0.25).abs(), 1e-12);
    assert_eq!(step(&place.ok("export scenarios/crank_rocker.toml --mjcf - --dt 2e-5")), 2e-5);
    assert_eq!(place.ok("export scenarios/crank_rocker.toml --mjcf model.mjcf"), "");
    assert_eq!(fs::read_to_string(place.path("model.mjcf")).unwrap(), text);
    // The user did not choose the name, so it is printed.
    assert_eq!(place.ok("export scenarios/crank_rocker.toml --mjcf"), "crank_rocker.xml\n");
    assert_eq!(fs::read_to_string(place.path("crank_rocker.xml")).unwrap(), text);
}

#[test]
fn the_mode_moves_the_start_pose() {
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
fn wrong_requests_are_refused() {
    let place = Place::new();
    place.refused("export scenarios/crank_rocker.toml", &["--mjcf"]);
    place.refused("export --mjcf scenarios/crank_rocker.toml", &["scenario file"]);
    place.refused("export scenarios/crank_rocker.toml --mjcf - --dt -1e-3", &["time step", "positive"]);
    place.refused("export scenarios/crank_rocker.toml --mjcf no/such/place.xml", &["cannot be written"]);
    place.refused("export scenarios/crank_rocker.toml --mjcf - --mode coupler,rocker=up", &["--mode"]);
    place.refused("export scenarios/none.toml --mjcf -", &["cannot be read"]);
}
