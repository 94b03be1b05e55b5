//! The simulating side: a family of engines behind one contract, judged by the conformance tests.

pub mod rapier;

use crate::case::Case;
use crate::solver::Solver;
use crate::trajectory::ChannelKind;

/// An engine: a solver that integrates in time steps.
pub trait Engine: Solver {
    /// Name and version of the software behind it.
    fn version(&self) -> String;

    /// Time step (s).
    fn step(&self) -> f64;

    /// The same engine with another time step (s).
    fn with_step(&self, step: f64) -> Box<dyn Engine>;

    /// Order of convergence that the method should show in a channel.
    fn formal_order(&self, channel: &ChannelKind) -> f64;

    /// Bound on the rounding noise of a channel on the grid of a case, in the channel's unit.
    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64;

    /// Settings that influence the result, by name.
    fn settings(&self) -> Vec<(&'static str, String)>;
}

/// Every engine, with the time step `step` (s), the default first.
#[must_use]
pub fn all(step: f64) -> Vec<Box<dyn Engine>> {
    vec![Box::new(rapier::Rapier::new(step))]
}

/// The engine called `name`, with the time step `step` (s).
#[must_use]
pub fn named(name: &str, step: f64) -> Option<Box<dyn Engine>> {
    all(step).into_iter().find(|engine| engine.name() == name)
}
