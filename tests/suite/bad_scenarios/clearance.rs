//! Errors in `[clearance]`.
//! The good scenario has no section `[clearance]`; the tests append one.

use super::{Bad, GOOD, INPUT, assert_refused, parse};

const END: &str = "figures = [{ figure = \"reduced_inertia_mean_kg_m2\", value = 0.16, digits = 2 }]\n";

/// The good scenario with a clearance section.
fn with(section: &str) -> String {
    format!("{GOOD}\n[clearance]\n{section}")
}

fn refused(section: &str, at: &'static str, key: &'static str, words: &[&'static str]) {
    let good = with(section);
    assert!(good.contains(END));
    assert_refused(&good, &Bad { edits: &[], kind: INPUT, at, key, words });
}

#[test]
fn a_good_section_is_read() {
    let text = "radius_mm = 5\nwanted_mm = 1\narea_rel = 1e-2\nignore = [{ bodies = [\"crank\", \"housing\"] }]\n\
                [clearance.outlines.rocker]\nline = [{ x_mm = 0, y_mm = 0 }, { from = \"B\", length_mm = 20, angle_deg = 90 }]\n\
                [[clearance.housing]]\nname = \"wall\"\ncorners = [{ from = \"C\", length_mm = 300, angle_deg = -90 }, \
                { x_mm = 0, y_mm = -400 }, { x_mm = 300, y_mm = -400 }]\n";
    let scenario = parse(&with(text), super::TABLE).unwrap_or_else(|error| panic!("{error}"));
    let asked = scenario.clearance.unwrap();
    assert_eq!((asked.wanted, asked.area, asked.bodies.len()), (Some(1e-3), 1e-2, 4));
    // Crank and rocker are not joined, so their distance is checked.
    // Coupler and rocker are checked against the wall; the crank is exempt.
    assert_eq!(asked.pairs, [[0, 2], [1, 3], [2, 3]]);
    assert_eq!(asked.bodies[2].outline.radius(), 5e-3);
}

#[test]
fn sizes() {
    refused("", "[clearance]", "clearance", &["link \"crank\" has no outline", "radius_mm"]);
    refused("radius_mm = 0\n", "radius_mm = 0", "clearance.radius_mm", &["must be positive"]);
    refused("radius_mm = -3\n", "radius_mm = -3", "clearance.radius_mm", &["must be positive"]);
    refused("radius_mm = nan\n", "radius_mm = nan", "clearance.radius_mm", &["finite"]);
    refused("radius = 3\n", "radius = 3", "clearance.radius", &["has no unit"]);
    refused("radius_mm = 3\nwanted_mm = -1\n", "wanted_mm", "clearance.wanted_mm", &["must not be negative"]);
    refused("radius_mm = 3\ntolerance_mm = 0\n", "tolerance_mm", "clearance.tolerance_mm", &["must be positive"]);
    for share in ["area_rel = 0\n", "area_rel = 1\n", "area_rel = -1\n", "area_rel = 1e-9\n"] {
        refused(
            &format!("radius_mm = 3\n{share}"),
            "area_rel",
            "clearance.area_rel",
            &["allowed error of a swept area", "1e-3"],
        );
    }
    let tiny = "radius_mm = 3\ntolerance_mm = 1e-9\n";
    refused(tiny, "tolerance_mm", "clearance.tolerance_mm", &["more accurately than 3.5e-11 m", "larger tolerance"]);
    refused("radius_m = 1e8\n", "[clearance]", "clearance", &["\"crank\" extends to 1.000e8 m", "check the units"]);
    refused("radius_mm = 3\nareas_rel = 1e-3\n", "areas_rel", "clearance.areas_rel", &["did you mean `area_rel`"]);
}

#[test]
fn outlines() {
    let of = |section: &str| format!("radius_mm = 3\n[clearance.outlines.rocker]\n{section}");
    let key = "clearance.outlines.rocker.corners";
    let corners = |places: &[(f64, f64)]| {
        let places: Vec<String> = places.iter().map(|(x, y)| format!("{{ x_mm = {x:?}, y_mm = {y:?} }}")).collect();
        format!("corners = [{}]\n", places.join(", "))
    };
    refused(
        "radius_mm = 3\n[clearance.outlines.roker]\nradius_mm = 4\n",
        "[clearance.outlines.roker]",
        "clearance.outlines.roker",
        &["there is no link \"roker\"", "did you mean \"rocker\""],
    );
    refused(
        "radius_mm = 3\n[clearance.outlines.ground]\nradius_mm = 4\n",
        "[clearance.outlines.ground]",
        "clearance.outlines.ground",
        &["the ground has no separate outline", "[[clearance.housing]]"],
    );
    refused(&of(&corners(&[(0.0, 0.0), (1.0, 0.0)])), "corners =", key, &["found 2 corners", "three or more"]);
    refused(&of("corners = []\n"), "corners =", key, &["found 0 corners"]);
    refused(&of("line = []\n"), "line =", "clearance.outlines.rocker.line", &["at least one point"]);
    let bow = [(0.0, 0.0), (10.0, 10.0), (10.0, 0.0), (0.0, 10.0)];
    refused(&of(&corners(&bow)), "corners =", key, &["corners 1 and 3 touch or cross", "in their order"]);
    let twice = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 0.0)];
    refused(&of(&corners(&twice)), "corners =", key, &["corners 1 and 4 coincide", "closes automatically"]);
    // Invalid outlines: a side that ends on another side, two equal corners, all corners on one line.
    let touching = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (5.0, 0.0), (0.0, 10.0)];
    refused(&of(&corners(&touching)), "corners =", key, &["touch or cross"]);
    let spike = [(0.0, 0.0), (10.0, 0.0), (20.0, 0.0), (10.0, 10.0), (20.0, 20.0), (0.0, 20.0), (10.0, 10.0)];
    refused(&of(&corners(&spike)), "corners =", key, &["corners 4 and 7 coincide"]);
    let flat = [(0.0, 0.0), (10.0, 0.0), (5.0, 0.0)];
    refused(&of(&corners(&flat)), "corners =", key, &["all corners lie on one line"]);
    let many: Vec<(f64, f64)> = (0..501).map(|k| f64::from(k) * 0.01).map(|a| (a.cos(), a.sin())).collect();
    refused(&of(&corners(&many)), "corners =", key, &["found 501 corners", "at most 500"]);
    refused(
        &of("corners = [{ x_mm = nan, y_mm = 0 }]\n"),
        "corners =",
        "clearance.outlines.rocker.corners[1].x_mm",
        &["finite"],
    );
    refused(
        &of("corners = [{ x_mm = 1, y_m = 1e200 }]\n"),
        "corners =",
        "clearance.outlines.rocker.corners[1].y_m",
        &["1e-100 to 1e9"],
    );
    let both = "corners = [{ x_mm = 1, y_mm = 0 }]\nline = [{ x_mm = 1, y_mm = 0 }]\n";
    refused(&of(both), "line =", "clearance.outlines.rocker.line", &["both given", "keep one"]);
    refused(&of("radius_mm = -1\n"), "radius_mm = -1", "clearance.outlines.rocker.radius_mm", &["must be positive"]);
}

#[test]
fn housing_and_pairs() {
    let of = |section: &str| format!("radius_mm = 3\n[[clearance.housing]]\n{section}");
    refused(
        &of("line = [{ x_mm = 0, y_mm = 0 }]\n"),
        "[[clearance.housing]]",
        "clearance.housing[1]",
        &["`name` is missing"],
    );
    refused(&of("name = \"a b\"\n"), "name = \"a b\"", "clearance.housing.a b.name", &["letters, digits"]);
    refused(&of("name = \"crank\"\n"), "name = \"crank\"", "clearance.housing.crank.name", &["is taken"]);
    refused(&of("name = \"housing\"\n"), "name = \"housing\"", "clearance.housing.housing.name", &["means all parts"]);
    refused(&of("name = \"wall\"\n"), "[[clearance.housing]]", "clearance.housing.wall", &["no outline", "`corners`"]);
    refused(
        "radius_mm = 3\nignore = [{ bodies = [\"crank\", \"wal\"] }]\n",
        "ignore",
        "clearance.ignore[1].bodies",
        &["no link or part of the housing \"wal\""],
    );
    refused(
        "radius_mm = 3\nignore = [{ bodies = [\"crank\"] }]\n",
        "ignore",
        "clearance.ignore[1].bodies",
        &["found 1 names", "a pair has two"],
    );
}
