//! A scenario with its results.

use super::ask::Question;
use linkage::case::Case;
use linkage::trajectory::Trajectory;
use scenario::Scenario;

/// A solved scenario.
pub(crate) struct Source {
    /// The scenario.
    pub(crate) scenario: Scenario,
    /// The requested charts.
    pub(crate) question: Question,
    /// The case as it was solved: only the part of the mechanism that the charts need.
    pub(crate) case: Case,
    /// Names of solvers and engines, and their results.
    pub(crate) parties: Vec<(&'static str, Trajectory)>,
    /// Whether the user has chosen the instants.
    pub(crate) chosen_instants: bool,
}
