//! A scenario solved by both analytic sides at instants of somebody else, without engines.

use super::entrants::{Sides, TRUE_SIDES};
use super::known::usual;
use super::ledger::Ledger;
use super::options::Reference;
use crate::claims::{Course, needed};
use crate::compare::{Check, magnitudes};
use crate::scenario::{Claim, Formulas, Scenario};
use analytic::range::explained;
use linkage::case::{Case, Grid};
use linkage::error::Result;
use linkage::trajectory::Trajectory;

/// How far the numbers of an analytic side's trajectory are known where nothing was measured: what rounding leaves in
/// well conditioned poses, channel by channel, in their units.
#[must_use]
pub fn known_at_least(trajectory: &Trajectory) -> Vec<f64> {
    let sizes = magnitudes(trajectory).into_iter().zip(trajectory.channels());
    sizes.map(|(size, channel)| usual(channel.kind.stage) * size).collect()
}

/// What both sides find, and how well they know it.
pub struct Solved {
    /// What was solved: the part of the mechanism that the claims need, at the instants.
    pub case: Case,
    sides: Sides,
}

impl Solved {
    /// Solves what some claims of a scenario need at the instants of a grid.
    ///
    /// # Errors
    /// Those of the sides, with the crank angle, and of a grid to which the drive does not come.
    pub fn of<'a>(scenario: &Scenario, grid: Grid, claims: impl IntoIterator<Item = &'a Claim>) -> Result<Self> {
        let asked: Vec<_> = claims.into_iter().flat_map(|claim| needed(claim, &scenario.case)).collect();
        let case = scenario.case.on(grid)?.wanting_only(&asked).scene()?.case;
        let formulas = Formulas::over(Vec::new());
        let scene = Scenario { case, oracles: Vec::new(), formulas, ..scenario.clone() };
        let sides = Sides::of([&scene, &scene], TRUE_SIDES, Reference::Assur, &mut Ledger::default())
            .map_err(|error| explained(&scene.case, error))?;
        Ok(Solved { case: scene.case, sides })
    }

    /// What the reference finds, with how well it knows it.
    ///
    /// # Errors
    /// Those of `then`.
    pub fn on_course<T>(&self, then: impl FnOnce(&Course) -> Result<T>) -> Result<T> {
        self.sides.on_course(&self.case, 0, then)
    }

    /// The reference's numbers.
    #[must_use]
    pub fn trajectory(&self) -> &Trajectory {
        self.sides.trajectory()
    }

    /// The checks of the sides on each other.
    #[must_use]
    pub fn checks(&self) -> &[Check] {
        &self.sides.checks
    }
}
