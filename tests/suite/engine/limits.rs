//! Steps that are far too large, and poses that cannot be reached.
//! In both cases the engine reports an error that helps the user, never plausible but wrong numbers.

use std::path::Path;

use analytic::range::{Extent, reachable};
use analytic::{self, AssurSolver, NewtonSolver};
use linkage::ErrorKind;
use linkage::case::Grid;
use linkage::math::statistics::largest_difference;
use linkage::solver::Solver;
use prover::engines::EngineName;
use prover::run::{Options, prove};
use scenario::Scenario;

use super::stepping;
use crate::common::shipped;
use crate::common::sliders::short_rod;
use crate::common::spec::four_bar;
use crate::common::specimens::specimen;

/// Story 40.
/// Symptom: numbers are wrong by 50 %, without a message.
/// Cause: with a step of a tenth of a revolution, the gap of the loop stays below the limit that stops a run.
/// Proofs at steps of 39, 15.6 and 7.8 degrees must be inconclusive, or end with a helpful error.
#[test]
fn regress_40_steps_that_are_too_large_prove_nothing() {
    let scenario = shipped("crank_rocker.toml");
    for engine in stepping(1e-3) {
        for step in [0.05, 0.02, 0.01] {
            let options = Options::default().engine(EngineName::named(engine.name()).unwrap()).step(step).budget(1e5);
            match prove(&scenario, &options) {
                Ok(proof) => {
                    assert_eq!(proof.verdict.word(), "inconclusive", "{step}: {:?}", proof.verdict);
                    proof.engine().failure.iter().for_each(assert_helpful);
                }
                Err(error) => assert_helpful(&error),
            }
        }
        let error = engine.at(0.1).solve(&scenario.case).unwrap_err();
        assert_helpful(&error);
    }
}

/// The error states the location and a remedy.
fn assert_helpful(error: &linkage::Error) {
    assert_eq!(error.kind(), ErrorKind::Numeric, "{error}");
    assert!(error.message().contains("crank angle"), "{error}");
    assert!(error.input().is_some() && error.time().is_some(), "{error:?}");
    // A smaller step does not help an engine that chooses its steps itself, so the message may name a second remedy.
    let helps = |way: String| way.contains("smaller time step") || way.contains("can be assembled");
    assert!(error.way_out().is_some_and(helps), "{error}");
}

/// Story 41.
/// Symptom: gaps of metres and forces of 1e12 N beyond a pose that cannot be assembled.
/// Cause: the engine does not detect such a pose by itself.
/// The links of the dyad reach 0.45 m.
/// Beyond acos(0.0475 / 0.24) = 78.6 deg, the outer joints of the dyad are farther apart than 0.45 m.
#[test]
fn regress_41_a_pose_that_cannot_be_assembled_is_an_error_with_its_crank_angle() {
    let mut spec = four_bar([0.4, 0.3, 0.25, 0.2], true);
    spec.start = 0.5;
    spec.grid = (0.5, 0.05, 60);
    let case = spec.scenario().unwrap().case;
    for step in [1e-2, 1e-3] {
        for engine in prover::engines::all(step) {
            assert_helpful(&engine.solve(&case).unwrap_err());
        }
    }
    for solver in analytic::all() {
        let error = solver.solve(&case).unwrap_err();
        assert!(error.message().contains("crank angle"), "{error}");
    }
    let geometry = AssurSolver.solve(&case).unwrap_err();
    assert_eq!(geometry.kind(), ErrorKind::Geometry);
}

/// Story 42.
/// Symptom: a slider-crank beyond its last pose that can be assembled gave gaps of metres and forces of 1e12 N, as in
/// story 41.
/// Cause: the guide has no gap from which the engine could detect that the pose cannot be assembled.
/// Beyond 261.347 deg the rod is too short.
#[test]
fn regress_42_a_slider_out_of_reach_is_an_error_with_its_crank_angle() {
    let case = short_rod();
    for step in [1e-2, 1e-3] {
        for engine in prover::engines::all(step) {
            assert_helpful(&engine.solve(&case).unwrap_err());
        }
    }
    let error = NewtonSolver.solve(&case).unwrap_err();
    assert!(error.message().contains("crank angle 261.34"), "{error}");
}

/// Symptom: 2 deg from the dead point of a class III group, both Rapier builds silently took the wrong branch.
/// Cause: a run was stopped only if a loop opened far, but here the loops had opened by only 0.2 %.
/// A run that reaches the end must stay on its branch; a run that changes branch must be stopped.
#[test]
fn regress_higher_groups_do_not_change_branch_unnoticed() {
    const FROM_THE_END: f64 = 2.0;
    /// Distance from the exact motion (deg) beyond which a configuration counts as the wrong branch.
    /// This distance is twice the largest error found at steps of 4 deg.
    const FAR: f64 = 17.0;
    let (mut stopped, mut through) = (0, 0);
    // These specimens contain groups of class III of order 3 and 4, and of class IV of order 2.
    for index in [28, 158, 298, 328] {
        let text = specimen(1, index, &mut Default::default()).toml(false);
        let case = Scenario::parse(&text, Path::new("limits.toml")).unwrap().case;
        let Ok(Extent::Limited(ends)) = reachable(&case) else { panic!("{index} has no dead point") };
        let [from, to] = ends.map(|end| end.crank);
        let room = FROM_THE_END.to_radians();
        let span = to - from - 2.0 * room;
        let cranks: Vec<f64> = (0..=120).map(|k| from + room + span * f64::from(k) / 120.0).collect();
        let times = cranks.iter().map(|&crank| case.crank().time_of(crank)).collect();
        let case = case.on(Grid::of_times(case.crank(), times)).unwrap();
        let exact = AssurSolver.solve(&case).unwrap();
        for degrees in [1.0, 2.0, 4.0f64] {
            for engine in stepping(degrees.to_radians() / case.crank().top_speed().abs()) {
                let name = format!("{index} {} at {degrees} deg", engine.name());
                match engine.solve(&case) {
                    Err(error) => {
                        assert_eq!(error.kind(), ErrorKind::Numeric, "{name}: {error}");
                        stopped += usize::from(error.message().contains("slipped into another assembly mode"));
                    }
                    Ok(run) => {
                        through += 1;
                        for ((channel, exact), (_, own)) in exact.iter().zip(run.iter()) {
                            let angle = largest_difference(exact, own, true).to_degrees();
                            let is_angle = channel.kind.periodic;
                            assert!(!is_angle || angle < FAR, "{name}: {channel} is off by {angle} deg");
                        }
                    }
                }
            }
        }
    }
    assert!(stopped >= 4 && through >= 8, "{stopped} stopped, {through} through");
}
