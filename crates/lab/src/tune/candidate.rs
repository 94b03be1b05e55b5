//! Tried settings and their cost.

use linkage::engine::{Engine, Settings};
use linkage::error::Result;

/// One method of an engine, at the largest step that meets the request.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Name of the engine.
    pub engine: &'static str,
    /// Settings of the engine.
    pub settings: Settings,
    /// Whether the resolution in the settings is an accuracy, not a step.
    pub controls_error: bool,
    /// Largest error against the reference, divided by the channel's scale.
    pub verified: f64,
    /// Channel with the largest error.
    pub worst: String,
    /// Cost of the run, in the unit of the [`tune`](super::tune) argument `price`.
    pub price: f64,
    /// Whether a proof at these settings agrees in all requested channels.
    pub is_proven: bool,
}

/// Measures the cost of a run. The arguments are the engine and a closure.
/// The closure does the run and must be called at least once.
pub type Price<'a> = &'a mut dyn FnMut(&dyn Engine, &mut dyn FnMut() -> Result<()>) -> Result<f64>;

/// Error and cost of one run.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    /// Largest error divided by the channel's scale; infinite if the run failed.
    pub(super) error: f64,
    /// Channel with the largest error.
    pub(super) worst: String,
    /// Cost of the run; infinite if the run failed.
    pub(super) price: f64,
}
