//! One run, sampled at different instants.

use linkage::case::{Case, Grid};
use linkage::engine::Settings;
use linkage::math::KeepNan;
use linkage::trajectory::Trajectory;
use prover::bounds::residuals;

use super::{double, solve, stepping};
use crate::common::assert_within;
use crate::common::spec::four_bar;

const DT: f64 = 1e-3;

fn case() -> Case {
    four_bar([0.4, 0.1, 0.35, 0.3], true).scenario().unwrap().case
}

fn at(case: &Case, times: Vec<f64>) -> Case {
    case.on(Grid::of_times(case.crank(), times)).unwrap()
}

/// Largest difference in any channel, divided by the channel's scale.
/// `row` gives the row of `dense` for each row of `other`.
fn differ(dense: &Trajectory, other: &Trajectory, row: impl Fn(usize) -> usize) -> (f64, String) {
    let picked: Vec<Vec<f64>> =
        dense.iter().map(|(_, values)| (0..other.times().len()).map(|k| values[row(k)]).collect()).collect();
    let channels = dense.channels().to_vec();
    let picked = Trajectory::new(other.times().to_vec(), other.inputs().to_vec(), channels, picked).unwrap();
    let scales = prover::bounds::scales(dense);
    let worst = residuals(&picked, other).unwrap().into_iter().zip(scales).map(|(r, scale)| (r.max / scale, r.channel));
    let (worst, channel) = worst.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    (worst, channel.to_string())
}

/// Story 20.
/// Symptom: a value between two steps was the value of a neighbouring step, or a value at a step changed with the grid.
/// Values at the end of a step are not interpolated, so their bits do not depend on the number of instants.
#[test]
fn regress_20_samples_on_steps_do_not_depend_on_the_grid() {
    let case = case();
    for engine in stepping(DT) {
        // The bits are equal for any number of sweeps, so few sweeps are enough.
        let engine = engine.with(Settings { sweeps: 64, ..engine.settings() });
        let dense = solve(engine.as_ref(), &at(&case, (0..=600).map(|k| f64::from(k) * DT).collect()));
        let sparse = solve(engine.as_ref(), &at(&case, (0..=20).map(|k| f64::from(k) * 30.0 * DT).collect()));
        assert_eq!(differ(&dense, &sparse, |k| 30 * k).0, 0.0);
        let late = solve(engine.as_ref(), &at(&case, (0..=20).map(|k| 0.1 + f64::from(k) * DT).collect()));
        assert_eq!(differ(&dense, &late, |k| 100 + k).0, 0.0);
        let back = solve(engine.as_ref(), &at(&case, (0..=20).rev().map(|k| f64::from(k) * 30.0 * DT).collect()));
        assert_eq!(differ(&dense, &back, |k| 600 - 30 * k).0, 0.0);
    }
}

/// Story 21.
/// Symptom: a sample between two steps is less accurate than its neighbours.
/// The error of interpolation of order six is far below the engine's error of order two.
/// (In single precision, the rounding error is larger than the interpolation error.)
#[test]
fn regress_21_samples_between_steps_are_as_good_as_samples_on_steps() {
    let case = case();
    for engine in double(DT) {
        // A quarter of the sweeps is enough for this four-bar, because it has a flywheel.
        let engine = engine.with(Settings { sweeps: engine.settings().sweeps / 4, ..engine.settings() });
        for shift in [0.1, 0.5, 0.777, 0.999_999] {
            let on = at(&case, (0..600).map(|k| f64::from(k) * DT).collect());
            let between = at(&case, (0..600).map(|k| (f64::from(k) + shift) * DT).collect());
            let worst = [on, between].map(|case| {
                let truth = solve(&analytic::AssurSolver, &case);
                let found = residuals(&truth, &solve(engine.as_ref(), &case)).unwrap();
                found.iter().map(|r| r.share()).fold(0.0, f64::larger)
            });
            assert_within!(worst[1], 1.01 * worst[0], "{shift}: {worst:?}");
        }
    }
}

/// Story 22.
/// Symptom: instants before the start are refused, or values differ where the run reverses.
/// A run back and forth over t = 0 must agree, within rounding error, with the run that starts at t = 0.
#[test]
fn regress_22_instants_before_the_start_are_as_good_as_others() {
    let case = case();
    for engine in prover::engines::all(DT) {
        let whole = at(&case, (-300..=300).map(|k| f64::from(k) * DT).collect());
        let truth = solve(&analytic::AssurSolver, &whole);
        let run = solve(engine.as_ref(), &whole);
        let half = solve(engine.as_ref(), &at(&case, (0..=300).map(|k| f64::from(k) * DT).collect()));
        // The two runs reverse at different poses, so their rounding errors differ.
        // The difference of the runs must be less than the sum of their rounding errors.
        for (channel, values) in half.iter() {
            let (noise, whole_values) = (engine.noise(&whole, channel.kind), run.column(channel).unwrap());
            for (a, b) in values.iter().zip(&whole_values[300..]) {
                assert_within!((a - b).abs(), 2.0 * noise, "{} {channel}: {a} {b}, noise {noise:e}", engine.name());
            }
        }
        for residual in residuals(&truth, &run).unwrap() {
            let limit = 1e-3 * residual.scale + engine.noise(&whole, residual.channel.kind);
            assert_within!(residual.max, limit, "{} {}: {:e}", engine.name(), residual.channel, residual.max);
        }
    }
}
