//! Ring buffer of the numbers of the last steps, and interpolation between steps.

use std::ops::Range;

use linkage::math::interpolate::{POINTS, lagrange_weights};

/// Number of stored steps. The interpolation needs six steps, and second differences need one more step at either end.
/// The other steps are for reactions, which the engine reports up to one step late, and for the first steps of a free
/// motion.
pub(super) const NODES: usize = POINTS + 8;

/// An instant closer to a step than this fraction of the step size counts as that step. Rounding separates the instants
/// of the grid slightly from the steps.
const ON_A_STEP: f64 = 1e-9;

/// An instant: the number of a step, and the time since this step as a fraction of the step size.
/// The step is normally the last one before the instant, so that the fraction is from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) before: i64,
    pub(super) share: f64,
}

impl Place {
    /// The instant `x`, counted in steps.
    pub(super) fn of(x: f64) -> Self {
        let before = (x + ON_A_STEP).floor();
        let share = x - before;
        Place { before: before as i64, share: if share < ON_A_STEP { 0.0 } else { share } }
    }

    /// First of the six steps of [`Place::weights`].
    pub(super) fn first(self) -> i64 {
        self.before - 2
    }

    /// The same instant. If it lies before step `lowest`, it is counted from step `lowest`, with a negative fraction.
    pub(super) fn from(self, lowest: i64) -> Self {
        let before = self.before.max(lowest);
        Place { before, share: self.share + (self.before - before) as f64 }
    }

    /// Weights of the six steps from [`Place::first`] on, for the instant `back` steps before this instant.
    pub(super) fn weights(self, back: f64) -> [f64; POINTS] {
        lagrange_weights(2.0 + self.share - back)
    }
}

/// Ring buffer of the last steps.
#[derive(Debug)]
pub(super) struct Ring {
    width: usize,
    newest: i64,
    rows: Vec<f64>,
}

impl Ring {
    /// An empty ring of rows of `width` numbers. The first row that is pushed belongs to step `start`.
    pub(super) fn new(width: usize, start: i64) -> Self {
        Ring { width, newest: start - 1, rows: vec![f64::NAN; NODES * width] }
    }

    /// Number of the newest step.
    pub(super) fn newest(&self) -> i64 {
        self.newest
    }

    /// Advances to the next step and returns its row for writing.
    pub(super) fn push(&mut self) -> &mut [f64] {
        self.newest += 1;
        self.row_mut(self.newest)
    }

    /// Advances to the next step but leaves its row unchanged, with the numbers of an older step.
    pub(super) fn skip(&mut self) {
        self.newest += 1;
    }

    fn at(&self, step: i64) -> usize {
        step.rem_euclid(NODES as i64) as usize * self.width
    }

    pub(super) fn row(&self, step: i64) -> &[f64] {
        let at = self.at(step);
        &self.rows[at..at + self.width]
    }

    pub(super) fn row_mut(&mut self, step: i64) -> &mut [f64] {
        let at = self.at(step);
        &mut self.rows[at..at + self.width]
    }

    /// Writes to `into` the weighted sum of the columns `part`, with one weight for each row from step `first` on.
    pub(super) fn weigh(&self, first: i64, weights: &[f64], part: Range<usize>, into: &mut [f64]) {
        into.fill(0.0);
        for (k, weight) in weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
            let row = &self.row(first + k as i64)[part.clone()];
            for (sum, value) in into.iter_mut().zip(row) {
                *sum += weight * value;
            }
        }
    }
}
