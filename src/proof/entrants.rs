//! Who takes part in a proof, and the two halves of a proof: the analytic sides, and the engines against one of them.

use std::collections::{BTreeMap, BTreeSet};

use super::checks::{self, Beyond};
use super::engines::{self, EngineProof};
use super::formulas::Judgement;
use super::known::Known;
use super::ledger::Ledger;
use super::observe::{Observed, Watch, observe};
use super::options::{Chosen, Reference};
use super::{figures, formulas, methods, oracle, sensitivity};
use crate::claims::{self, Course, Judged, Outcome};
use crate::compare::{Check, Verdict, overall};
use crate::scenario::{Figure, Formulas, Scenario};
use analytic::{AssurSolver, NewtonSolver, TIGHT_ASSUR, TIGHT_NEWTON};
use formula::Rounded;
use linkage::case::Case;
use linkage::engine::Engine;
use linkage::error::Result;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};

/// What a side, by its name, says of the claims of every formula.
pub(crate) type SideClaims = (&'static str, Vec<Vec<Judged>>);

/// Share of the progress that the analytic sides are given.
const SIDES: f64 = 0.1;

/// Most operations of the search for the causes of all wrong formulas of a file.
const MOST_WORK: u64 = 100_000_000;

/// An analytic side: its solver, and the same with a tighter tolerance where it integrates.
#[derive(Clone, Copy)]
pub(crate) struct Entrant<'a> {
    /// The side. It has the name of one of [`analytic::all`].
    pub(crate) solver: &'a dyn Solver,
    /// The side with a tighter tolerance.
    pub(crate) tight: &'a dyn Solver,
}

/// Side 1 and side 2 as they are.
pub(crate) const TRUE_SIDES: [Entrant<'static>; 2] =
    [Entrant { solver: &AssurSolver, tight: &TIGHT_ASSUR }, Entrant { solver: &NewtonSolver, tight: &TIGHT_NEWTON }];

/// How engines take part.
pub(crate) struct Engines<'a> {
    /// What they solve, on the scenario's instants.
    pub(crate) case: &'a Case,
    /// Puts something around each of them.
    pub(crate) around: &'a dyn Fn(Box<dyn Engine>) -> Box<dyn Engine>,
    /// Whether the forces that they exert are judged besides.
    pub(crate) own_forces: bool,
}

impl<'a> Engines<'a> {
    /// Engines as they are, on a case.
    pub(crate) fn on(case: &'a Case) -> Self {
        Engines { case, around: &|engine| engine, own_forces: true }
    }
}

/// The two analytic sides of a proof, observed and checked.
pub(crate) struct Sides {
    /// The reference first.
    order: [usize; 2],
    /// Side 1 and side 2 with their names.
    pub(super) observed: [(&'static str, Observed); 2],
    pub(super) known: Known,
    /// How strongly a motion under forces depends on them, by channel of the reference.
    pub(super) sensitivity: Vec<f64>,
    /// Checks on both, published numbers among them.
    pub(crate) checks: Vec<Check>,
    /// Figures that formulas claim, by side 1 and side 2.
    figures: [Vec<(Figure, Rounded)>; 2],
    /// What formulas come to, if any claims something.
    pub(super) judgement: Option<Judgement>,
}

impl Sides {
    /// Both sides on the scene of a scenario, the side called `reference` being the reference. The first scenario has
    /// the scene as its case, the second the whole.
    ///
    /// # Errors
    /// Those of the sides.
    pub(crate) fn of(
        [scenario, whole]: [&Scenario; 2],
        entrants: [Entrant; 2],
        reference: Reference,
        ledger: &mut Ledger,
    ) -> Result<Self> {
        let case = &scenario.case;
        let mut observed = |solver: &dyn Solver| -> Result<_> {
            let why = if solver.name() == reference.name() { "the reference" } else { "checks the reference" };
            let run = || observe(case, solver, Watch::Side, &mut |_| {});
            Ok((solver.name(), ledger.done(solver.name(), why, run)?))
        };
        let [first, second] = entrants;
        let sides = [observed(first.solver)?, observed(second.solver)?];
        let order = if sides[0].0 == reference.name() { [0, 1] } else { [1, 0] };
        let main = entrants[order[0]].solver;
        let [own, beside] = order.map(|side| &sides[side].1.trajectory);
        let tight = order.map(|side| entrants[side].tight);
        let tighter = || -> Result<_> {
            let sensitivity = sensitivity::of(case, main, own)?;
            let known = Known::beside(case, [(tight[0], own), (tight[1], beside)], &sensitivity)?;
            Ok((sensitivity, known))
        };
        let (sensitivity, mut known) = match case.is_free() {
            true => ledger.done("tighter integration", "shows the error that both sides share", tighter)?,
            false => {
                ledger.skipped("integration", "the motion is prescribed");
                tighter()?
            }
        };
        match checks::sides_differ([0, 1].map(|side| &sides[side].1.trajectory), &known) {
            true => ledger.done("condition of every pose", "the sides differ by more than usual", || {
                known.measure(case, first.solver)
            })?,
            false => ledger.skipped("condition of every pose", "the sides differ by usual rounding"),
        }
        let mut checks = checks::of_sides(case, &sides, &known);
        match methods::apply(case) {
            true => checks.extend(
                ledger.done("published methods", "others than ours for its triad", || methods::checks(case, main))?,
            ),
            false => ledger.skipped("published methods", "there is no triad of class III"),
        }
        match scenario.oracles.is_empty() {
            true => ledger.skipped("published numbers", "there are none of wanted channels"),
            false => {
                let channels = sides[order[0]].1.trajectory.channels();
                let integration = |side: usize, channel: &Channel| {
                    let of = |index| known.integration(if order[0] == side { 0 } else { 1 }, index);
                    channels.iter().position(|own| own == channel).map_or(0.0, of)
                };
                let solvers = entrants.map(|entrant| entrant.solver);
                let numbers = || oracle::checks(scenario, whole, solvers, &integration);
                checks.extend(ledger.done("published numbers", "solved at their own instants", numbers)?);
            }
        }
        let mut own =
            Sides { order, observed: sides, known, sensitivity, checks, figures: Default::default(), judgement: None };
        match scenario.formulas.claims().next() {
            None => ledger.skipped("formulas", "none claims a wanted channel"),
            Some(_) => {
                let judged = ledger.done("formulas", "by value and by derivative, on both sides", || {
                    // As with published figures: means over a turn belong to the nominal motion.
                    let (nominal, solvers) = (whole.clone().nominal(), entrants.map(|entrant| entrant.solver));
                    own.figures = figures::claimed(&scenario.formulas, &nominal, solvers)?;
                    own.judged(case, &scenario.formulas)
                })?;
                own.checks.extend(formulas::checks(&judged));
                own.judgement = Some(judged);
            }
        }
        Ok(own)
    }

    /// Formulas against both sides, every claim that they have the channels for.
    ///
    /// # Errors
    /// Those of [`claims::judge`].
    pub(crate) fn judged(&self, case: &Case, formulas: &Formulas) -> Result<Judgement> {
        let sides = self.claimed(case, formulas)?;
        let (mut causes, mut undefined) = (Vec::new(), BTreeMap::new());
        let (mut unsought, mut work) = (BTreeSet::new(), 0);
        let is_wrong = |all: &&Vec<Judged>| all.iter().any(|judged| judged.outcome() == Outcome::Wrong);
        for (own, other) in sides[0].1.iter().zip(&sides[1].1) {
            // The side that it contradicts, or both: the first of them.
            let all = [own, other];
            let Some(side) = all.iter().position(is_wrong) else { continue };
            let name = &all[side][0].name;
            let limit = claims::MOST_WORK.min(MOST_WORK.saturating_sub(work));
            if all[side][0].without > 0 && limit > 0 {
                let (found, took) = self.on_course(case, side, |course| claims::undefined(formulas, name, course))?;
                work += took;
                let is_lost = found.as_ref().is_some_and(|own| own.is_all);
                undefined.extend(found.map(|own| (name.clone(), own)));
                if is_lost {
                    causes.push((name.clone(), None));
                    continue;
                }
            }
            let found = self.on_course(case, side, |course| claims::cause(formulas, name, course, limit))?;
            work += found.work;
            if found.is_cut {
                unsought.insert(name.clone());
            }
            causes.push((name.clone(), found.cause));
        }
        Ok(Judgement { causes, undefined, unsought, work, ..Judgement::of(sides) })
    }

    /// What both sides say of every claim that they have the channels for; why one is wrong is not sought.
    ///
    /// # Errors
    /// Those of [`claims::judge`].
    pub(crate) fn claimed(&self, case: &Case, formulas: &Formulas) -> Result<[SideClaims; 2]> {
        let of = |side: usize| -> Result<_> {
            Ok((self.observed[side].0, self.on_course(case, side, |course| claims::judge(formulas, course))?))
        };
        Ok([of(0)?, of(1)?])
    }

    /// What one side found on a case, with how well it knows it.
    pub(crate) fn on_course<T>(&self, case: &Case, side: usize, then: impl FnOnce(&Course) -> Result<T>) -> Result<T> {
        let place = usize::from(self.order[0] != side);
        let trajectory = &self.observed[side].1.trajectory;
        let error = |column: usize, row: usize| {
            // Both sides have the same channels in the same order.
            self.known.at(place, trajectory.channels()[column].kind.stage, column, row)
        };
        then(&Course::new(case, trajectory, &error).with_figures(&self.figures[side]))
    }

    /// What formulas come to, if any claims something.
    pub(crate) fn judgement(&self) -> Option<&Judgement> {
        self.judgement.as_ref()
    }

    /// What was observed of the reference.
    pub(super) fn own(&self) -> &Observed {
        &self.observed[self.order[0]].1
    }

    /// The reference's trajectory.
    pub(crate) fn trajectory(&self) -> &Trajectory {
        &self.own().trajectory
    }

    /// Error of the reference's integration, channel by channel, in their units; zeros in a prescribed motion.
    pub(crate) fn integration(&self) -> Vec<f64> {
        (0..self.trajectory().channels().len()).map(|channel| self.known.integration(0, channel)).collect()
    }

    /// Largest error allowed to the reference over the run, channel by channel, in their units.
    pub(super) fn bounds(&self) -> Vec<f64> {
        let channels = self.trajectory().channels().iter().enumerate();
        channels.map(|(index, channel)| self.known.error(channel.kind.stage, index)).collect()
    }

    /// The verdict on all checks.
    pub(crate) fn verdict(&self) -> Verdict {
        overall(self.checks.iter().map(|check| &check.verdict))
    }

    /// Every channel in which the two sides differ by more than is allowed.
    pub(crate) fn beyond(&self) -> Vec<Beyond> {
        checks::beyond(&self.observed, &self.known)
    }

    /// Proofs of the engines against the reference.
    ///
    /// # Errors
    /// Those of a case that does not fit the instants, and of an only engine that cannot start.
    pub(crate) fn engines(
        &self,
        scenario: &Scenario,
        how: &Engines,
        engines: Vec<Chosen>,
        (ledger, progress): (&mut Ledger, &mut dyn FnMut(f64)),
    ) -> Result<Vec<EngineProof>> {
        let case = how.case.on(scenario.case.grid.clone())?;
        let count = engines.len() as f64;
        let mut proofs = Vec::with_capacity(engines.len());
        for (index, chosen) in engines.into_iter().enumerate() {
            let chosen = chosen.with_engine(how.around);
            let chosen = if how.own_forces { chosen } else { chosen.by_motion_alone() };
            let mut part = |part: f64| progress(SIDES + (1.0 - SIDES) * (index as f64 + part) / count);
            let told = (&mut *ledger, &mut part as &mut dyn FnMut(f64));
            let mut proof = engines::prove(scenario, &case, &chosen, self.own(), &self.known, told)?;
            engines::tell_sensitivity(&mut proof, self.trajectory(), &self.sensitivity);
            proofs.push(proof);
        }
        if let [EngineProof { failure: Some(error), trajectory: None, .. }] = proofs.as_slice() {
            return Err(error.clone());
        }
        Ok(proofs)
    }
}
