//! What is proven: a case, and the statements of a scenario about its solution.
//! See docs/numerics/bounds.md.

use crate::bounds::Built;
use linkage::case::Case;
use linkage::math::KeepNan;
use scenario::{Formulas, Oracle, Scenario};

/// A case, and the statements of a scenario about its solution.
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
    /// The statements of a scenario, applied to a case of its mechanism.
    pub fn of(scenario: &'a Scenario, case: &'a Case) -> Self {
        let Scenario { oracles, formulas, engine_rel, .. } = scenario;
        Problem { case, oracles, formulas, engine_rel: *engine_rel }
    }

    /// Size, speed and force that the case is built for, whatever moves in it. They are the scales for what vanishes in
    /// the whole mechanism.
    /// The force is the weight of all links or, if larger, the force that accelerates them at that speed and size. It
    /// is zero without masses.
    pub(super) fn built(&self) -> Built {
        let case = self.case;
        let (length, speed) = (case.mechanism.size(), case.drives.top_speed());
        let mass: f64 = case.mechanism.links().iter().map(|link| link.mass).sum();
        Built { length, speed, force: mass * case.gravity.norm().larger(speed * speed * length) }
    }
}
