//! Mechanisms built without a scenario file, for unit tests.

use super::*;

/// A massless link from its points.
pub fn link(name: &str, points: &[(&str, f64, f64)]) -> Link {
    Link {
        name: name.into(),
        points: points.iter().map(|&(n, x, y)| Point { name: n.into(), local: Vec2::new(x, y) }).collect(),
        mass: 0.0,
        mass_centre: Vec2::zeros(),
        inertia: 0.0,
    }
}

/// A revolute joint at the point `point` that both links carry.
pub fn pin(links: &[Link], name: &str, point: &str, first: &str, second: &str) -> Joint {
    let side = |wanted: &str| {
        let index = links.iter().position(|l| l.name == wanted).unwrap();
        let local = links[index].points.iter().find(|p| p.name == point).unwrap().local;
        Side { link: index, local }
    };
    Joint { name: name.into(), kind: JointKind::Revolute, first: side(first), second: side(second) }
}

/// Mechanism from links and pins given as (joint name, point, first link, second link).
pub fn mechanism(links: Vec<Link>, pins: &[(&str, &str, &str, &str)]) -> Result<Mechanism> {
    let joints = pins.iter().map(|&(n, p, a, b)| pin(&links, n, p, a, b)).collect();
    Mechanism::new(links, joints)
}

/// Four-bar: ground O (0, 0) and C (4, 0), crank OA = 1, coupler AB = 4, rocker CB = 3.
pub fn four_bar() -> Mechanism {
    let links = vec![
        link("ground", &[("O", 0.0, 0.0), ("C", 4.0, 0.0)]),
        link("crank", &[("O", 0.0, 0.0), ("A", 1.0, 0.0)]),
        link("coupler", &[("A", 0.0, 0.0), ("B", 4.0, 0.0)]),
        link("rocker", &[("C", 0.0, 0.0), ("B", 3.0, 0.0)]),
    ];
    let pins = [
        ("O", "O", "ground", "crank"),
        ("A", "A", "crank", "coupler"),
        ("B", "B", "coupler", "rocker"),
        ("C", "C", "ground", "rocker"),
    ];
    mechanism(links, &pins).unwrap()
}
