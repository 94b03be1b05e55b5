//! Jumps of the values in load tables within a step of a free motion.
//!
//! If a table jumps within a step, the load of the step is the mean of the values before and after the jump, weighted
//! by the fractions of the step.
//! Without the weights, the error of the motion after the jump would have no clear order of convergence.

use linkage::case::Case;
use linkage::drive::InputState;
use linkage::math::just_below;

/// The jumps of a case's tables.
#[derive(Debug)]
pub(super) struct Jumps {
    /// Crank angles of the jumps (rad), each with the period of its table (rad).
    at: Vec<[f64; 2]>,
    /// Rate of the crank one step earlier (rad/s); NaN before the second step.
    rate: f64,
}

impl Jumps {
    /// The jumps of a case; `None` if no table jumps.
    pub(super) fn of(case: &Case) -> Option<Self> {
        let at: Vec<[f64; 2]> = case.load_jumps().collect();
        (!at.is_empty()).then_some(Jumps { at, rate: f64::NAN })
    }

    /// The first jump that the crank passes in a step of `step` (s); `None` if it passes no jump.
    /// Returns the fraction of the step before the jump, and the range of crank angles beyond the jump (rad).
    pub(super) fn passed(&mut self, crank: InputState, step: f64, is_first: bool) -> Option<(f64, [f64; 2])> {
        // The engine turns the crank with the rate at the end of the step.
        let next = if self.rate.is_nan() { crank.rate } else { 2.0 * crank.rate - self.rate };
        self.rate = if is_first { f64::NAN } else { crank.rate };
        let (crank, turn) = (crank.value, next * step);
        let of = |&[jump, period]: &[f64; 2]| {
            let before = crank - jump - period * ((crank - jump) / period).floor();
            let (way, beyond) = if turn > 0.0 {
                let way = period - before;
                (way, [-just_below(-(crank + way)), f64::INFINITY])
            } else {
                (before, [f64::NEG_INFINITY, just_below(crank - before)])
            };
            (way < turn.abs()).then(|| (way / turn.abs(), beyond))
        };
        self.at.iter().filter_map(of).min_by(|a, b| a.0.total_cmp(&b.0))
    }
}
