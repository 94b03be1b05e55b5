//! Mechanisms with given joint coordinates: both solvers agree, and the powers balance.

use std::f64::consts::FRAC_PI_2;

use linkage::case::{Case, CaseBuilder};
use linkage::drive::MotionLaw;
use linkage::math::KeepNan;
use linkage::mechanism::AssemblyMode::{self, Left, Only};
use linkage::solver::{Solver, State};

use linkproof_analytic::witness::power;
use linkproof_analytic::{AssurSolver, NewtonSolver};

fn states(case: &Case, solver: &dyn Solver) -> Vec<State> {
    let mut all = Vec::new();
    let mut visit = |_, state: &State| {
        all.push(state.clone());
        Ok(())
    };
    solver.sweep(case, &mut visit, &mut |_| {}).unwrap_or_else(|error| panic!("{}: {error}", solver.name()));
    all
}

/// Asserts that both solvers agree and that the powers sum to zero.
/// The numbers of a state form four lists, and each difference is compared with the largest number of its list.
fn agrees(case: &Case) -> Vec<State> {
    let [one, other] = [states(case, &AssurSolver), states(case, &NewtonSolver)];
    let numbers = |state: &State| -> Vec<Vec<f64>> {
        let motions = state.motions.iter().flat_map(|own| [own.origin, own.velocity, own.acceleration]);
        let spins = state.motions.iter().flat_map(|own| [own.omega, own.alpha]);
        vec![
            motions.flat_map(|own| [own.x, own.y]).collect(),
            spins.chain(state.angles.iter().copied()).collect(),
            state.forces.iter().flat_map(|own| [own.x, own.y]).collect(),
            state.moments.iter().chain(&state.torques).copied().collect(),
        ]
    };
    for (a, b) in one.iter().zip(&other) {
        for (a, b) in numbers(a).iter().zip(&numbers(b)) {
            let scale = a.iter().fold(1e-9, |most: f64, own| most.larger(own.abs()));
            let off = a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.larger((a - b).abs()));
            assert!(off <= 1e-11 * scale, "{off:e} of {scale:e}: {a:?} {b:?}");
        }
        let given: f64 = case
            .drives
            .iter()
            .zip(&a.torques)
            .map(|(drive, effort)| effort * case.drive_state(drive, &a.motions, &a.angles).rate)
            .sum();
        let known = power::of_known_forces(case, a);
        assert!((given + known).abs() <= 1e-9 * known.abs().larger(1.0), "{given} {known}");
    }
    one
}

fn ramp(rise: f64) -> MotionLaw {
    MotionLaw::Cycloidal { rise, time: 1.0 }
}

const TIMES: [f64; 7] = [0.0, 0.1, 0.25, 0.4, 0.55, 0.8, 1.0];

/// A boom on the ground at O, lifted by a cylinder between C on the ground and B on the boom.
fn boom() -> CaseBuilder {
    Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("C", [0.6, -0.4])])
        .link("boom", &[("O", [0.0, 0.0]), ("B", [1.0, 0.1]), ("T", [2.0, 0.0])])
        .link("cylinder", &[("C", [0.0, 0.0]), ("G", [0.05, 0.02])])
        .link("rod", &[("H", [0.0, 0.02]), ("B", [0.45, 0.0])])
        .mass("boom", 40.0, [0.9, 0.05], 12.0)
        .mass("cylinder", 8.0, [0.2, 0.01], 0.3)
        .mass("rod", 5.0, [0.2, 0.0], 0.2)
        .pin("O", "ground", "boom")
        .pin("C", "ground", "cylinder")
        .pin("B", "rod", "boom")
        .slider("S", ("cylinder", "G"), ("rod", "H"), [0.1, 0.1])
        .gravity([0.0, -9.81])
        .times(&TIMES)
}

#[test]
fn val_a_boom_lifted_by_a_cylinder() {
    let case = boom().start(0.3).driven("S", ramp(0.25)).mode(&["boom", "cylinder", "rod"], Left).build().unwrap();
    let formula = case.structure.formula(&case.mechanism);
    assert_eq!(formula, "II.2 RRR(boom, cylinder+rod)");
    agrees(&case);
}

/// The boom with the links of the driven joint in the opposite order: the signs of slide and force are opposite.
#[test]
fn the_order_of_the_links_changes_the_sign_alone() {
    let one = boom().start(0.3).driven("S", ramp(0.25)).mode(&["boom", "cylinder", "rod"], Left).build().unwrap();
    let mut parts = one.clone().into_parts();
    let mut joints = parts.mechanism.joints().to_vec();
    let index = parts.drives.crank().joint;
    let joint = &mut joints[index.index()];
    std::mem::swap(&mut joint.first, &mut joint.second);
    if let linkage::mechanism::JointKind::Prismatic { axes } = &mut joint.kind {
        axes.swap(0, 1);
    }
    parts.mechanism = linkage::mechanism::Mechanism::new(parts.mechanism.links().to_vec(), joints).unwrap();
    let drive = parts.drives.crank_mut();
    (drive.start, drive.link) = (-0.3, linkage::mechanism::LinkId(2));
    drive.motion = linkage::drive::DriveMotion::Prescribed { law: ramp(-0.25), motor: None };
    parts.structure = linkage::mechanism::Structure::of(&parts.mechanism, &parts.drives.joints()).unwrap();
    parts.grid = linkage::case::Grid::of_times(parts.drives.crank(), TIMES.to_vec());
    let other = Case::new(parts).unwrap();
    for (a, b) in agrees(&one).iter().zip(&agrees(&other)) {
        assert!((a.torques[0] + b.torques[0]).abs() < 1e-9 * a.torques[0].abs());
        assert!(a.angles.iter().zip(&b.angles).all(|(a, b)| (a - b).abs() < 1e-13));
    }
}

/// A piston on the ground drives a slider-crank: the coordinate of the prismatic joint on the ground is given.
#[test]
fn val_a_piston_drives_a_crank() {
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("D", [0.0, 0.02])])
        .link("piston", &[("B", [0.0, 0.0]), ("P", [0.05, 0.0])])
        .link("rod", &[("A", [0.0, 0.0]), ("B", [0.4, 0.0])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
        .mass("piston", 2.0, [0.01, 0.0], 0.01)
        .mass("rod", 1.0, [0.2, 0.0], 0.02)
        .mass("crank", 3.0, [0.02, 0.0], 0.04)
        .pin("O", "ground", "crank")
        .pin("A", "crank", "rod")
        .pin("B", "rod", "piston")
        .slider("S", ("ground", "D"), ("piston", "P"), [0.0, 0.0])
        .gravity([0.0, -9.81])
        .times(&TIMES)
        .start(0.47)
        .driven("S", ramp(-0.08))
        .mode(&["rod", "crank"], Left)
        .build()
        .unwrap();
    assert_eq!(case.structure.formula(&case.mechanism), "I(ground, piston) -> II.2 RRR(rod, crank)");
    agrees(&case);
}

fn four_bar() -> CaseBuilder {
    Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("C", [0.4, 0.0])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
        .link("coupler", &[("A", [0.0, 0.0]), ("B", [0.35, 0.0]), ("E", [0.1, 0.1])])
        .link("rocker", &[("C", [0.0, 0.0]), ("B", [0.2, 0.0])])
        .mass("crank", 1.0, [0.05, 0.0], 0.01)
        .mass("coupler", 2.0, [0.2, 0.0], 0.02)
        .mass("rocker", 1.5, [0.1, 0.0], 0.03)
        .pin("O", "ground", "crank")
        .pin("A", "crank", "coupler")
        .pin("B", "coupler", "rocker")
        .pin("C", "ground", "rocker")
        .gravity([0.0, -9.81])
        .times(&TIMES)
}

#[test]
fn val_a_four_bar_driven_at_the_joint_between_crank_and_coupler() {
    let case =
        four_bar().start(-0.9).driven("A", ramp(0.5)).mode(&["crank", "coupler", "rocker"], Left).build().unwrap();
    assert_eq!(case.structure.formula(&case.mechanism), "II.2 RRR(crank+coupler, rocker)");
    agrees(&case);
}

#[test]
fn val_a_link_driven_on_a_coupler() {
    let case = four_bar()
        .link("tool", &[("E", [0.0, 0.0]), ("F", [0.1, 0.0])])
        .mass("tool", 0.7, [0.05, 0.01], 0.002)
        .pin("E", "coupler", "tool")
        .start(FRAC_PI_2)
        .crank("O", 3.0)
        .driven_from("E", 0.4, ramp(1.5))
        .mode(&["coupler", "rocker"], Left)
        .mode(&["tool"], Only)
        .build()
        .unwrap();
    assert_eq!(
        case.structure.formula(&case.mechanism),
        "I(ground, crank) -> II.2 RRR(coupler, rocker) -> I(coupler, tool)"
    );
    agrees(&case);
}

/// A platform on three cylinders: the class III group of the textbooks.
#[test]
fn val_a_platform_on_three_cylinders() {
    let mut builder = Case::builder()
        .ground(&[("A1", [0.0, 0.0]), ("A2", [1.0, 0.0]), ("A3", [0.5, 0.9])])
        .link("platform", &[("B1", [0.0, 0.0]), ("B2", [0.3, 0.0]), ("B3", [0.15, 0.25])])
        .mass("platform", 10.0, [0.15, 0.08], 0.5)
        .gravity([0.0, -9.81])
        .times(&TIMES);
    for leg in ["1", "2", "3"] {
        let [cylinder, rod, base, end, guide, block] =
            ["cyl", "rod", "A", "B", "G", "H"].map(|own| format!("{own}{leg}"));
        builder = builder
            .link(&cylinder, &[(&base, [0.0, 0.0]), (&guide, [0.1, 0.0])])
            .link(&rod, &[(&end, [0.2, 0.0]), (&block, [0.0, 0.0])])
            .mass(&cylinder, 2.0, [0.1, 0.0], 0.02)
            .mass(&rod, 1.0, [0.1, 0.0], 0.01)
            .pin(&base, "ground", &cylinder)
            .pin(&end, &rod, "platform")
            .slider(&format!("S{leg}"), (&cylinder, &guide), (&rod, &block), [0.0, 0.0]);
    }
    let starts = [0.2, 0.25, 0.22];
    let case = builder
        .start(starts[0])
        .driven("S1", ramp(0.05))
        .driven_from("S2", starts[1], ramp(-0.04))
        .driven_from("S3", starts[2], MotionLaw::ConstantSpeed(0.03))
        .mode(&["platform", "cyl1", "rod1", "cyl2", "rod2", "cyl3", "rod3"], AssemblyMode::Followed)
        .build()
        .unwrap();
    assert_eq!(case.structure.formula(&case.mechanism), "III.3(platform, cyl1+rod1, cyl2+rod2, cyl3+rod3)");
    agrees(&case);
}

/// Two links in series, each driven relative to the link before it, and a telescope on the second link.
#[test]
fn val_an_arm_with_relative_drives() {
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0])])
        .link("upper", &[("O", [0.0, 0.0]), ("A", [0.5, 0.0])])
        .link("lower", &[("A", [0.0, 0.0]), ("G", [0.2, 0.1])])
        .link("tip", &[("H", [0.0, 0.0]), ("T", [0.1, 0.0])])
        .mass("upper", 5.0, [0.25, 0.0], 0.1)
        .mass("lower", 3.0, [0.2, 0.0], 0.05)
        .mass("tip", 1.0, [0.05, 0.0], 0.01)
        .pin("O", "ground", "upper")
        .pin("A", "upper", "lower")
        .slider("S", ("lower", "G"), ("tip", "H"), [0.3, 0.1])
        .gravity([0.0, -9.81])
        .times(&TIMES)
        .start(0.3)
        .driven("O", ramp(1.0))
        .driven_from("A", -0.5, ramp(1.3))
        .driven_from("S", 0.1, ramp(0.2))
        .build()
        .unwrap();
    assert_eq!(case.structure.formula(&case.mechanism), "I(ground, upper) -> I(upper, lower) -> I(lower, tip)");
    agrees(&case);
}
