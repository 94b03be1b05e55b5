//! The subject of a proof: a case, and the statements of a scenario about its solution.
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
    /// Agreement proves nothing if the bound on an engine's error exceeds this fraction of a channel's scale.
    pub(crate) engine_rel: f64,
}

impl<'a> Problem<'a> {
    /// The statements of a scenario, applied to a case of its mechanism.
    pub fn of(scenario: &'a Scenario, case: &'a Case) -> Self {
        let Scenario { oracles, formulas, engine_rel, .. } = scenario;
        Problem { case, oracles, formulas, engine_rel: *engine_rel }
    }
}

/// Length, speed and force from the data of the case. These values do not depend on which links move.
/// These three values give the scales of quantities that are zero in the whole mechanism. The force is the larger of
/// two forces: the weight of all links, and the force that keeps the mass of all links on a circle with this length as
/// radius, at this angular speed. The force is zero if the links have no masses.
pub(super) fn built(case: &Case) -> Built {
    let (length, speed) = (case.mechanism.size(), case.drives.top_speed(case.mechanism.size()));
    let mass: f64 = case.mechanism.links().iter().map(|link| link.mass).sum();
    Built { length, speed, force: mass * case.gravity.norm().larger(speed * speed * length) }
}
