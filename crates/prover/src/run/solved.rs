//! Solves a scenario with both analytic sides, without engines. The purpose is a comparison with a table or a
//! recording, or the judgement of formulas.

use super::dependence::Dependence;
use super::each_side::Reference;
use super::entrants::{ObservedSides, TRUE_SIDES};
use super::formulas::Judgement;
use super::known::usual;
use super::ledger::Ledger;
use super::problem::Problem;
use crate::bounds::{Check, Verdict, magnitudes, magnitudes_by};
use crate::check::{FormulaCause, KnownTrajectory, MOST_WORK, needed, telling};
use crate::sentences;
use crate::tolerance::BoundBasis;
use analytic::range::explained;
use linkage::case::{Case, Grid};
use linkage::error::{Error, ErrorKind, Result};
use linkage::trajectory::{Channel, Trajectory};
use scenario::{Claim, Formulas, Scenario};

/// Lower limits of the errors of an analytic side's trajectory: the rounding errors in well-conditioned poses. There is
/// one limit for each channel, in the channel's unit.
#[must_use]
pub fn known_at_least(trajectory: &Trajectory) -> Vec<f64> {
    let sizes = magnitudes(trajectory).into_iter().zip(trajectory.channels());
    sizes.map(|(size, channel)| usual(channel.kind.stage) * size).collect()
}

/// Lower limits of the errors of a trajectory that an analytic side solved with all channels of a case. The limit of a
/// channel follows from the largest numbers in the Assur groups on which the channel depends.
#[must_use]
pub fn known_of_complete(case: &Case, trajectory: &Trajectory) -> Vec<f64> {
    let depends = Dependence::of(case, trajectory.channels());
    let sizes = magnitudes_by(trajectory, &depends.of, &|from, to| depends.feeds(from, to));
    sizes.into_iter().zip(trajectory.channels()).map(|(size, channel)| usual(channel.kind.stage) * size).collect()
}

/// The channels that are solved for a claim: the channels needed to judge the claim, and the other channels of the
/// claim's subject.
/// If a component is zero except for rounding, its error follows from the other channels of the subject.
#[must_use]
pub fn asked(claim: &Claim, case: &Case) -> Vec<Channel> {
    let is_beside = |channel: &Channel| {
        claim.channels.iter().any(|(_, own)| {
            let own = &own.channel;
            own.of == channel.of && own.kind.subject == channel.kind.subject && own.kind.stage >= channel.kind.stage
        })
    };
    let mut asked = needed(claim, case);
    asked.extend(case.all_channels().into_iter().filter(is_beside));
    asked
}

/// Solves the part of a case on which the requested channels depend, with both sides, and judges the formulas.
fn of_asked(
    scenario: &Scenario,
    whole: &Case,
    asked: &[Channel],
    formulas: &Formulas,
) -> Result<(Case, ObservedSides)> {
    let case = whole.wanting_only(asked).scene()?.case;
    let problem = Problem { oracles: &[], formulas, ..Problem::of(scenario, &case) };
    let sides = ObservedSides::of(problem, whole, TRUE_SIDES, Reference::Assur, &mut Ledger::default());
    let sides = sides.map_err(|error| explained(&case, error))?;
    Ok((case, sides))
}

/// Results of both sides, with their errors.
pub struct Solved {
    /// The solved case: the part of the mechanism on which the claims depend, at the requested instants.
    pub case: Case,
    sides: ObservedSides,
    /// Lower limit of the error of every channel. The limit does not depend on the selection of solved channels.
    least: Vec<f64>,
}

impl Solved {
    /// Solves the channels that some claims of a scenario need, at the instants of a grid.
    ///
    /// # Errors
    /// The errors of the analytic solvers, each with the crank angle of the failure.
    /// An error also if the drive does not reach an instant of the grid.
    pub fn of<'a>(scenario: &Scenario, grid: Grid, claims: impl IntoIterator<Item = &'a Claim>) -> Result<Self> {
        let asked: Vec<Channel> = claims.into_iter().flat_map(|claim| asked(claim, &scenario.case)).collect();
        let (case, sides) = of_asked(scenario, &scenario.case.on(grid)?, &asked, &Formulas::over(Vec::new()))?;
        let least = vec![0.0; sides.trajectory().channels().len()];
        Ok(Solved { case, sides, least })
    }

    /// Returns these results with new lower limits of the errors: for each channel, the limit that `of` returns. `of`
    /// must take all channels of the mechanism into account: if the solved channels are zero except for rounding, their
    /// rounding error comes from channels that are not solved.
    #[must_use]
    pub fn known_at_least(mut self, of: &dyn Fn(&Channel) -> f64) -> Self {
        self.least = self.sides.trajectory().channels().iter().map(of).collect();
        self
    }

    /// Calls `then` with the results of the reference and their errors.
    ///
    /// # Errors
    /// The errors of `then`.
    pub fn on_course<T>(&self, then: impl FnOnce(&KnownTrajectory) -> Result<T>) -> Result<T> {
        self.sides.on_course(&self.case, Reference::Assur, |course| then(&course.known_at_least(&self.least)))
    }

    /// The reference's numbers.
    #[must_use]
    pub fn trajectory(&self) -> &Trajectory {
        self.sides.trajectory()
    }

    /// The checks that compare the two sides with each other.
    pub fn checks(&self) -> &[Check] {
        &self.sides.checks
    }
}

/// The formulas of a scenario, judged against both analytic sides.
#[derive(Clone, Debug)]
pub struct Claimed {
    /// The judgement of every claim, against each of the two sides.
    pub judgement: Judgement,
    /// The checks of the two analytic sides, without the checks of the formulas.
    pub checks: Vec<Check>,
    /// The overall verdict.
    pub verdict: Verdict,
}

/// Judges the formulas of a scenario. Solves only the claimed channels and the channels needed for their derivatives.
///
/// # Errors
/// [`ErrorKind::Input`] if no formula claims anything. The errors of the analytic solvers, each with the crank angle of
/// the failure.
pub fn judge(scenario: &Scenario) -> Result<Claimed> {
    let mut asked: Vec<_> = scenario.formulas.claims().flat_map(|(_, claim)| needed(claim, &scenario.case)).collect();
    if asked.is_empty() {
        let message = sentences::no_formula_of_the_scenario(&scenario.name);
        return Err(Error::new(ErrorKind::Input, message).key("formula").help(sentences::ADD_CHANNEL_TO_A_FORMULA));
    }
    let (_, mut sides) = of_asked(scenario, &scenario.case, &asked, &scenario.formulas)?;
    let is_open = |own: &Judgement| {
        let mut causes = own.causes.iter();
        // If the search for causes was long, the search is not repeated with more channels.
        own.work <= MOST_WORK
            && causes.any(|(name, cause)| {
                !cause.as_ref().is_some_and(FormulaCause::is_whole) && !own.unsought.contains(name)
            })
    };
    if let Some(own) = sides.judgement.as_mut().filter(|own| is_open(own)) {
        // The search for causes is repeated with more channels: the error may be a missing term whose channel was not
        // requested.
        asked.extend(telling(&scenario.case, scenario.formulas.claims().map(|(_, claim)| claim)));
        let (_, all) = of_asked(scenario, &scenario.case, &asked, &scenario.formulas)?;
        if let Some(again) = all.judgement {
            (own.causes, own.unsought, own.work) = (again.causes, again.unsought, own.work + again.work);
        }
    }
    let verdict = sides.verdict();
    let judgement = sides.judgement.ok_or_else(|| {
        Error::new(ErrorKind::Input, sentences::NO_CLAIMED_CHANNEL_WAS_SOLVED)
            .key("formula")
            .help(sentences::CLAIM_A_CHANNEL_OF_THE_SCENARIO)
    })?;
    let is_own = |check: &Check| !matches!(check.basis, BoundBasis::Formula { .. });
    Ok(Claimed { judgement, verdict, checks: sides.checks.into_iter().filter(is_own).collect() })
}
