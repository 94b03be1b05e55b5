//! Long chains, and links without mass, whose stand-in masses enter the impulses of an engine.

use analytic::AssurSolver;
use linkage::case::{Case, Grid};
use linkage::engine::{Route, Settings};
use linkage::math::{KeepNan, Vec2};
use linkage::trajectory::{Stage, Trajectory};
use prover::bounds::residuals;

use super::solve;
use crate::common::assert_within;
use crate::common::spec::{Dyad, Pin, Spec, SpecimenLink, four_bar};

/// A four-bar, followed by four dyads; twelve links including the ground.
/// Each dyad is a parallelogram with a slightly longer coupler.
fn twelve_links() -> Spec {
    let (base, coupler, rocker) = (0.45, 0.47, 0.3);
    let mut spec = four_bar([0.4, 0.1, 0.35, rocker], true);
    let rod = |name: &str, [from, to]: [&str; 2], length: f64| SpecimenLink {
        name: name.into(),
        points: vec![(from.into(), Vec2::zeros()), (to.into(), Vec2::new(length, 0.0))],
        mass: Some((10.0 * length, Vec2::new(length / 2.0, 0.0), 10.0 * length.powi(3) / 12.0)),
    };
    let (mut driver, mut pivot) = ("rocker".to_string(), 0.4);
    for number in 1..=4 {
        pivot += base;
        let [a, b] = ["coupler", "rocker"].map(|name| format!("{name}{number}"));
        let [first, inner, last] = ["A", "B", "C"].map(|name| format!("{name}{number}"));
        let before = spec.links.iter_mut().find(|link| link.name == driver).unwrap();
        before.points.push((first.clone(), Vec2::new(rocker, 0.0)));
        spec.ground.push((last.clone(), Vec2::new(pivot, 0.0)));
        spec.links.push(rod(&a, [&first, &inner], coupler));
        spec.links.push(rod(&b, [&last, &inner], rocker));
        for (name, links) in [(&first, [&driver, &a]), (&inner, [&a, &b]), (&last, [&"ground".to_string(), &b])] {
            spec.pins.push(Pin { name: name.clone(), links: links.map(String::clone) });
        }
        spec.dyads.push(Dyad { links: [a, b.clone()], left: true });
        driver = b;
    }
    spec
}

fn quarter(case: &Case) -> Case {
    let cranks = (0..=18).map(|k| f64::from(5 * k).to_radians()).collect();
    case.on(Grid::of_inputs(case.crank(), cranks)).unwrap()
}

/// Largest error divided by the scale, over the channels of the selected stages.
fn worst(truth: &Trajectory, run: &Trajectory, stages: impl Fn(Stage) -> bool) -> f64 {
    let found = residuals(truth, run).unwrap();
    found.iter().filter(|r| stages(r.channel.kind.stage)).map(|r| r.share()).fold(0.0, f64::larger)
}

/// Story 68.
/// Errors of the impulse build spread along a chain from joint to joint, and sweeps must reduce these errors.
/// For twelve links, the default number of sweeps gives the formal order in all channels.
#[test]
fn regress_68_twelve_links_converge_in_the_impulse_build() {
    let case = quarter(&twelve_links().scenario().unwrap().case);
    assert_eq!(case.mechanism.links().len(), 12);
    let truth = solve(&AssurSolver, &case);
    let errors = [2e-3, 1e-3].map(|step| {
        let run = solve(prover::engines::named("impulse", step).unwrap().as_ref(), &case);
        [Stage::Positions, Stage::Velocities, Stage::Accelerations, Stage::Reactions]
            .map(|stage| worst(&truth, &run, |own| own == stage))
    });
    eprintln!("at 2 ms and 1 ms: {errors:?}");
    for k in 0..4 {
        let order = (errors[0][k] / errors[1][k]).log2();
        assert_within!((order - 2.0).abs(), 0.2, "stage {k}: order {order}: {errors:?}");
        // The bounds are 10 % above the measured values.
        let bound = [5.1e-3, 3.1e-4, 8.3e-4, 1.6e-3][k];
        assert_within!(errors[1][k], bound, "stage {k}: {errors:?}");
    }
}

/// Story 69.
/// Symptom: a massless coupler carries the weight and the inertia of its stand-in.
/// Cause: Rapier cannot move a link without mass, so the link gets a stand-in mass.
/// The impulses contain the forces of the stand-in mass, which must be subtracted.
/// If a part of these forces remains, the error does not vanish with the step.
/// Native impulses converge to the reference with order one, a probe with order two.
/// The bound for native impulses is 10 % above the larger of the two measured errors (0.113 and 0.058).
#[test]
fn regress_69_substitute_masses_are_subtracted_from_impulses() {
    let mut spec = four_bar([0.4, 0.1, 0.35, 0.3], true);
    spec.links[1].mass = None;
    let case = quarter(&spec.scenario().unwrap().case);
    let truth = solve(&AssurSolver, &case);
    for name in ["rapier", "impulse"] {
        for (route, formal, bound) in [(Route::Native, 1.0, 0.125), (Route::Probe, 2.0, 5e-3)] {
            let errors = [2e-3, 1e-3].map(|step| {
                let engine = prover::engines::named(name, step).unwrap();
                let run = solve(engine.with(Settings { route, sweeps: 1024, ..engine.settings() }).as_ref(), &case);
                worst(&truth, &run, |stage| stage >= Stage::Reactions)
            });
            let order = (errors[0] / errors[1]).log2();
            eprintln!("{name} {route:?}: {errors:?}, order {order:.2}");
            assert_within!((order - formal).abs(), 0.2, "{name} {route:?}: order {order}: {errors:?}");
            assert_within!(errors[1], bound, "{name} {route:?}: {errors:?}");
        }
    }
}
