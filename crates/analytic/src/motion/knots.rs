//! The knots of the loads' tables. A motion under forces is integrated in pieces that end at the knots.
//!
//! At a knot a load or its derivative jumps, so a step over a knot would have a lower order.

use linkage::case::Case;
use linkage::math::KeepNan;

/// A piece ends beyond a knot. The distance from the knot is this fraction of the sum of 1 rad and the magnitude of the
/// knot's crank angle.
/// Because of this distance, a motion that reverses exactly on a knot can leave the knot.
/// Over this distance, loads keep the values at the knot, so that they do not jump within a piece.
const BEYOND: f64 = 1e-12;

/// Crank angles (rad, as the scenario states them) of all knots of the loads' tables.
pub(super) struct Knots(Vec<(Vec<f64>, f64)>);

impl Knots {
    /// The knots of all loads of a case.
    pub(super) fn of(case: &Case) -> Self {
        Knots(case.load_knots().map(|(knots, period)| (knots.to_vec(), period)).collect())
    }

    /// Ends of the interval around a crank angle in which all tables are smooth.
    pub(super) fn around(&self, crank: f64) -> [f64; 2] {
        let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
        for (knots, period) in &self.0 {
            for knot in knots {
                // The last repetition of the knot at or before the crank angle, and the next repetition.
                let last = knot + period * ((crank - knot) / period).floor();
                ends = [ends[0].larger(last), ends[1].smaller(last + period)];
            }
        }
        // At a jump, a table has the value after the jump. A crank angle on a knot is therefore the lower end.
        ends
    }
}

/// Ends that lie a little outside the interval from `low` to `high`.
pub(super) fn beyond([low, high]: [f64; 2]) -> [f64; 2] {
    [low - BEYOND * (low.abs() + 1.0), high + BEYOND * (high.abs() + 1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn knots_repeat_with_the_period() {
        let knots = Knots(vec![(vec![0.0, 1.0], TAU), (vec![0.5], 2.0 * TAU)]);
        let near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
            assert!((a - c).abs() < 10.0 * BEYOND && (b - d).abs() < 10.0 * BEYOND, "{a} {b}");
        };
        near(beyond(knots.around(0.2)), [0.0, 0.5]);
        near(beyond(knots.around(0.7)), [0.5, 1.0]);
        near(beyond(knots.around(-0.1)), [1.0 - TAU, 0.0]);
        near(beyond(knots.around(TAU + 0.2)), [TAU, TAU + 1.0]);
        let all = Knots(Vec::new()).around(3.0);
        assert_eq!([all, beyond(all)], [[f64::NEG_INFINITY, f64::INFINITY]; 2]);
        assert_eq!(knots.around(0.7), [0.5, 1.0]);
    }
}
