//! Another program that solves the same scenario.

use super::effort::RunEffort;

/// One way in which a peer wants to be run: it chooses its own ladder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Way {
    /// Settings besides the resolution, in words.
    pub name: String,
    /// Step or accuracy, in words.
    pub resolution: String,
    /// What the peer wants to be told when it is run, as it has said it.
    pub told: String,
}

/// A peer's answer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// Name and version of the software.
    pub version: String,
    /// Columns by name, `t_s` among them. All are of the same length; numbers may be anything.
    pub columns: Vec<(String, Vec<f64>)>,
    /// Times that it has measured itself (s), at least one.
    pub seconds: Vec<f64>,
    /// What it has counted.
    pub effort: RunEffort,
}

/// Another program. Reasons are in words: they are shown on the diagram.
pub trait Peer {
    /// Name.
    fn name(&self) -> &str;

    /// The ways in which it wants to be run.
    ///
    /// # Errors
    /// Why it cannot be asked.
    fn ways(&self) -> Result<Vec<Way>, String>;

    /// Runs it once.
    ///
    /// # Errors
    /// Why there is no answer.
    fn run(&self, way: &Way) -> Result<Answer, String>;
}
