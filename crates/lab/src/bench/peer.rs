//! A peer: a program other than linkproof that solves the measured scenario.

use super::point::RunEffort;

/// One method of a peer. The peer chooses its methods and resolutions itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Way {
    /// Settings except the resolution, in words.
    pub name: String,
    /// Step or accuracy, in words.
    pub resolution: String,
    /// The peer's description of the method, which is passed back to the peer for a run.
    pub told: String,
}

/// A peer's answer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// Name and version of the software.
    pub version: String,
    /// Columns by name, including `t_s`. All columns have the same length; their values are not yet checked.
    pub columns: Vec<(String, Vec<f64>)>,
    /// Times measured by the peer (s), at least one.
    pub seconds: Vec<f64>,
    /// Operations that the peer has counted.
    pub effort: RunEffort,
}

/// Another program. A peer's errors are texts, which the diagram shows.
pub trait Peer {
    /// Name.
    fn name(&self) -> &str;

    /// The methods that the peer offers.
    ///
    /// # Errors
    /// The reason why the peer cannot be called.
    fn ways(&self) -> Result<Vec<Way>, String>;

    /// Runs the peer once.
    ///
    /// # Errors
    /// The reason why the peer gives no answer.
    fn run(&self, way: &Way) -> Result<Answer, String>;
}
