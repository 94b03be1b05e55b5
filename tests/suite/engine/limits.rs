//! Steps that are far too large and poses that cannot be reached: the result is an error that helps, never plausible
//! numbers.

use analytic::{self, AssurSolver, NewtonSolver};
use linkage::ErrorKind;
use linkage::solver::Solver;
use linkproof::engines::EngineName;
use linkproof::proof::{Options, prove};

use super::stepping;
use crate::common::shipped;
use crate::common::sliders::short_rod;
use crate::common::spec::four_bar;

/// Story 40. Symptom: numbers are off by half, without a message. Cause: with a step of a tenth of a turn the loop
/// opens by less than the limit that stops a run. The ladder of three steps must then be inconclusive: steps of 37 to
/// 7.8 degrees.
#[test]
fn regress_40_steps_that_are_too_large_prove_nothing() {
    let scenario = shipped("crank_rocker.toml");
    for engine in stepping(1e-3) {
        for step in [0.05, 0.02, 0.01] {
            let options = Options::default().engine(EngineName::named(engine.name()).unwrap()).step(step);
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

/// The error states where it happened and what to do.
fn assert_helpful(error: &linkage::Error) {
    assert_eq!(error.kind(), ErrorKind::Numeric, "{error}");
    assert!(error.message().contains("crank angle"), "{error}");
    assert!(error.crank().is_some() && error.time().is_some(), "{error:?}");
    // Smaller steps do not help an engine that chooses its own steps.
    let helps = |way: String| way.contains("smaller time step") || way.contains("can be assembled");
    assert!(error.way_out().is_some_and(helps), "{error}");
}

/// Story 41. Symptom: gaps of metres and forces of 1e12 N beyond a pose that cannot be assembled. Cause: the engine
/// does not detect it by itself. The links reach 0.45 m; the outer joints of the dyad exceed that at acos(0.0475 /
/// 0.24) = 78.6 deg.
#[test]
fn regress_41_a_pose_that_cannot_be_assembled_is_an_error_with_its_crank_angle() {
    let mut spec = four_bar([0.4, 0.3, 0.25, 0.2], true);
    spec.start = 0.5;
    spec.grid = (0.5, 0.05, 60);
    let case = spec.scenario().unwrap().case;
    for step in [1e-2, 1e-3, 1e-4] {
        for engine in linkproof::engines::all(step) {
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

/// Story 42. The same with a slider. The engine has no gap in the guide by which to detect it: the rod does not reach
/// beyond 261.347 deg.
#[test]
fn regress_42_a_slider_out_of_reach_is_an_error_with_its_crank_angle() {
    let case = short_rod();
    for step in [1e-2, 1e-3, 1e-4] {
        for engine in linkproof::engines::all(step) {
            assert_helpful(&engine.solve(&case).unwrap_err());
        }
    }
    let error = NewtonSolver.solve(&case).unwrap_err();
    assert!(error.message().contains("crank angle 261.34"), "{error}");
}
