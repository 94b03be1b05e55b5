//! Scope of a measurement, and its clock.

use prover::engines::EngineName;

/// Seconds on a clock, from an arbitrary origin.
pub type Clock<'a> = &'a dyn Fn() -> f64;

/// A point whose error is below this multiple of the reference's error counts as limited by the reference.
pub const CLEAR: f64 = 100.0;

/// What is measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BenchOptions {
    /// Engines; if empty, all engines of this build.
    pub engines: Vec<EngineName>,
    /// A rough measurement: fewer settings and one round of timing.
    pub is_quick: bool,
    /// Work allowed for one round of all engines together. The unit is the work of an engine step without sweeps.
    pub budget: Option<f64>,
    /// Number of timing rounds; the shortest time counts.
    pub rounds: Option<usize>,
}

impl BenchOptions {
    /// The requested budget, else the default.
    pub(super) fn budget(&self) -> f64 {
        self.budget.unwrap_or(if self.is_quick { 3e5 } else { 2e6 })
    }

    /// The requested number of rounds, else the default; at least one.
    pub(super) fn rounds(&self) -> usize {
        self.rounds.unwrap_or(if self.is_quick { 1 } else { 3 }).max(1)
    }
}
