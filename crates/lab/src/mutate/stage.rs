//! One scenario with its correct parties, and proofs with a fault in one party.
//! A fault is planted in a solver or an engine: a hook changes the case or the answers.

use crate::sentences;
use std::sync::OnceLock;

use super::kinds::{FaultInstant, FaultKind, Plant};
use super::mutant::FaultyParty;
use super::seen::{Eyes, FaultyProof};
use analytic::{AssurSolver, NewtonSolver, TIGHT_ASSUR, TIGHT_NEWTON};
use linkage::case::Case;
use linkage::engine::{CachedEngine, Engine, Hook, Wrapped};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::solver::{Solver, State};
use linkage::trajectory::Trajectory;
use linkage::work::{Count, PLACED, counted, limited};
use prover::bounds::overall;
use prover::run::{
    BUDGET, EachSide, EngineProof, EngineRole, Entrant, Ledger, ObservedSides, Options, Problem, Reference, SIDES,
    TRUE_SIDES,
};
use scenario::Scenario;

/// Function that wraps an engine.
type Around<'a> = &'a dyn Fn(Box<dyn Engine>) -> Box<dyn Engine>;

/// A scenario's proof without a fault, and its reusable parts.
pub(super) struct Stage<'a> {
    pub(super) scenario: &'a Scenario,
    /// The part of the case on which the requested channels depend.
    pub(super) case: Case,
    options: &'a Options,
    /// The analytic sides without a fault.
    pub(super) sides: ObservedSides,
    /// Exact answers of analytic side 1, and the integration errors if forces determine the motion.
    /// The errors are given channel by channel, in the channels' units.
    pub(super) right: Trajectory,
    pub(super) integration: Vec<f64>,
    /// The engine's runs without a fault.
    runs: OnceLock<CachedEngine>,
    /// Work of both analytic sides, and of the engine, without a fault. The unit is the work of an engine's step on a
    /// four-bar.
    pub(super) work: [f64; 2],
    /// Verdict of the proof without a fault, and name of the engine.
    pub(super) verdict: &'static str,
    pub(super) engine: &'static str,
}

impl<'a> Stage<'a> {
    /// Proves the scenario without a fault.
    ///
    /// # Errors
    /// The errors of the proof.
    pub(super) fn new(scenario: &'a Scenario, options: &'a Options) -> Result<Self> {
        let (case, whole) = (scenario.case.scene()?.case, &scenario.case);
        let problem = Problem::of(scenario, &case);
        let allowed = options.budget.unwrap_or(BUDGET).larger(SIDES);
        let of_sides = || ObservedSides::of(problem, whole, TRUE_SIDES, options.reference, &mut Ledger::default());
        let (sides, done) = counted(|| limited(allowed, of_sides).0);
        let sides = sides?;
        // Side 2 places the same links as side 1 but counts no groups, so the groups of side 1 count twice.
        let placed = PLACED * 2.0 * done.of(Count::Groups) as f64 + done.of(Count::Intervals) as f64;
        let right = AssurSolver.solve(&case)?;
        let integration = sides.integration();
        let runs = OnceLock::new();
        let (work, verdict, engine) = ([placed, 0.0], "", "");
        let mut stage = Stage { scenario, case, options, sides, right, integration, runs, work, verdict, engine };
        let proof = stage.engine(&stage.sides, &|own| kept_in(&stage.runs, own), true)?;
        let own_forces = proof.own_forces.as_ref().and_then(|own| own.search.as_ref());
        stage.work[1] = proof.search.iter().chain(own_forces).map(|own| own.effort).sum();
        let verdict = stage.sides.verdict();
        (stage.verdict, stage.engine) = (overall([&verdict, &proof.verdict]).word(), proof.info.name);
        Ok(stage)
    }

    /// The proof of the engine with `sides` as reference.
    fn engine(&self, sides: &ObservedSides, around: Around, own_forces: bool) -> Result<EngineProof> {
        let how = EngineRole { case: &self.case, around, own_forces };
        let engines = self.options.chosen(&self.scenario.engine, &self.case)?;
        let problem = Problem::of(self.scenario, &self.case);
        let mut proofs = sides.engines(problem, &how, engines, &mut Ledger::default(), &mut |_| {})?;
        Ok(proofs.swap_remove(0))
    }

    /// The proof with a fault in one party.
    pub(super) fn proven(&self, fault: Fault, party: FaultyParty) -> FaultyProof {
        let outcome = match party {
            FaultyParty::Assur | FaultyParty::Newton => self.in_side(fault, party),
            FaultyParty::Engine => self.in_engine(fault),
            FaultyParty::All => self.in_all(fault),
            FaultyParty::Formulas => Ok(FaultyProof::Refused(sentences::MISTAKES_OF_FORMULAS_ARE_PLANTED.into())),
        };
        outcome.unwrap_or_else(|error| FaultyProof::Refused(error.message().into()))
    }

    fn in_side(&self, fault: Fault, party: FaultyParty) -> Result<FaultyProof> {
        let side = if party == FaultyParty::Newton { Reference::Newton } else { Reference::Assur };
        let sides = self.planted(fault, &[side])?;
        let eyes = Eyes::default().sides(&sides, false);
        if eyes.is_decided() {
            return Ok(eyes.outcome());
        }
        self.judged(&sides, &|own| kept_in(&self.runs, own))
    }

    fn in_engine(&self, fault: Fault) -> Result<FaultyProof> {
        let runs = OnceLock::new();
        let around = |own: Box<dyn Engine>| -> Box<dyn Engine> {
            match fault.kind.plant {
                Plant::Case(_) => kept_in(&runs, Box::new(Planted { hook: fault, inner: own })),
                // The engine's runs are correct, but its answer contains the fault.
                Plant::Answer(_) | Plant::Formula(_) => {
                    Box::new(Planted { hook: fault, inner: kept_in(&self.runs, own) })
                }
            }
        };
        self.judged(&self.sides, &around)
    }

    /// The engine's part of a proof in which the engine's answer contains a fault.
    #[cfg(test)]
    pub(super) fn engine_proof(&self, fault: Fault) -> Result<EngineProof> {
        self.engine(&self.sides, &|own| Box::new(Planted { hook: fault, inner: kept_in(&self.runs, own) }), false)
    }

    /// Outcome of the engine's proof with `sides` as reference.
    /// The engine's own forces (`own_forces`) are requested only if the proof without these forces does not find the
    /// fault.
    /// A verdict on these forces cannot undo a disagreement.
    fn judged(&self, sides: &ObservedSides, around: Around) -> Result<FaultyProof> {
        let mut last = FaultyProof::Escaped;
        for own_forces in [false, true] {
            let proof = self.engine(sides, around, own_forces)?;
            if let Some(error) = &proof.failure {
                return Ok(FaultyProof::Refused(error.message().into()));
            }
            last = Eyes::default().sides(sides, false).engine(&proof, sides.trajectory()).outcome();
            if last.is_found() {
                break;
            }
        }
        Ok(last)
    }

    /// The analytic sides, with a fault in each of the `faulty` sides.
    fn planted(&self, fault: Fault, faulty: &[Reference]) -> Result<ObservedSides> {
        let planted = |inner: Box<dyn Solver>| Planted { hook: fault, inner };
        let wrong = EachSide::new(
            [planted(Box::new(AssurSolver)), planted(Box::new(TIGHT_ASSUR))],
            [planted(Box::new(NewtonSolver)), planted(Box::new(TIGHT_NEWTON))],
        );
        let mut entrants = TRUE_SIDES;
        for &side in faulty {
            entrants[side] = Entrant { solver: &wrong[side][0], tight: &wrong[side][1] };
        }
        self.sides(&self.case, &self.scenario.case, entrants)
    }

    fn sides(&self, case: &Case, whole: &Case, entrants: EachSide<Entrant>) -> Result<ObservedSides> {
        let problem = Problem::of(self.scenario, case);
        ObservedSides::of(problem, whole, entrants, self.options.reference, &mut Ledger::default())
    }

    /// Whether a case differs from the correct case only in its instants.
    fn is_late(&self, case: &Case) -> bool {
        let right = &self.case;
        case.grid != right.grid && case.on(right.grid.clone()).is_ok_and(|own| own == *right)
    }

    /// The proof with a fault in the code that all parties share.
    /// With a fault in shared code, all parties agree. Only external reference values can contradict the wrong answers.
    fn in_all(&self, fault: Fault) -> Result<FaultyProof> {
        let case = match fault.kind.plant {
            Plant::Case(change) => match change(&self.case, fault.size) {
                None => return Ok(FaultyProof::Refused(sentences::THE_CASE_CANNOT_BE_PUT_TOGETHER.into())),
                // The fault is in the instants at which the analytic sides solve. The requested instants are correct.
                Some(case) if self.is_late(&case) => None,
                Some(case) => Some(case),
            },
            Plant::Answer(_) | Plant::Formula(_) => None,
        };
        let sides = match case {
            Some(case) => self.sides(&case, &case, TRUE_SIDES)?,
            None => self.planted(fault, &Reference::ALL)?,
        };
        Ok(Eyes::default().sides(&sides, true).outcome())
    }
}

/// The cached engine in `runs`, with the settings of `engine`. The first call creates it from `engine`.
fn kept_in(runs: &OnceLock<CachedEngine>, engine: Box<dyn Engine>) -> Box<dyn Engine> {
    runs.get_or_init(|| CachedEngine::new(engine.as_ref())).with(engine.settings())
}

/// A solver, or an engine, with a fault.
pub(super) type Planted<S> = Wrapped<Fault, S>;

/// A kind of fault with its size.
#[derive(Clone, Copy)]
pub(super) struct Fault {
    pub(super) kind: &'static FaultKind,
    pub(super) size: f64,
}

impl Hook for Fault {
    fn case(&self, case: &Case) -> Result<Option<Case>> {
        match self.kind.plant {
            Plant::Case(change) => {
                let message = || sentences::the_case_with_the_fault_cannot(&self.kind.name);
                change(case, self.size).map(Some).ok_or_else(|| Error::new(ErrorKind::Geometry, message()))
            }
            Plant::Answer(_) | Plant::Formula(_) => Ok(None),
        }
    }

    fn answer(&self, case: &Case, row: usize, state: &mut State) {
        match self.kind.plant {
            Plant::Case(_) | Plant::Formula(_) => {}
            Plant::Answer(change) => {
                // If the state has no part that the fault affects, the state stays unchanged.
                let _ = change(FaultInstant { case, row }, state, self.size);
            }
        }
    }
}
