//! Several substeps per step: their effect in Rapier, and the values that Rapier reports with substeps.

use analytic::AssurSolver;
use linkage::case::{Case, Grid};
use linkage::engine::{Engine, Route, Settings};
use linkage::math::KeepNan;
use linkage::trajectory::{Channel, Stage, Unit};
use prover::bounds::residuals;

use super::{epsilon, has_formal_order, solve};
use crate::common::assert_within;
use crate::common::spec::four_bar;

/// Number of sweeps that is enough for this four-bar in both builds.
const SWEEPS: usize = 1024;

/// A case over a quarter revolution; only the first instant of the grid lies on a step.
fn case() -> Case {
    let case = four_bar([0.4, 0.1, 0.35, 0.3], true).scenario().unwrap().case;
    let cranks = (0..=18).map(|k| f64::from(5 * k).to_radians()).collect();
    let grid = Grid::of_inputs(case.crank(), cranks);
    case.on(grid).unwrap()
}

fn engine(name: &str, route: Route, substeps: usize) -> Box<dyn Engine> {
    let engine = prover::engines::named(name, 1e-3).unwrap();
    engine.with(Settings { route, substeps, sweeps: SWEEPS, ..engine.settings() })
}

/// Story 65.
/// Symptom: with two substeps, velocities converge with order one only, and the crank of the impulse build lags.
/// Cause: velocities and impulses belong to the start of the last substep, not of the step.
/// A second cause is that a separate body rotates by atan(omega dt) in every substep.
/// The order must be the same as without substeps, in every channel and by every route.
#[test]
fn regress_65_substeps_keep_the_formal_order_by_every_route() {
    for name in ["rapier", "impulse"] {
        for substeps in [2, 3] {
            for route in [Route::Differences, Route::Native] {
                has_formal_order(&case(), [engine(name, route, substeps)].into_iter(), &AssurSolver);
            }
        }
    }
}

/// Story 66.
/// Symptom: with substeps, the crank of the impulse build lagged, as in story 65.
/// The crank keeps its angle to rounding error, as it does without substeps (story 1).
#[test]
fn regress_66_the_motor_holds_its_speed_with_substeps() {
    let case = case();
    for name in ["rapier", "impulse"] {
        let engine = engine(name, Route::Differences, 2);
        let run = solve(engine.as_ref(), &case);
        let angles = run.column(&Channel::named("link.crank.angle_rad").unwrap()).unwrap();
        let steps = case.grid.times.last().unwrap() / engine.settings().resolution;
        for (angle, crank) in angles.iter().zip(run.inputs()) {
            let off = (angle - crank).abs();
            assert_within!(off, 2.0 * epsilon(engine.as_ref()) * steps, "{name}: {off:e} at {crank}");
        }
        let speeds = run.column(&Channel::named("link.crank.omega_rad_s").unwrap()).unwrap();
        speeds.iter().for_each(|omega| assert_within!((omega - 10.0).abs(), 1e-11, "{name}: {speeds:?}"));
    }
}

/// Story 67.
/// Two substeps reduce the errors in angles to a quarter, as a step of half the size does.
/// Errors of native reactions fall to 0.63 of their value in the multibody build, and to 0.50 in the impulse build.
/// Substeps hardly change the errors of reactions by a probe, because the tiny steps of a probe are not divided.
#[test]
fn regress_67_two_substeps_are_nearly_as_good_as_half_the_step() {
    let case = case();
    let truth = solve(&AssurSolver, &case);
    let worst = |name: &str, route: Route, substeps: usize| {
        let run = solve(engine(name, route, substeps).as_ref(), &case);
        let found = residuals(&truth, &run).unwrap();
        let most = |wanted: &dyn Fn(&prover::bounds::Residual) -> bool| {
            found.iter().filter(|r| wanted(r)).map(|r| r.share()).fold(0.0, f64::larger)
        };
        [most(&|r| r.channel.kind.unit == Unit::Radian), most(&|r| r.channel.kind.stage >= Stage::Reactions)]
    };
    for name in ["rapier", "impulse"] {
        for (route, shares) in [(Route::Native, [0.3, 0.7]), (Route::Probe, [0.3, 1.1])] {
            let [one, two] = [1, 2].map(|substeps| worst(name, route, substeps));
            eprintln!("{name} {route:?}: one substep {one:?}, two {two:?}");
            for k in 0..2 {
                assert_within!(two[k], shares[k] * one[k], "{name} {route:?}: {one:?}, two substeps {two:?}");
            }
        }
    }
}
