//! Requirements on every engine, and errors that once occurred.
//! The comment on each error states its symptom and its cause.
//! Errors with a number are listed as stories in `docs/stories.md`.

mod accuracy;
mod chains;
mod grids;
mod hanging;
mod limits;
mod native;
mod pendulum;
mod point_masses;
mod prismatic;
mod substeps;
mod wrapped;

use crate::common::spec::four_bar;
use crate::common::{assert_within, shipped};
use analytic::AssurSolver;
use linkage::case::Case;
use linkage::engine::{CachedEngine, Engine, Settings};
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, ChannelSubject, Stage, Trajectory};
use prover::bounds::convergence::observed_order;
use prover::bounds::residuals;

fn solve(solver: &dyn Solver, case: &Case) -> Trajectory {
    solver.solve(case).unwrap_or_else(|error| panic!("{error}"))
}

fn engine_runs(engine: &dyn Engine, case: &Case, factors: [f64; 3]) -> [Trajectory; 3] {
    factors.map(|factor| {
        let engine = engine.at(engine.settings().resolution * factor);
        engine.solve(case).unwrap_or_else(|error| panic!("{error}"))
    })
}

/// Whether an engine computes in single precision.
fn single(engine: &dyn Engine) -> bool {
    engine.name().ends_with("-f32")
}

/// Machine epsilon of an engine's numbers.
fn epsilon(engine: &dyn Engine) -> f64 {
    if single(engine) { f64::from(f32::EPSILON) } else { f64::EPSILON }
}

/// The engines whose step the user chooses.
/// An engine that controls its error is excluded, because it chooses its steps itself.
/// The steps of such an engine miss the instants of the grid, and its errors show no order of convergence.
fn stepping(dt: f64) -> impl Iterator<Item = Box<dyn Engine>> {
    prover::engines::all(dt).into_iter().filter(|engine| !engine.controls_error())
}

/// The engines that step as the user chooses, in double precision.
/// In single precision, rounding hides orders of convergence (story 60).
fn double(dt: f64) -> impl Iterator<Item = Box<dyn Engine>> {
    stepping(dt).filter(|engine| !single(engine.as_ref()))
}

/// Checks the formal order of convergence in every channel whose error is not rounding, over the steps h, h/2 and h/4.
fn has_formal_order(case: &Case, engines: impl Iterator<Item = Box<dyn Engine>>, solver: &dyn Solver) {
    let reference = solve(solver, case);
    for engine in engines {
        let runs = engine_runs(engine.as_ref(), case, [1.0, 0.5, 0.25]);
        let finest = residuals(&reference, &runs[2]).unwrap();
        let mut seen = 0;
        for residual in finest {
            let kind = residual.channel.kind;
            // If the rounding error is a hundredth of the channel's error, it changes the order of convergence by less
            // than 0.02.
            // Channels whose rounding error is more than a hundredth of the channel's error are skipped.
            let noise = engine.at(engine.settings().resolution / 4.0).noise(case, kind);
            if residual.rms <= 100.0 * noise {
                continue;
            }
            seen += 1;
            for pair in [[&runs[0], &runs[1]], [&runs[1], &runs[2]]] {
                let order = observed_order(&reference, pair, &residual.channel).unwrap().unwrap();
                let formal = engine.formal_order(case, kind);
                assert_within!((order - formal).abs(), 0.1, "{} {}: order {order}", engine.name(), residual.channel);
            }
        }
        // Crank angles have no error, and in a Scotch yoke all angles and speeds have no error.
        // The test therefore requires an order of convergence only in more than a third of the channels.
        // In single precision almost every error is rounding, so no channel needs to show an order.
        assert!(
            single(engine.as_ref()) || seen > reference.channels().len() / 3,
            "only {seen} channels have more than rounding errors"
        );
    }
}

/// Cached runs that are computed in parallel equal single runs to the last bit, both plain and extrapolated.
#[test]
fn cached_runs_equal_single_runs() {
    let case = four_bar([0.4, 0.1, 0.35, 0.3], true).scenario().unwrap().case;
    for engine in prover::engines::all(2e-3) {
        for extrapolated in [0, if engine.controls_error() { 0 } else { 2 }] {
            let own = engine.settings();
            let asked = Settings { sweeps: own.sweeps.min(64), extrapolated, ..own };
            let at = |factor: f64| Settings { resolution: asked.resolution * factor, ..asked };
            let rungs = [asked, at(0.5), at(2.0), Settings { sweeps: asked.sweeps / 2, ..asked }];
            let kept = CachedEngine::new(engine.as_ref());
            kept.prepare(&case, kept.missing(&case, &rungs), &mut |_| {});
            for settings in rungs {
                let (together, alone) = (kept.with(settings), engine.with(settings));
                assert_eq!(together.settings(), settings, "{}", engine.name());
                assert_eq!(solve(together.as_ref(), &case), solve(alone.as_ref(), &case), "{}", engine.name());
            }
        }
    }
}

#[test]
fn crank_rocker_converges_with_the_formal_order() {
    let scenario = shipped("crank_rocker.toml");
    has_formal_order(&scenario.case, double(1e-3), &AssurSolver);
}

#[test]
fn ov7_base_converges_with_the_formal_order() {
    let scenario = shipped("ov7_base.toml");
    has_formal_order(&scenario.case, double(0.78f64.to_radians() / 97.2), &AssurSolver);
}

/// Story 1.
/// Symptom: the crank lags a little more with every step, so that all other errors look like phase errors.
/// Cause: a motor with finite damping, or a build that uses only impulses.
/// Every engine must keep the prescribed angle to rounding.
#[test]
fn regress_01_the_motor_holds_its_speed_over_many_turns() {
    for speed in [25.0, -25.0] {
        let mut spec = four_bar([0.4, 0.1, 0.35, 0.3], true);
        spec.speed = speed;
        spec.grid = (0.0, speed.signum(), 31);
        let case = spec.scenario().unwrap().case;
        for engine in prover::engines::all(1e-3) {
            let run = solve(engine.as_ref(), &case);
            let angles = run.column(&Channel::named("link.crank.angle_rad").unwrap()).unwrap();
            let steps = case.grid.times.last().unwrap() / engine.settings().resolution;
            for (angle, crank) in angles.iter().zip(run.inputs()) {
                // For each step, the bound grows by half a unit in the last place of the largest angle.
                let bound = 0.5 * epsilon(engine.as_ref()) * 32.0 * steps;
                assert_within!((angle - crank).abs(), bound, "{}: {angle} at {crank}", engine.name());
            }
            let speeds = run.column(&Channel::named("link.crank.omega_rad_s").unwrap()).unwrap();
            let bound = 4096.0 * epsilon(engine.as_ref()) * speed.abs();
            speeds.iter().for_each(|omega| assert_within!((omega - speed).abs(), bound, "{}", engine.name()));
        }
    }
}

/// Story 2. Symptom: the mechanism runs in the wrong direction when the driven joint is written [crank, ground]. Cause:
/// a motor turns the second body relative to the first.
#[test]
fn regress_02_the_driven_joint_may_name_the_crank_first() {
    let spec = four_bar([0.4, 0.1, 0.35, 0.3], true);
    let mut other = spec.clone();
    other.pins.iter_mut().for_each(|pin| pin.links.reverse());
    let [one, two] = [&spec, &other].map(|spec| spec.scenario().unwrap().case);
    for engine in prover::engines::all(1e-3) {
        // The impulse build corrects loops along the axes of the joint's first body.
        // A different order of the links therefore gives a different error of second order.
        let share = if engine.name() == "rapier" { 1e-7 } else { 1e-3 };
        let case = &one;
        let (one, two) = (solve(engine.as_ref(), &one), solve(engine.as_ref(), &two));
        for ((channel, a), (_, b)) in one.iter().zip(two.iter()) {
            let sign = if channel.to_string().starts_with("joint.") { -1.0 } else { 1.0 };
            let scale = a.iter().fold(0.0, |max: f64, v| max.larger(v.abs()));
            let bound = share * scale + 2.0 * engine.noise(case, channel.kind);
            for (a, b) in a.iter().zip(b) {
                assert_within!((a - sign * b).abs(), bound, "{} {channel}: {a} {b}", engine.name());
            }
        }
    }
}

/// Story 3.
/// Symptom: an engine refuses a link without mass, or never moves the link.
/// Cause: the engine needs inertia to integrate.
/// The motion under a prescribed speed must not depend on the masses, and a massless link must carry no inertial force.
#[test]
fn regress_03_massless_links_keep_the_motion_and_carry_no_force() {
    let with = four_bar([0.4, 0.1, 0.35, 0.3], true);
    let mut without = with.clone();
    without.links.iter_mut().for_each(|link| link.mass = None);
    let [with, without] = [&with, &without].map(|spec| spec.scenario().unwrap().case);
    for engine in prover::engines::all(1e-3) {
        let case = &with;
        let (with, without) = (solve(engine.as_ref(), &with), solve(engine.as_ref(), &without));
        for (channel, values) in without.iter() {
            // Without mass, the mass centre of a link is the origin of the link's frame.
            // The motions of the mass centres with and without mass are therefore not compared.
            let centre = channel.kind.subject == ChannelSubject::Link && channel.kind.unit.symbol().starts_with('m');
            if channel.kind.stage >= Stage::Reactions {
                // Reactions of the mechanism without masses must be zero.
                // Only an engine that cancels its stand-in masses by applied forces may leave rounding error.
                let left = if engine.controls_error() { engine.noise(case, channel.kind) } else { 0.0 };
                values.iter().for_each(|value| assert_within!(value.abs(), left, "{} {channel}", engine.name()));
            } else if !centre {
                // In the multibody build, positions follow from the tree, whatever the masses.
                // The masses only distribute the small gap of the loop, which shows mainly in accelerations.
                // In the impulse build, the differences are of second order, like all errors of this build.
                let bound = match (engine.name(), channel.kind.stage) {
                    ("rapier", Stage::Accelerations) => 1e-4,
                    ("rapier", _) => 1e-11,
                    _ => 1e-3,
                };
                let other = with.column(channel).unwrap();
                let scale = other.iter().fold(0.0, |max: f64, v| max.larger(v.abs()));
                let worst = values.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::larger);
                let bound = bound * scale + 2.0 * engine.noise(case, channel.kind);
                assert_within!(worst, bound, "{} {channel}: {worst:e} of {scale:e}", engine.name());
            }
        }
    }
}
