//! What is proven: a case, and what a scenario says of its solution.

use linkage::case::Case;
use scenario::{Formulas, Oracle, Scenario};

/// A case, and what a scenario says of its solution.
#[derive(Clone, Copy)]
pub struct Problem<'a> {
    pub(crate) case: &'a Case,
    /// Published numbers.
    pub(crate) oracles: &'a [Oracle],
    pub(crate) formulas: &'a Formulas,
    /// Largest bound on an engine's error, as a share of a channel's scale, at which agreement still proves something.
    pub(crate) engine_rel: f64,
}

impl<'a> Problem<'a> {
    /// What a scenario says, of a case of its mechanism.
    pub fn of(scenario: &'a Scenario, case: &'a Case) -> Self {
        let Scenario { oracles, formulas, engine_rel, .. } = scenario;
        Problem { case, oracles, formulas, engine_rel: *engine_rel }
    }
}
