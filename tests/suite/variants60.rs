//! Sixty study variants: this generator writes the files of scenarios/variants60, and the tests check the statements in
//! them.
//!
//! `LINKPROOF_WRITE=1 cargo test --release --test suite variants60::` writes the files and the table of
//! docs/variants60.md.

mod file;
mod geometry;
mod page;
mod plan;

use crate::common::assert_within;
use std::path::{Path, PathBuf};

use analytic::range::{Extent, Range, SingularityKind};
use analytic::{AssurSolver, NewtonSolver};
use linkage::math::Vec2;
use linkage::math::angle::wrapped;
use linkage::mechanism::{LinkId, LinkPose, Pose};
use linkage::solver::Solver;
use plan::Plan;
use scenario::Scenario;

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn plans() -> Vec<Plan> {
    let all = geometry::variants(include_str!("../../scenarios/variants60/variants.csv"));
    let plans: Vec<Plan> = all.iter().map(Plan::of).collect();
    assert_eq!(plans.len(), 60);
    plans
}

fn scenario(plan: &Plan) -> Scenario {
    Scenario::parse(&file::text(plan), Path::new("variant.toml")).unwrap_or_else(|error| panic!("{error}"))
}

/// With LINKPROOF_WRITE=1, writes the file; otherwise the file must equal the text.
fn written(name: &str, text: &str) {
    let path = path(name);
    if std::env::var_os("LINKPROOF_WRITE").is_some_and(|value| value == "1") {
        std::fs::write(path, text).unwrap();
    } else {
        let found = std::fs::read_to_string(&path).unwrap();
        assert!(found == text, "{name} is not what the generator writes; LINKPROOF_WRITE=1 writes it");
    }
}

#[test]
fn files_and_table_are_what_the_generator_writes() {
    let plans = plans();
    for plan in &plans {
        written(&format!("scenarios/variants60/variant_{:02}.toml", plan.linkage.variant.number), &file::text(plan));
    }
    let scenarios: Vec<Scenario> = plans.iter().map(scenario).collect();
    let page = std::fs::read_to_string(path("docs/variants60.md")).unwrap();
    written("docs/variants60.md", &page::renewed(&page, &plans, &scenarios));
}

/// Limits and smallest transmission angles, by closed forms and by following the mechanism.
/// The files have an accuracy of 1e-12 m.
#[test]
fn closed_form_ranges_match_the_traced_curves() {
    const BOUND: f64 = 1e-6;
    let (mut full, mut crossed) = (0, Vec::new());
    for plan in plans() {
        let range = Range::of(&scenario(&plan).case).unwrap();
        let number = plan.linkage.variant.number;
        match (range.extent, plan.limits) {
            (Extent::FullTurn(1), None) => {
                full += 1;
                // The determinant of a dyad is the sine of its transmission angle; scheme 4 has only the second dyad.
                let least = &plan.least[2 - range.groups.len()..];
                for (group, least) in range.groups.iter().zip(least) {
                    let found = group.determinant.value.abs().asin().to_degrees();
                    assert_within!((found - least).abs(), BOUND, "{number}: {found} for {least}");
                }
            }
            (Extent::Limited(found), Some(expected)) => {
                for (found, expected) in found.iter().zip(expected) {
                    let error = (found.crank.to_degrees() - expected).abs();
                    assert_within!(error, BOUND, "{number}: {error:e}, {found:?}");
                    if found.kind != SingularityKind::DeadPoint {
                        crossed.push((number, found.kind));
                    }
                }
                assert!(plan.smallest() >= plan.kept - BOUND, "{number}: {:?}", plan.least);
            }
            (found, expected) => panic!("{number}: {found:?} for {expected:?}"),
        }
    }
    assert_eq!((full, crossed), (19, vec![(16, SingularityKind::ChangePoint)]));
}

/// Difference (rad) between the angle from `from` to `to`, counter-clockwise, and the angle `expected` (deg).
fn off(from: Vec2, to: Vec2, expected: f64) -> f64 {
    wrapped(to.y.atan2(to.x) - from.y.atan2(from.x) - expected.to_radians()).abs()
}

/// The given pose, constructed without the solvers, closes all joints.
/// If the pose is not singular, both solvers find this pose, with the given angles.
#[test]
fn the_given_pose_closes_all_joints_of_the_file() {
    let mut singular = 0;
    for plan in plans() {
        let (linkage, case) = (&plan.linkage, scenario(&plan).case);
        let v = &linkage.variant;
        let along = |from: Vec2, to: Vec2| LinkPose { origin: from, angle: (to - from).y.atan2((to - from).x) };
        let (origin, rod) = (Vec2::zeros(), along(linkage.a, linkage.b));
        let slider = LinkPose { origin: linkage.b, angle: v.theta.to_radians() };
        let rocker = along(linkage.o2, linkage.d);
        let mut pose = vec![LinkPose::GROUND, along(origin, linkage.a), rod];
        if v.rocker.is_some() {
            pose.extend([slider, along(linkage.c, linkage.d)]);
        }
        pose.push(rocker);
        // Positions in the file are rounded to 1e-12 m, so x and y are each off by at most half of 1e-12 m.
        // The position is then off by at most 1e-12 m divided by the square root of two.
        let closure = Pose(pose.into()).closure(&case.mechanism);
        assert_within!(closure, 1e-12, "{}: {closure:e}", v.number);
        if plan.given < 1e-4 {
            singular += 1;
            continue;
        }
        let time = (v.alpha - plan.start).to_radians() / v.omega;
        for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
            let state = &crate::common::states(solver, &case, &[time]).unwrap()[0];
            let at = |name: &str| {
                let fixed = case.mechanism.links()[LinkId(0)].points.iter().find(|point| point.name == name);
                fixed.map_or_else(
                    || {
                        let (_, side) = case.mechanism.moving_points().find(|&(point, _)| point == name).unwrap();
                        state.motions[side.link].point(side.local)
                    },
                    |point| point.local,
                )
            };
            let [o1, a, b, c, o2] = ["O1", "A", "B", "C", "O2"].map(at);
            let mut errors = vec![off(Vec2::x(), a - o1, v.alpha), off(b - a, o1 - a, v.beta)];
            if v.rocker.is_some() {
                let d = at("D");
                errors.extend([off(b - c, d - c, v.gamma), off(c - d, o2 - d, v.phi)]);
            } else {
                errors.push(off(a - b, o2 - b, v.gamma));
            }
            errors.iter().for_each(|&error| assert_within!(error, 1e-9, "{} {}: {errors:?}", v.number, solver.name()));
        }
    }
    assert_eq!(singular, 3);
}

#[test]
fn structure_and_masses_match_the_interpretation() {
    for plan in plans() {
        let (v, case) = (&plan.linkage.variant, scenario(&plan).case);
        let mechanism = &case.mechanism;
        let (formula, links, joints) = if v.rocker.is_some() {
            ("I(ground, crank) -> II.2 RRP(rod_2, slider) -> II.2 RRR(link_3, rocker_4)", 5, 7)
        } else {
            ("I(ground, crank) -> II.2 RRR(coupler_2, rocker_3)", 3, 4)
        };
        assert_eq!(case.structure.formula(mechanism), formula, "{}", v.number);
        assert_eq!((mechanism.links().len() - 1, mechanism.joints().len()), (links, joints), "{}", v.number);
        assert_eq!(case.structure.mobility, 1);
        let lengths: f64 = v.lengths.iter().sum::<f64>() + v.rocker.unwrap_or(0.0);
        let slider = if v.rocker.is_some() { 1.0 } else { 0.0 };
        let mass: f64 = mechanism.links().iter().map(|link| link.mass).sum();
        // The bound allows for the rounding error of a sum of up to five masses.
        assert_within!((mass - 10.0 * lengths - slider).abs(), 1e-12, "{}: {mass}", v.number);
    }
}
