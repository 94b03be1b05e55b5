//! Deviation of an output from the required motion: one number, zero for a perfect output.
//!
//! The output is measured from its smallest value and divided by its stroke, so that amplitude and offset do not
//! matter.
//! The cost is a weighted sum of squares. The terms that are squared are fractions of the stroke.
//! The terms are: motion in dwells, distances in the wrong sense, deviations from required levels, too little motion
//! in moving phases, and the output's rate between two opposite motions.
//! If the output must follow a curve, the deviation from the curve is a further term.
//! A cost of 1e-4 corresponds to a deviation of about one hundredth of the stroke.

use std::f64::consts::TAU;

use crate::synthesize::task::{Phase, Sense, Task, Timing};
use linkage::math::KeepNan;
use linkage::math::statistics::ends;

/// Refined candidates are compared with the task at rows that are at most this crank angle apart (rad, 3 deg).
pub(super) const STEP: f64 = TAU / 120.0;
/// Weight of motion in the wrong sense, and of too little motion in a moving phase. Motion in a dwell has the weight 1.
const WRONG: f64 = 4.0;
/// Where a motion ends and the opposite motion begins, the output's rate should be zero.
/// The rate times this crank angle (rad, 20 deg) counts as a deviation (fraction of the stroke).
pub(super) const LATE: f64 = TAU / 18.0;
/// The output's rate at the end of a phase is computed from a row before and a row after the end.
/// The distance of these rows from the end is at most this angle (rad, 0.25 deg).
const BESIDE: f64 = TAU / 1440.0;
/// Weight of the squared relative violations of limits in the cost. Squared fractions of the stroke have the weight 1.
const LIMIT: f64 = 10.0;

/// Computes the cost of outputs that are sampled at certain crank angles.
pub(super) struct Rater<'a> {
    timing: &'a Timing,
    /// Crank angles (rad) of the samples, from 0 to a full turn.
    pub(super) turns: Vec<f64>,
    /// Row at which each phase ends.
    pub(super) ends: Vec<usize>,
    /// The required curve at the samples; empty if the output need not follow a curve.
    pub(super) wanted: Vec<f64>,
    /// The output over two turns, so that any row can be the beginning of the turn.
    twice: Vec<f64>,
    span: f64,
}

impl<'a> Rater<'a> {
    /// Divides the turn into `count` equal parts. The end of a phase is moved to the nearest row.
    pub(super) fn even(timing: &'a Timing, count: usize) -> Self {
        let turns: Vec<f64> = (0..=count).map(|row| TAU * (row as f64 / count as f64)).collect();
        let phases = timing.phases();
        // Every phase gets at least one row, even if it is short: the limits leave a row for each other phase.
        let end = |(index, phase): (usize, &Phase)| {
            let row = (phase.to / TAU * count as f64).round() as usize;
            row.clamp(index + 1, count + index + 1 - phases.len())
        };
        let ends = phases.iter().enumerate().map(end).collect();
        Rater::on(timing, turns, ends)
    }

    /// Places rows at most `step` (rad) apart. The end of each phase is one of the rows.
    /// Two more rows close to each end give the output's rate there.
    /// A rate computed over whole steps would misplace the extreme position by a few hundredths of a degree.
    pub(super) fn fitted(timing: &'a Timing, step: f64) -> Self {
        let (mut turns, mut ends) = (vec![0.0], Vec::new());
        for phase in timing.phases() {
            let long = phase.to - phase.from;
            let (parts, beside) = ((long / step).ceil().larger(4.0), BESIDE.smaller(long / 16.0));
            turns.push(phase.from + beside);
            turns.extend((1..parts as usize).map(|part| phase.from + long * (part as f64 / parts)));
            turns.extend([phase.to - beside, phase.to]);
            ends.push(turns.len() - 1);
        }
        Rater::on(timing, turns, ends)
    }

    fn on(timing: &'a Timing, turns: Vec<f64>, ends: Vec<usize>) -> Self {
        let wanted = match timing.follows() {
            true => turns.iter().filter_map(|&turn| timing.wanted(turn)).collect(),
            false => Vec::new(),
        };
        Rater { timing, turns, ends, wanted, twice: Vec::new(), span: 0.0 }
    }

    /// Stores an output and returns its stroke.
    pub(super) fn take(&mut self, curve: &[f64]) -> f64 {
        let [low, high] = ends(curve.iter().copied());
        self.span = high - low;
        let share = |value: &f64| (value - low) / self.span;
        self.twice.clear();
        // The last row of a turn is also the first row of the next turn, so the first copy of the turn is stored
        // without its last row.
        self.twice.extend(curve[..curve.len() - 1].iter().map(share));
        self.twice.extend(curve.iter().map(share));
        self.twice.push(share(&curve[1]));
        self.span
    }

    /// Cost of the stored output if the turn begins at the row `shift`.
    /// `forward` is the sense of the output (+1 or -1) that counts as forward.
    pub(super) fn cost(&self, shift: usize, forward: f64) -> f64 {
        let (offset, slope) = if forward > 0.0 { (0.0, 1.0) } else { (1.0, -1.0) };
        let at = |row: usize| offset + slope * self.twice[shift + row];
        let (mut cost, mut from) = (0.0, 0);
        let phases = self.timing.phases();
        for (index, (phase, &to)) in phases.iter().zip(&self.ends).enumerate() {
            cost += match phase.sense {
                Sense::Dwell => unrest((from..=to).map(at)),
                sense @ (Sense::Forward | Sense::Back) => {
                    let sign = sense.sign();
                    let way = |row: usize| sign * (at(row + 1) - at(row));
                    let back: f64 = (from..to).map(|row| (-way(row)).larger(0.0)).sum();
                    let little = (phase.least - sign * (at(to) - at(from))).larger(0.0);
                    WRONG * (back * back + little * little)
                }
            };
            if let Some(level) = self.timing.level(index) {
                cost += (at(to) - level).powi(2);
            }
            let next = phases[(index + 1) % phases.len()].sense;
            if phase.sense.sign() * next.sign() < 0.0 {
                let beyond = if to + 1 < self.turns.len() { self.turns[to + 1] } else { TAU + self.turns[1] };
                let rate = (at(to + 1) - at(to - 1)) / (beyond - self.turns[to - 1]);
                cost += (LATE * rate).powi(2);
            }
            from = to;
        }
        if !self.wanted.is_empty() {
            let apart: f64 = self.wanted.iter().enumerate().map(|(row, wanted)| (at(row) - wanted).powi(2)).sum();
            cost += phases.len() as f64 * apart / self.wanted.len() as f64;
        }
        cost
    }

    /// Addition to the cost for violated limits of the stroke, the acceleration (m/s^2) and the sine of the
    /// transmission angle.
    pub(super) fn excess(&self, task: &Task, sine: f64, acceleration: f64) -> f64 {
        let [least, most] = task.stroke;
        let short = if least > 0.0 { (1.0 - self.span / least).larger(0.0) } else { 0.0 };
        let long = if most.is_finite() { (self.span / most - 1.0).larger(0.0) } else { 0.0 };
        let flat = (task.transmission.sin() - sine).larger(0.0);
        // If the acceleration has no limit, the limit is infinite and the quotient is zero.
        let hard = (acceleration / task.acceleration - 1.0).larger(0.0);
        LIMIT * (short * short + long * long + flat * flat + hard * hard)
    }
}

/// Cost of motion in a dwell: the square of the output's range plus twelve times the output's variance.
/// For a uniform drift, the two terms are equal.
fn unrest(values: impl Iterator<Item = f64>) -> f64 {
    let (mut count, mut sum, mut squares, mut low, mut high) = (0.0, 0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        count += 1.0;
        sum += value;
        squares += value * value;
        low = value.smaller(low);
        high = value.larger(high);
    }
    let scatter = (squares / count - (sum / count).powi(2)).larger(0.0);
    (high - low).powi(2) + 12.0 * scatter
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timing() -> Timing {
        let phase = |from: f64, to: f64, sense| Phase {
            from: from.to_radians(),
            to: to.to_radians(),
            sense,
            level: None,
            least: 0.05,
        };
        let phases = vec![
            phase(0.0, 100.0, Sense::Forward),
            phase(100.0, 200.0, Sense::Dwell),
            phase(200.0, 300.0, Sense::Back),
            phase(300.0, 360.0, Sense::Dwell),
        ];
        Timing::of(phases).unwrap().followed().unwrap()
    }

    #[test]
    fn the_requested_curve_costs_nothing_at_any_scale_and_shift() {
        let timing = timing();
        for mut rater in [Rater::even(&timing, 72), Rater::fitted(&timing, 0.02)] {
            let turns = rater.turns.clone();
            let curve: Vec<f64> = turns.iter().map(|&turn| 3.0 - 7.0 * timing.wanted(turn).unwrap()).collect();
            assert!((rater.take(&curve) - 7.0).abs() < 1e-12);
            assert!(rater.cost(0, -1.0) < 1e-20 && rater.cost(0, 1.0) > 1.0);
        }
        let mut rater = Rater::even(&timing, 72);
        let late: Vec<f64> = (0..=72).map(|row| timing.wanted(rater.turns[(row + 60) % 72]).unwrap()).collect();
        rater.take(&late);
        assert!(rater.cost(12, 1.0) < 1e-20 && rater.cost(11, 1.0) > 1e-4);
    }

    #[test]
    fn a_drift_in_a_dwell_counts_twice_its_square() {
        // The variance of uniformly spaced values is nearly the square of their range divided by 12.
        let drift = unrest((0..=1000).map(|k| 0.02 * f64::from(k) / 1000.0));
        assert!((drift - 2.0 * 0.02f64.powi(2)).abs() < 2e-6, "{drift}");
        assert_eq!(unrest([0.3; 5].into_iter()), 0.0);
    }
}
