//! Mechanisms built without a scenario file, for unit tests.
//! The crate `linkproof-fixtures` compiles this file too, for the tests of other crates.

use crate::Result;
use crate::case::{Case, CaseParts, Grid, Wanted};
use crate::drive::{Drive, Drives, MotionLaw};
use crate::math::Vec2;
use crate::mechanism::{
    AssemblyMode, Joint, JointId, JointKind, JointSide, Link, LinkId, Mechanism, Point, StartGroup, Structure,
    first_pose,
};

/// A massless link with these points.
pub fn link(name: &str, points: &[(&str, f64, f64)]) -> Link {
    Link {
        name: name.into(),
        points: points.iter().map(|&(n, x, y)| Point { name: n.into(), local: Vec2::new(x, y) }).collect(),
        mass: 0.0,
        mass_centre: Vec2::zeros(),
        inertia: 0.0,
    }
}

/// A revolute joint called `name` between the links `first` and `second`, at the point `point` of both links.
pub fn pin(links: &[Link], name: &str, point: &str, first: &str, second: &str) -> Joint {
    let side = |wanted: &str| {
        let index = links.iter().position(|l| l.name == wanted).unwrap();
        let local = links[index].points.iter().find(|p| p.name == point).unwrap().local;
        JointSide { link: LinkId(index), local }
    };
    Joint { name: name.into(), kind: JointKind::Revolute, first: side(first), second: side(second), drawn: None }
}

/// Mechanism of links and pins. Each pin is given as (joint name, point, first link, second link).
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

/// Mechanism of `scenarios/fourth_class.toml`: crank 1 = OA, triangles 2 = A-C-B and 5 = K-E-D, links 3 = BD, 4 = CE.
/// Point B is C rotated about A by +60 deg (`side_b` = 1) or -60 deg (-1).
/// Point D is E rotated about K by +60 deg (`side_d` = 1) or -60 deg (-1).
pub fn class_four(side_b: f64, side_d: f64) -> Mechanism {
    let (x, y) = (15e-3, 30e-3 * 0.75f64.sqrt());
    let links = vec![
        link("ground", &[("O", 0.0, 0.0), ("K", 85e-3, -15e-3)]),
        link("1", &[("O", 0.0, 0.0), ("A", 10e-3, 0.0)]),
        link("2", &[("A", 0.0, 0.0), ("C", 30e-3, 0.0), ("B", x, side_b * y)]),
        link("3", &[("B", 0.0, 0.0), ("D", 51e-3, 0.0)]),
        link("4", &[("C", 0.0, 0.0), ("E", 40e-3, 0.0)]),
        link("5", &[("K", 0.0, 0.0), ("E", 30e-3, 0.0), ("D", x, side_d * y)]),
    ];
    let pins = [
        ("O", "O", "ground", "1"),
        ("A", "A", "1", "2"),
        ("B", "B", "2", "3"),
        ("C", "C", "2", "4"),
        ("D", "D", "3", "5"),
        ("E", "E", "4", "5"),
        ("K", "K", "ground", "5"),
    ];
    mechanism(links, &pins).unwrap()
}

/// A case of a mechanism of dyads. All dyads have the mode `Left`.
/// Joint 0 drives link 1 from angle zero at 1 rad/s. The case has no gravity, no load and no grid.
pub fn turning(mechanism: Mechanism) -> Case {
    let left = StartGroup { mode: Some(AssemblyMode::Left), ..StartGroup::default() };
    turning_from(mechanism, 0.0, &left)
}

/// A case as from `turning`, for a mechanism with Assur groups of any kind.
/// The case starts at the crank angle `crank` (rad). `group` gives the required start configuration of every group.
pub fn turning_from(mechanism: Mechanism, crank: f64, group: &StartGroup) -> Case {
    let drives = Drives::from(Drive::prescribed(JointId(0), LinkId(1), 0.0, crank, MotionLaw::ConstantSpeed(1.0)));
    let structure = Structure::of(&mechanism, &drives.joints()).unwrap();
    let groups = vec![group.clone(); structure.groups.len()];
    let (start, modes) = first_pose(&mechanism, &structure, &drives.coordinates(crank), &groups).unwrap();
    Case::new(CaseParts {
        mechanism,
        structure,
        drives,
        loads: Vec::new(),
        gravity: Vec2::zeros(),
        start,
        modes,
        grid: Grid::default(),
        wanted: Wanted::ALL,
        only: None,
    })
    .unwrap()
}
