//! Checks besides the comparison of the two sides: closure, side against side, powers.

use super::engines::Runs;
use super::observe::Observed;
use crate::compare::{Check, Convergence, magnitudes, residuals};
use crate::scenario::Scenario;
use crate::tolerance::{Basis, Tolerance};
use linkage::case::Case;
use linkage::engine::Engine;
use linkage::math::statistics::share;
use linkage::trajectory::{Channel, ChannelKind, Stage};

/// Closure of the joints, relative to the mechanism's size or its distance from the origin, that rounding allows an analytic side.
const CLOSURE: f64 = 1e-13;
/// Balancing moment two ways, relative to the moments that make it up.
const TWO_WAYS: f64 = 1e-11;

/// Relative difference that rounding allows between the two analytic sides. Each derivative, and each linear solve for
/// forces, multiplies the rounding of what it starts from by the condition of the pose, here at most a hundred.
fn side_bound(stage: Stage) -> f64 {
    match stage {
        Stage::Positions => 1e-12,
        Stage::Velocities | Stage::Accelerations => 1e-11,
        Stage::Reactions | Stage::BalancingMoment => 1e-10,
    }
}

pub(super) fn rounding(bound: f64, why: &'static str) -> Tolerance {
    Tolerance { abs: bound, rel: 0.0, basis: Basis::RoundOff(why) }
}

/// Checks on the two analytic sides, by name.
pub(super) fn of_sides(case: &Case, sides: &[(&'static str, Observed); 2]) -> Vec<Check> {
    let size = case.mechanism.size();
    let mut checks = Vec::new();
    for (name, side) in sides {
        let tolerance =
            rounding(CLOSURE, "positions are good to a few units in the last place of the largest coordinate");
        checks.push(Check::new(
            format!("closure of all joints ({name})"),
            side.closure / size.max(side.reach),
            tolerance,
            "",
        ));
    }
    checks.extend(between_sides(sides));
    for (name, side) in sides.iter().filter(|(_, side)| !side.power.is_empty()) {
        let tolerance = rounding(TWO_WAYS, "sums of a few forces and powers");
        let name = format!("balancing moment from equilibrium and from powers ({name})");
        checks.push(Check::new(name, two_ways(side), tolerance, ""));
    }
    for (name, side) in sides {
        checks.extend(side.unbalance.map(|share| {
            let tolerance = rounding(TWO_WAYS, "sums of as many forces as there are links");
            Check::new(
                format!("shaking force and moment from reactions and from momentum ({name})"),
                share,
                tolerance,
                "",
            )
        }));
    }
    checks
}

fn between_sides(sides: &[(&'static str, Observed); 2]) -> Vec<Check> {
    let reference = &sides[0].1.trajectory;
    let residuals = residuals(reference, &sides[1].1.trajectory).expect("both sides stand on one grid");
    let relative: Vec<f64> =
        residuals.iter().zip(magnitudes(reference)).map(|(residual, size)| share(residual.max, size)).collect();
    let of_stage = |stage: Stage| {
        let own = residuals.iter().zip(&relative).filter(|(residual, _)| residual.channel.kind.stage == stage);
        let (worst, &relative) = own.max_by(|a, b| a.1.total_cmp(b.1))?;
        let tolerance = rounding(side_bound(stage), "two solvers without a common equation, each good to rounding");
        let check = Check::new(format!("{} against {}", sides[0].0, sides[1].0), relative, tolerance, "");
        Some(
            check
                .of(stage.name())
                .located(|| format!("in {} at crank angle {:.3} deg", worst.channel, worst.worst_crank.to_degrees())),
        )
    };
    Stage::ALL.into_iter().filter_map(of_stage).collect()
}

/// Largest difference between the balancing moment of the trajectory and that of the powers, over the moments that make it up: where it vanishes they balance, and their rounding is left.
fn two_ways(side: &Observed) -> f64 {
    let difference = side.torque.iter().zip(&side.power).fold(0.0, |max: f64, (a, b)| max.max((a - b).abs()));
    if difference == 0.0 { 0.0 } else { difference / side.moment }
}

/// Checks on the engine, from its runs at double, single and half step.
pub(super) fn of_engine(scenario: &Scenario, engine: &dyn Engine, runs: &Runs) -> Vec<Check> {
    let (case, name) = (&scenario.case, engine.name());
    let mut checks = vec![Check::new(
        format!("closure of all joints ({name})"),
        runs.single().closure / case.mechanism.size(),
        Tolerance {
            abs: scenario.engine_rel,
            rel: 0.0,
            basis: Basis::RoundOff("the largest relative error with which the engine still proves something"),
        },
        "",
    )];
    if !runs.single().power.is_empty() {
        checks.push(power_balance(case, engine, runs));
    }
    checks
}

/// The engine's driving moment against the balance of powers of its own motion: two estimates of one number, each within its own
/// discretisation error.
fn power_balance(case: &Case, engine: &dyn Engine, runs: &Runs) -> Check {
    let kind: &ChannelKind = Channel::named("drive.torque_N_m").expect("the table has the moment").kind;
    let (scale, resolution) = (runs.single().moment, engine.settings().resolution);
    let noise = engine.at(resolution / 2.0).noise(case, kind);
    let estimate = |of: fn(&Observed) -> &[f64]| {
        let [double, single, half] = [0, 1, 2].map(|k| of(&runs.resolutions[k]));
        let found = Convergence::of(double, single, half, false, engine.formal_order(case, kind), noise);
        let fewer = runs.fewer_sweeps.as_ref().map(of);
        found.with_fewer_sweeps(single, fewer, false).tolerance(resolution, engine.noise(case, kind))
    };
    let (own, power) = (estimate(|run| &run.torque), estimate(|run| &run.power));
    let bound = (own.bound(scale) + power.bound(scale)) / scale.max(f64::MIN_POSITIVE);
    let tolerance = Tolerance { abs: bound, rel: 0.0, basis: power.basis };
    Check::new(
        format!("driving moment from reactions and from powers ({})", engine.name()),
        two_ways(runs.single()),
        tolerance,
        "",
    )
}
