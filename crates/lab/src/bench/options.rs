//! What is measured, and by which clock.

use prover::engines::EngineName;

/// Seconds on a clock, from any beginning.
pub type Clock<'a> = &'a dyn Fn() -> f64;

/// A point is limited by the floor if its error is less than this many times the reference's own.
pub const CLEAR: f64 = 100.0;

/// What is measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BenchOptions {
    /// Engines; if empty, all of this build.
    pub engines: Vec<EngineName>,
    /// A coarse picture: fewer settings and one round of timing.
    pub is_quick: bool,
    /// Work allowed to all engines together in one round, in steps without sweeps.
    pub budget: Option<f64>,
    /// Rounds of timing, of which the shortest counts.
    pub rounds: Option<usize>,
}

impl BenchOptions {
    /// Work allowed, given or usual.
    pub(super) fn budget(&self) -> f64 {
        self.budget.unwrap_or(if self.is_quick { 3e5 } else { 2e6 })
    }

    /// Rounds, given or usual; at least one.
    pub(super) fn rounds(&self) -> usize {
        self.rounds.unwrap_or(if self.is_quick { 1 } else { 3 }).max(1)
    }
}
