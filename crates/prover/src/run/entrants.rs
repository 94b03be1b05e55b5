//! Participants of a proof, and the two parts of a proof: the analytic sides, and the engines compared with one side.

use crate::sentences;
use std::collections::{BTreeMap, BTreeSet};

use super::checks::{self, Beyond};
use super::each_side::{EachSide, Reference};
use super::engine_proof::EngineProof;
use super::formulas::Judgement;
use super::judge::Judge;
use super::known::Known;
use super::ledger::Ledger;
use super::observe::{Observed, Watch, observe};
use super::options::Chosen;
use super::problem::Problem;
use super::{engines, figures, formulas, methods, oracle};
use crate::bounds::{Check, Verdict, overall};
use crate::check::{self, FormulaOutcome, JudgedFormula, KnownTrajectory};
use analytic::{AssurSolver, NewtonSolver, TIGHT_ASSUR, TIGHT_NEWTON};
use formula::Rounded;
use linkage::case::Case;
use linkage::engine::Engine;
use linkage::error::Result;
use linkage::solver::{Progress, Solver};
use linkage::trajectory::{Channel, Trajectory};
use scenario::{Formulas, MechanismFigure};

/// Fraction of the progress that the analytic sides account for.
const SIDES: f64 = 0.1;

/// Largest number of operations to search for the causes of all wrong formulas of a file.
const MOST_WORK: u64 = 100_000_000;

/// An analytic side: its solver, and the same solver with a tighter tolerance of integration.
#[derive(Clone, Copy)]
pub struct Entrant<'a> {
    /// Solver of the side. The name of the solver must be the name of a solver in [`analytic::all`].
    pub solver: &'a dyn Solver,
    /// The side with a tighter tolerance.
    pub tight: &'a dyn Solver,
}

/// Side 1 and side 2 without changes.
pub const TRUE_SIDES: EachSide<Entrant<'static>> = EachSide::new(
    Entrant { solver: &AssurSolver, tight: &TIGHT_ASSUR },
    Entrant { solver: &NewtonSolver, tight: &TIGHT_NEWTON },
);

/// How engines take part in a proof.
pub struct EngineRole<'a> {
    /// The case that the engines solve, on the scenario's instants.
    pub case: &'a Case,
    /// Function that receives each engine and returns the engine to be used in its place.
    pub around: &'a dyn Fn(Box<dyn Engine>) -> Box<dyn Engine>,
    /// Whether the forces that the engines themselves exert are judged too.
    pub own_forces: bool,
}

impl<'a> EngineRole<'a> {
    /// Unchanged engines that solve `case`.
    pub(crate) fn on(case: &'a Case) -> Self {
        EngineRole { case, around: &|engine| engine, own_forces: true }
    }
}

/// The two analytic sides of a proof, observed and checked.
pub struct ObservedSides {
    reference: Reference,
    pub(super) observed: EachSide<Observed>,
    pub(super) known: Known,
    /// Checks on both sides, published numbers included.
    pub checks: Vec<Check>,
    /// Values of the figures that formulas claim, by both sides.
    figures: EachSide<Vec<(MechanismFigure, Rounded)>>,
    /// Judgement of the formulas; `None` if no formula claims anything.
    pub judgement: Option<Judgement>,
}

impl ObservedSides {
    /// Solves a problem with both sides. `whole` is the complete case; the problem's case may be only a part (the
    /// scene) of it.
    ///
    /// # Errors
    /// The errors of the sides.
    pub fn of(
        problem: Problem,
        whole: &Case,
        entrants: EachSide<Entrant>,
        reference: Reference,
        ledger: &mut Ledger,
    ) -> Result<Self> {
        let Problem { case, oracles, formulas: own_formulas, .. } = problem;
        let sides = EachSide::tried(|side| {
            let why = if side == reference { "the reference" } else { sentences::CHECKS_THE_REFERENCE };
            ledger.done(side.name(), why, || observe(case, entrants[side].solver, Watch::Side, &mut |_| {}))
        })?;
        let main = entrants[reference].solver;
        let beside = EachSide::of(|side| (entrants[side].tight, &sides[side].trajectory));
        let tighter = || Known::beside(case, reference, main, beside);
        let mut known = match case.is_free() {
            true => ledger.done("tighter integration", sentences::SHOWS_THE_ERROR_THAT_BOTH, tighter)?,
            false => {
                ledger.skipped("integration", sentences::THE_MOTION_IS_PRESCRIBED);
                tighter()?
            }
        };
        match checks::sides_differ(sides.pair().map(|own| &own.trajectory), &known) {
            true => ledger.done(sentences::CONDITION_OF_EVERY_POSE, sentences::THE_SIDES_DIFFER_BY_MORE, || {
                known.measure(case, entrants[Reference::Assur].solver)
            })?,
            false => ledger.skipped(sentences::CONDITION_OF_EVERY_POSE, sentences::THE_SIDES_DIFFER_BY_USUAL),
        }
        let mut checks = checks::of_sides(case, sides.each_ref(), &known);
        match methods::apply(case) {
            true => {
                checks.extend(ledger.done("published methods", sentences::OTHERS_THAN_OURS_FOR_ITS_TRIAD, || {
                    methods::checks(case, main)
                })?)
            }
            false => ledger.skipped("published methods", sentences::THERE_IS_NO_TRIAD_OF_CLASS),
        }
        match oracles.is_empty() {
            true => ledger.skipped("published numbers", sentences::THERE_ARE_NONE_OF_WANTED),
            false => {
                let channels = sides[reference].trajectory.channels();
                let integration = |side: Reference, channel: &Channel| {
                    let index = channels.iter().position(|own| own == channel);
                    index.map_or(0.0, |index| known.integration(side, index))
                };
                let solvers = EachSide::of(|side| entrants[side].solver);
                let numbers = || oracle::checks(problem, whole, solvers, &integration);
                checks.extend(ledger.done("published numbers", sentences::SOLVED_AT_THEIR_OWN_INSTANTS, numbers)?);
            }
        }
        let figures = EachSide::default();
        let mut own = ObservedSides { reference, observed: sides, known, checks, figures, judgement: None };
        match own_formulas.claims().next() {
            None => ledger.skipped("formulas", sentences::NONE_CLAIMS_A_WANTED_CHANNEL),
            Some(_) => {
                let judged = ledger.done("formulas", sentences::BY_VALUE_AND_BY_DERIVATIVE, || {
                    // Means over a revolution belong to the nominal motion, so figures are computed in the nominal
                    // motion.
                    // Published figures belong to the nominal motion too.
                    let solvers = EachSide::of(|side| entrants[side].solver);
                    own.figures = figures::claimed(own_formulas, &whole.nominal(), solvers)?;
                    own.judged(case, own_formulas)
                })?;
                own.checks.extend(formulas::checks(&judged));
                own.judgement = Some(judged);
            }
        }
        Ok(own)
    }

    /// Judges every claim of the formulas by the results of both sides. A claim is left out if the sides do not have
    /// the channels of the claim.
    ///
    /// # Errors
    /// The errors of [`check::judge`].
    pub(crate) fn judged(&self, case: &Case, formulas: &Formulas) -> Result<Judgement> {
        let sides = self.claimed(case, formulas)?;
        let (mut causes, mut undefined) = (Vec::new(), BTreeMap::new());
        let (mut unsought, mut work) = (BTreeSet::new(), 0);
        let is_wrong = |all: &&Vec<JudgedFormula>| {
            all.iter().any(|judged| judged.finding.is_none() && judged.outcome() == FormulaOutcome::Wrong)
        };
        for index in 0..sides[Reference::Assur].len() {
            // Selects the first side that the formula contradicts.
            let all = EachSide::of(|side| &sides[side][index]);
            let Some((side, wrong)) = all.iter().find(|(_, own)| is_wrong(own)) else { continue };
            let name = &wrong[0].name;
            let limit = check::MOST_WORK.min(MOST_WORK.saturating_sub(work));
            if wrong[0].without > 0 && limit > 0 {
                let (found, took) = self.on_course(case, side, |course| check::undefined(formulas, name, course))?;
                work += took;
                let is_lost = found.as_ref().is_some_and(|own| own.is_all);
                undefined.extend(found.map(|own| (name.clone(), own)));
                if is_lost {
                    causes.push((name.clone(), None));
                    continue;
                }
            }
            let found = self.on_course(case, side, |course| check::cause(formulas, name, course, limit))?;
            work += found.work;
            if found.is_cut {
                unsought.insert(name.clone());
            }
            causes.push((name.clone(), found.cause));
        }
        Ok(Judgement { causes, undefined, unsought, work, ..Judgement::of(sides) })
    }

    /// Compares every claim with the results of each side that has the channels of the claim. This function seeks no
    /// causes of wrong formulas.
    ///
    /// # Errors
    /// The errors of [`check::judge`].
    pub fn claimed(&self, case: &Case, formulas: &Formulas) -> Result<EachSide<Vec<Vec<JudgedFormula>>>> {
        EachSide::tried(|side| self.on_course(case, side, |course| check::judge(formulas, course)))
    }

    /// Calls `then` with the trajectory of the side `side` and the known errors of this trajectory.
    pub fn on_course<T>(
        &self,
        case: &Case,
        side: Reference,
        then: impl FnOnce(&KnownTrajectory) -> Result<T>,
    ) -> Result<T> {
        let trajectory = &self.observed[side].trajectory;
        let error = |column: usize, row: usize| {
            // A column index is valid for both sides, because both sides have the same channels in the same order.
            self.known.at(side, trajectory.channels()[column].kind.stage, column, row)
        };
        then(&KnownTrajectory::new(case, trajectory, &error).with_figures(&self.figures[side]))
    }

    /// Observations of the reference.
    pub(super) fn own(&self) -> &Observed {
        &self.observed[self.reference]
    }

    /// The reference's trajectory.
    pub fn trajectory(&self) -> &Trajectory {
        &self.own().trajectory
    }

    /// Integration error of the reference in every channel, in the channel's unit; zero in a prescribed motion.
    pub fn integration(&self) -> Vec<f64> {
        (0..self.trajectory().channels().len()).map(|channel| self.known.integration(self.reference, channel)).collect()
    }

    /// Bound on the error of the reference over the run in every channel, in the channel's unit.
    pub(super) fn bounds(&self) -> Vec<f64> {
        let channels = self.trajectory().channels().iter().enumerate();
        channels.map(|(index, channel)| self.known.error(channel.kind.stage, index)).collect()
    }

    /// The verdict on all checks.
    pub fn verdict(&self) -> Verdict {
        overall(self.checks.iter().map(|check| &check.verdict))
    }

    /// Every channel in which the two sides differ by more than allowed.
    pub fn beyond(&self) -> Vec<Beyond> {
        checks::beyond(self.observed.each_ref(), &self.known)
    }

    /// Proofs of the engines against the reference.
    ///
    /// # Errors
    /// If the case does not fit the instants, or the only engine cannot start.
    pub fn engines(
        &self,
        problem: Problem,
        how: &EngineRole,
        engines: Vec<Chosen>,
        ledger: &mut Ledger,
        progress: Progress,
    ) -> Result<Vec<EngineProof>> {
        let case = how.case.on(problem.case.grid.clone())?;
        let count = engines.len() as f64;
        let mut proofs = Vec::with_capacity(engines.len());
        for (index, chosen) in engines.into_iter().enumerate() {
            let chosen = chosen.with_engine(how.around);
            let chosen = if how.own_forces { chosen } else { chosen.by_motion_alone() };
            let mut part = |part: f64| progress(SIDES + (1.0 - SIDES) * (index as f64 + part) / count);
            let judge = Judge::new(problem, self.own(), &self.known, chosen.engine.settings());
            let mut proof = engines::prove(&judge, &case, &chosen, ledger, &mut part)?;
            proof.tell_sensitivity(self.trajectory(), &self.known.sensitivity);
            proofs.push(proof);
        }
        if let [EngineProof { failure: Some(error), trajectory: None, .. }] = proofs.as_slice() {
            return Err(error.clone());
        }
        Ok(proofs)
    }
}
