//! Finds extremes that are reached at several instants.

use std::f64::consts::TAU;

use linkage::case::Case;
use linkage::math::KeepNan;
use linkage::math::statistics::ascending;
use linkage::trajectory::Trajectory;
use scenario::Statistic;

/// Largest difference between two extremes, divided by the largest value, at which they count as equal.
const EQUAL: f64 = 1e-6;

/// Row of a second extreme that equals the first, with other values between the two.
/// `None` if there is no second extreme.
/// The first and the last instant of a turn have the same pose, so they count as one extreme.
pub(super) fn rival(statistic: Statistic, values: &[f64], run: &Trajectory, case: &Case, scale: f64) -> Option<usize> {
    let of =
        |change: fn(f64) -> f64| rival_of(&values.iter().map(|own| change(*own)).collect::<Vec<_>>(), run, case, scale);
    match statistic {
        Statistic::Max => of(|own| own),
        Statistic::Min => of(|own| -own),
        Statistic::MaxAbs => of(f64::abs),
        Statistic::Range => of(|own| own).or_else(|| of(|own| -own)),
        Statistic::Mean | Statistic::Rms | Statistic::At(_) => None,
    }
}

fn rival_of(values: &[f64], run: &Trajectory, case: &Case, scale: f64) -> Option<usize> {
    let order = ascending(run.times());
    let best = order[1..].iter().fold(order[0], |best, row| if values[*row] > values[best] { *row } else { best });
    let least = values[best] - EQUAL * scale;
    let hill = plateau(best, values, run, scale, 0.0);
    let is_same_pose = |one: usize, other: usize| {
        let turns = (run.inputs()[one] - run.inputs()[other]) / TAU;
        case.is_steady() && (turns - turns.round()).abs() < 1e-9
    };
    let belongs = |row: usize| hill.iter().any(|own| *own == row || is_same_pose(*own, row));
    order.into_iter().find(|row| values[*row] >= least && !belongs(*row))
}

/// The successive instants around the row `row` whose values equal the value in this row, to 1e-6 of the largest value
/// `scale` or to `rounding`.
pub(super) fn plateau(row: usize, values: &[f64], run: &Trajectory, scale: f64, rounding: f64) -> Vec<usize> {
    let order = ascending(run.times());
    let allowed = (EQUAL * scale).larger(rounding);
    let is_tied = |at: &&usize| (values[**at] - values[row]).abs() <= allowed;
    let (before, after) = order.split_at(order.iter().position(|own| *own == row).unwrap_or(0));
    before.iter().rev().take_while(is_tied).chain(after.iter().take_while(is_tied)).copied().collect()
}
