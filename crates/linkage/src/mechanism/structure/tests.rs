use super::*;
use crate::fixtures::{class_four, four_bar, link, mechanism};
use crate::mechanism::{GroupId, JointId};

#[test]
fn four_bar_is_a_crank_and_a_dyad() {
    let mechanism = four_bar();
    let structure = Structure::of(&mechanism, &[JointId(0)]).unwrap();
    assert_eq!(structure.formula(&mechanism), "I(ground, crank) -> II.2 RRR(coupler, rocker)");
    assert_eq!(structure.mobility, 1);
    assert_eq!(
        (structure.groups[GroupId(0)].inner.as_slice(), structure.groups[GroupId(0)].outer.as_slice()),
        ([JointId(2)].as_slice(), [JointId(1), JointId(3)].as_slice())
    );
}

#[test]
fn driving_the_other_pivot_puts_the_crank_into_the_dyad() {
    let mechanism = four_bar();
    let structure = Structure::of(&mechanism, &[JointId(3)]).unwrap();
    assert_eq!(structure.formula(&mechanism), "I(ground, rocker) -> II.2 RRR(crank, coupler)");
}

/// A crank and a base link on three leads. One of the leads is attached to the crank: class III, order 3.
fn triad() -> Mechanism {
    let links = vec![
        link("ground", &[("O", 0.0, 0.0), ("A", 3.0, 0.0), ("B", 0.0, 3.0)]),
        link("crank", &[("O", 0.0, 0.0), ("C", 1.0, 0.0)]),
        link("lead", &[("C", 0.0, 0.0), ("F", 1.0, 0.0)]),
        link("base", &[("D", 0.0, 0.0), ("E", 1.0, 0.0), ("F", 0.0, 1.0)]),
        link("left", &[("A", 0.0, 0.0), ("D", 1.0, 0.0)]),
        link("right", &[("B", 0.0, 0.0), ("E", 1.0, 0.0)]),
    ];
    let pins = [
        ("O", "O", "ground", "crank"),
        ("C", "C", "crank", "lead"),
        ("F", "F", "lead", "base"),
        ("D", "D", "base", "left"),
        ("E", "E", "base", "right"),
        ("A", "A", "ground", "left"),
        ("B", "B", "ground", "right"),
    ];
    mechanism(links, &pins).unwrap()
}

#[test]
fn a_base_link_on_three_leads_is_class_three_order_three() {
    let mechanism = triad();
    let structure = Structure::of(&mechanism, &[JointId(0)]).unwrap();
    assert_eq!(structure.formula(&mechanism), "I(ground, crank) -> III.3(lead, base, left, right)");
}

#[test]
fn driving_a_lead_of_the_triad_lowers_the_class() {
    let mechanism = triad();
    let structure = Structure::of(&mechanism, &[JointId(5)]).unwrap();
    assert_eq!(structure.formula(&mechanism), "I(ground, left) -> II.2 RRR(base, right) -> II.2 RRR(crank, lead)");
}

#[test]
fn a_changeable_quadrilateral_is_class_four_order_two() {
    let mechanism = class_four(1.0, -1.0);
    let structure = Structure::of(&mechanism, &[JointId(0)]).unwrap();
    assert_eq!(structure.formula(&mechanism), "I(ground, 1) -> IV.2(2, 3, 4, 5)");
}

#[test]
fn a_rigid_part_is_found_despite_the_right_mobility() {
    let links = vec![
        link("ground", &[("O", 0.0, 0.0), ("P", 4.0, 0.0)]),
        link("crank", &[("O", 0.0, 0.0), ("A", 1.0, 0.0)]),
        link("coupler", &[("A", 0.0, 0.0), ("P", 4.0, 0.0)]),
        link("loose", &[("A", 0.0, 0.0)]),
    ];
    let pins = [
        ("O", "O", "ground", "crank"),
        ("A", "A", "crank", "coupler"),
        ("P", "P", "ground", "coupler"),
        ("A2", "A", "crank", "loose"),
    ];
    let mechanism = mechanism(links, &pins).unwrap();
    assert_eq!(mobility(&mechanism), 1);
    let error = Structure::of(&mechanism, &[JointId(0)]).unwrap_err();
    assert!(error.to_string().contains("crank, coupler are over-constrained"), "{error}");
}

#[test]
fn two_links_with_two_common_pins_are_over_constrained() {
    let links = vec![
        link("ground", &[("O", 0.0, 0.0)]),
        link("crank", &[("O", 0.0, 0.0), ("A", 1.0, 0.0)]),
        link("a", &[("A", 0.0, 0.0), ("P", 1.0, 0.0), ("Q", 0.0, 1.0)]),
        link("b", &[("P", 0.0, 0.0), ("Q", -1.0, 1.0)]),
    ];
    let pins = [("O", "O", "ground", "crank"), ("A", "A", "crank", "a"), ("P", "P", "a", "b"), ("Q", "Q", "a", "b")];
    let mechanism = mechanism(links, &pins).unwrap();
    assert_eq!(mobility(&mechanism), 1);
    let error = Structure::of(&mechanism, &[JointId(0)]).unwrap_err();
    assert!(error.to_string().contains("a, b are over-constrained"), "{error}");
}

#[test]
fn an_over_constrained_floating_part_is_found() {
    // Four links in a ring, and a fifth joint between two of them: 10 equations, one more than the limit 3*4 - 3.
    // An additional loose link gives the whole mechanism the correct mobility.
    let links = vec![
        link("ground", &[("O", 0.0, 0.0)]),
        link("crank", &[("O", 0.0, 0.0), ("A", 1.0, 0.0)]),
        link("1", &[("S", 0.0, 0.0), ("P", 1.0, 0.0), ("A", 0.5, 0.5), ("X", 2.0, 0.0)]),
        link("2", &[("P", 0.0, 0.0), ("Q", 1.0, 0.0)]),
        link("3", &[("Q", 0.0, 0.0), ("R", 1.0, 0.0), ("X", 3.0, 0.0)]),
        link("4", &[("R", 0.0, 0.0), ("S", 1.0, 0.0)]),
        link("loose", &[("A", 0.0, 0.0)]),
    ];
    let pins = [
        ("O", "O", "ground", "crank"),
        ("A", "A", "crank", "1"),
        ("P", "P", "1", "2"),
        ("Q", "Q", "2", "3"),
        ("R", "R", "3", "4"),
        ("S", "S", "4", "1"),
        ("X", "X", "1", "3"),
        ("A2", "A", "1", "loose"),
    ];
    let mechanism = mechanism(links, &pins).unwrap();
    let error = Structure::of(&mechanism, &[JointId(0), JointId(1)]).unwrap_err();
    assert!(error.to_string().contains("over-constrained"), "{error}");
    assert!(!error.to_string().contains("loose"), "{error}");
}

#[test]
fn loose_links_and_missing_drives_are_refused() {
    let links = vec![link("ground", &[("O", 0.0, 0.0)]), link("a", &[("O", 0.0, 0.0)]), link("b", &[])];
    let alone = mechanism(links.clone(), &[("O", "O", "ground", "a")]).unwrap();
    assert!(Structure::of(&alone, &[JointId(0)]).unwrap_err().to_string().contains("not connected to the ground"));
    let message = Structure::of::<JointId>(&four_bar(), &[]).unwrap_err().to_string();
    assert!(message.contains("W = 3*3 - 2*4 = 1, but the number of drives is 0"), "{message}");
}
