//! Formulas alone: both analytic sides and what formulas claim of them, without an engine.

use super::each_side::Reference;
use super::entrants::{Sides, TRUE_SIDES};
use super::formulas::Judgement;
use super::ledger::Ledger;
use super::problem::Problem;
use crate::claims::{Cause, MOST_WORK, needed, telling};
use crate::compare::{Check, Verdict};
use crate::tolerance::Basis;
use analytic::range::explained;
use linkage::error::{Error, ErrorKind, Result};
use linkage::trajectory::Channel;
use scenario::Scenario;

/// What formulas come to on both sides.
#[derive(Clone, Debug)]
pub struct Claimed {
    /// What both sides say of every claim.
    pub judgement: Judgement,
    /// The checks of the sides themselves.
    pub checks: Vec<Check>,
    /// The verdict on all of it.
    pub verdict: Verdict,
}

/// Both sides on what is asked of a scenario.
fn solved(scenario: &Scenario, asked: &[Channel]) -> Result<Sides> {
    let case = scenario.case.wanting_only(asked).scene()?.case;
    let problem = Problem { oracles: &[], ..Problem::of(scenario, &case) };
    let sides = Sides::of(problem, &scenario.case, TRUE_SIDES, Reference::Assur, &mut Ledger::default());
    sides.map_err(|error| explained(&case, error))
}

/// Judges the formulas of a scenario. Only what they claim is solved, and what their derivatives need.
///
/// # Errors
/// [`ErrorKind::Input`] if no formula claims anything, and those of the sides, with the crank angle.
pub fn judge(scenario: &Scenario) -> Result<Claimed> {
    let mut asked = Vec::new();
    for (_, claim) in scenario.formulas.claims() {
        asked.extend(needed(claim, &scenario.case));
    }
    if asked.is_empty() {
        let message = format!("no formula of the scenario {} claims a channel", scenario.name);
        return Err(Error::new(ErrorKind::Input, message)
            .key("formula")
            .help("add `channel` to a [[formula]], or give a formula as an argument; docs/formulas.md has examples"));
    }
    let mut sides = solved(scenario, &asked)?;
    let is_open = |own: &Judgement| {
        let mut causes = own.causes.iter();
        // A search that was long is not done once more with more channels.
        own.work <= MOST_WORK
            && causes.any(|(name, cause)| !cause.as_ref().is_some_and(Cause::is_whole) && !own.unsought.contains(name))
    };
    if let Some(own) = sides.judgement.as_mut().filter(|own| is_open(own)) {
        // What is wrong may be a term that the mechanism has and nobody asked for.
        asked.extend(telling(&scenario.case, scenario.formulas.claims().map(|(_, claim)| claim)));
        if let Some(again) = solved(scenario, &asked)?.judgement {
            (own.causes, own.unsought, own.work) = (again.causes, again.unsought, own.work + again.work);
        }
    }
    let verdict = sides.verdict();
    let judgement = sides.judgement.ok_or_else(|| {
        Error::new(ErrorKind::Input, "no claimed channel was solved")
            .key("formula")
            .help("claim a channel of the scenario")
    })?;
    let is_own = |check: &Check| !matches!(check.basis, Basis::Formula { .. });
    Ok(Claimed { judgement, verdict, checks: sides.checks.into_iter().filter(is_own).collect() })
}
