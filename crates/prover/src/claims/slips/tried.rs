//! Slips that were mended, and what the formula is with them.

use super::slip::{Kind, Slip};
use crate::claims::trial::Trial;
use formula::Tree;

/// A slip mended: the formulas that it changes by their indices, as they would be right, and the slip in words.
pub(in crate::claims) struct Mended {
    pub(in crate::claims) changed: Vec<(usize, Tree)>,
    pub(in crate::claims) slip: Slip,
    /// The simplest has the least: whether units contradict it, whether it is made in many places, whether it is in
    /// a step, and its kind.
    pub(in crate::claims) rank: (bool, bool, bool, Kind),
    /// Share of the largest difference that it leaves; zero if the formula is right with it.
    pub(in crate::claims) left: f64,
    /// Number of slips that had been tried by then: those that are as simple.
    pub(in crate::claims) among: usize,
}

/// Slips that were tried.
#[derive(Default)]
pub(in crate::claims) struct Tried {
    /// Those with which the formula is right, the simplest first.
    pub(in crate::claims) right: Vec<Mended>,
    /// Of all others, the one that leaves least, if it leaves little.
    pub(in crate::claims) nearest: Option<Mended>,
    /// How many were tried.
    pub(in crate::claims) count: usize,
}

impl Tried {
    /// Judges a slip that was mended, and keeps it if the formula is right with it, or nearer than before.
    pub(super) fn put(&mut self, trial: &mut Trial, mended: Mended) {
        match trial.left(&mended.changed, 0.0) {
            Some(0.0) => self.right.push(Mended { left: 0.0, ..mended }),
            // A simpler one that leaves hardly more is nearer.
            Some(left) if self.nearest.as_ref().is_none_or(|nearest| left < 0.8 * nearest.left) => {
                self.nearest = Some(Mended { left, among: self.count, ..mended });
            }
            Some(_) | None => {}
        }
    }
}
