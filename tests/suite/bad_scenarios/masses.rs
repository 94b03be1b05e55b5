//! Masses that do not fit the mechanism, for example because of a wrong unit.

use super::{Bad, GOOD, INPUT, assert_refused};

#[test]
fn mass_centres_and_inertias_beyond_the_mechanism_are_refused() {
    let far = ("mass_centre = { x_mm = 13, y_mm = 0 }", "mass_centre = { x_m = 1300, y_m = 0 }");
    let words: &[&str] =
        &["link \"crank\"", "times the largest link", "check the unit", "add a point at the mass centre"];
    let key = "links.crank.mass_centre";
    assert_refused(GOOD, &Bad { edits: &[far], kind: INPUT, at: "mass_centre", key, words });
    // This edit gives the rocker a mass, with which the crank's mass and inertia are compared.
    let rod = (
        "[links.rocker.points]",
        "[links.rocker]\nmass_kg = 1\nmass_centre = { x_mm = 0, y_mm = 0 }\n[links.rocker.points]",
    );
    let words: &[&str] = &["link \"crank\"", "the sum over all other links", "check the unit"];
    let heavy = ("inertia_kg_m2 = 0.0002", "inertia_kg_m2 = 2e14");
    let key = "links.crank.inertia";
    assert_refused(GOOD, &Bad { edits: &[rod, heavy], kind: INPUT, at: "[links.crank]", key, words });
    let heavy = ("mass_kg = 2.6", "mass_kg = 2.6e20");
    let key = "links.crank.mass";
    assert_refused(GOOD, &Bad { edits: &[rod, heavy], kind: INPUT, at: "[links.crank]", key, words });
}

#[test]
fn large_and_heavy_links_within_precision_are_accepted() {
    let taken = |from: &str, to: &str| {
        assert!(GOOD.contains(from));
        super::parse(&GOOD.replacen(from, to, 1), super::TABLE).unwrap_or_else(|error| panic!("{to}: {error}"))
    };
    taken("{ x_mm = 13, y_mm = 0 }", "{ x_m = 300, y_m = 0 }");
    // The limit applies to the distance between a mass centre and the nearest point of its link. With a point at the
    // mass centre this distance is zero, so the mass centre is accepted.
    let point = "mass_centre = { x_mm = 13, y_mm = 0 }\n[links.crank.points]";
    taken(point, "mass_centre = { x_m = 1300, y_m = 0 }\n[links.crank.points]\nG = { x_m = 1300, y_m = 0 }");
    // This large inertia is accepted, because no other link has a mass with which the inertia could be compared.
    taken("inertia_kg_m2 = 0.0002", "inertia_kg_m2 = 2e14");
}
