//! `linkproof inspect --range`, and the messages of commands about crank angles out of reach.

use super::tools::Place;
use crate::common::assert_within;

#[test]
fn a_crank_rocker_is_reported_with_its_extreme_positions() {
    let place = Place::new();
    let text = place.ok("inspect scenarios/crank_rocker.toml --range");
    for words in
        ["turns fully", "crank-rocker", "No singular pose", "over 32.000000 deg", "33.610820", "234.862320", "15.2871"]
    {
        assert!(text.contains(words), "`{words}` is not in:\n{text}");
    }
    let outcome = place.run("inspect scenarios/crank_rocker.toml --range --json -");
    let range = &outcome.json()["range"];
    assert_eq!(range["extent"]["full_turn"], true);
    assert_eq!(range["links"][2]["extremes"].as_array().unwrap().len(), 2);
    let samples = range["samples"]["crank_rad"].as_array().unwrap();
    assert!(samples.len() >= 180);
    for column in ["determinant", "condition"] {
        let column = range["samples"]["groups"][0][column].as_array().unwrap();
        assert!(column.len() == samples.len() && column.iter().all(|value| value.as_f64().is_some()));
    }
}

/// A crank lengthened to 0.15 m, with a frame of 0.150748 m, coupler 0.347072 m and rocker 0.25 m.
/// The lengthened crank cannot rotate fully.
#[test]
fn a_limited_crank_is_reported_with_its_limits() {
    let place = Place::new();
    place.edited(
        "crank_rocker.toml",
        "limited.toml",
        &[
            ("A = { x_m = 0.025995627740337, y_m = 0 }", "A = { x_m = 0.15, y_m = 0 }"),
            ("crank_deg = 0\n", "crank_deg = 90\n"),
        ],
    );
    let text = place.ok("inspect scenarios/limited.toml --range");
    for words in ["from ", "triple-rocker", "limit of rotation (dead point)", "unbounded", "coupler, rocker"] {
        assert!(text.contains(words), "`{words}` is not in:\n{text}");
    }
    let range = place.run("inspect scenarios/limited.toml --range --json -").json()["range"].clone();
    let [from, to] = ["from_rad", "to_rad"].map(|key| range["extent"][key].as_f64().unwrap());
    // The dyad is folded at both limits: |AC| = AB - CB.
    let (a, d, reach) = (0.15f64, 0.15f64.hypot(0.015), 0.347_071_931_891_81 - 0.25);
    let half = ((a * a + d * d - reach * reach) / (2.0 * a * d)).acos();
    let base = 0.015f64.atan2(0.15);
    assert_within!((from - (base + half)).abs(), 1e-9, "{from} {to}");
    assert_within!((to - (base - half + std::f64::consts::TAU)).abs(), 1e-9, "{from} {to}");
    // The message rounds the limit inwards at the sixth decimal, so the first three decimals stay unchanged.
    let interval = format!("from {:.3}", from.to_degrees());
    for command in [
        "solve scenarios/limited.toml --with assur",
        "solve scenarios/limited.toml --with newton",
        "run scenarios/limited.toml --no-record",
        "inspect scenarios/limited.toml --modes --crank-deg 0",
    ] {
        place.refused(command, &["; reachable crank angles: ", &interval, "deg on this branch"]);
    }
}

#[test]
fn range_and_modes_exclude_each_other() {
    Place::new().refused("inspect scenarios/crank_rocker.toml --range --modes", &["cannot be used with"]);
}

#[test]
fn a_range_search_keeps_to_the_work_limit() {
    let place = Place::new();
    place.refused("inspect scenarios/crank_rocker.toml --range --budget 10", &["1.0e1 steps", "--budget 1e2"]);
    place.refused("inspect scenarios/crank_rocker.toml --budget 10", &["--range"]);
    let told = place.ok("inspect scenarios/crank_rocker.toml --range --budget 1e5");
    assert_eq!(told, place.ok("inspect scenarios/crank_rocker.toml --range"));
}
