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
pub(super) fn rival(statistic: Statistic, values: &[f64], run: &Trajectory, case: &Case) -> Option<usize> {
    let of = |change: fn(f64) -> f64| rival_of(&values.iter().map(|own| change(*own)).collect::<Vec<_>>(), run, case);
    match statistic {
        Statistic::Max => of(|own| own),
        Statistic::Min => of(|own| -own),
        Statistic::MaxAbs => of(f64::abs),
        Statistic::Range => of(|own| own).or_else(|| of(|own| -own)),
        Statistic::Mean | Statistic::Rms | Statistic::At(_) => None,
    }
}

fn rival_of(values: &[f64], run: &Trajectory, case: &Case) -> Option<usize> {
    let order = ascending(run.times());
    let height = |place: usize| values[order[place]];
    let best = (1..order.len()).fold(0, |best, place| if height(place) > height(best) { place } else { best });
    let scale = values.iter().fold(0.0, |most: f64, own| most.larger(own.abs()));
    let least = height(best) - EQUAL * scale;
    // Around the first extreme, all consecutive instants whose values are at least `least` count as the first extreme.
    let mut hill = vec![false; order.len()];
    let mut up = (best..order.len()).take_while(|place| height(*place) >= least).collect::<Vec<_>>();
    up.extend((0..best).rev().take_while(|place| height(*place) >= least));
    up.into_iter().for_each(|place| hill[place] = true);
    let input = |place: usize| run.inputs()[order[place]];
    let is_same_pose = |one: usize, other: usize| {
        let turns = (input(one) - input(other)) / TAU;
        case.is_steady() && (turns - turns.round()).abs() < 1e-9
    };
    let found = (0..order.len()).find(|place| {
        height(*place) >= least && !hill[*place] && !(0..order.len()).any(|own| hill[own] && is_same_pose(own, *place))
    });
    found.map(|place| order[place])
}

/// The successive instants around the row `row` whose values equal the value in this row, to 1e-6 of the largest value or
/// to `rounding`.
pub(super) fn plateau(row: usize, values: &[f64], run: &Trajectory, rounding: f64) -> Vec<usize> {
    let order = ascending(run.times());
    let scale = values.iter().fold(0.0, |most: f64, own| most.larger(own.abs()));
    let allowed = (EQUAL * scale).larger(rounding);
    let is_tied = |at: &&usize| (values[**at] - values[row]).abs() <= allowed;
    let (before, after) = order.split_at(order.iter().position(|own| *own == row).unwrap_or(0));
    before.iter().rev().take_while(is_tied).chain(after.iter().take_while(is_tied)).copied().collect()
}
