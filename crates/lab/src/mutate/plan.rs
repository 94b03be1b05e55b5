//! Chooses faults and parties, and plants every chosen fault in every chosen party.
//! The parties are the two analytic sides, the engine, the code shared by sides and engine, and the formulas.
//! If a fault has a size, a search determines the smallest size at which a proof still detects the fault.

use super::effect::Effect;
use super::formulas;
use super::kinds::{self, FaultFamily, FaultKind, Mistake, Plant};
use super::mutant::{FaultyParty, Mutant, Mutated};
use super::seen::FaultyProof;
use super::stage::Fault;
use super::stage::Stage;
use crate::sentences;
use linkage::error::{Advice, Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::solver::Progress;
use linkage::threads::{cores, made};
use prover::run::{BUDGET, Options};
use scenario::Scenario;

/// The requested faults and parties, and the options of their proofs.
#[derive(Clone, Debug, Default)]
pub struct MutationPlan {
    /// Names of kinds or families; all if empty.
    pub kinds: Vec<String>,
    /// Parties; all if empty.
    pub parties: Vec<FaultyParty>,
    /// Whether to search the smallest size at which a fault is found.
    pub with_sizes: bool,
    /// Number of threads; zero means the number of cores.
    pub jobs: usize,
    /// Options of the proofs.
    pub options: Options,
}

impl MutationPlan {
    fn kinds(&self) -> Vec<&'static FaultKind> {
        let is_asked = |kind: &&FaultKind| {
            self.kinds.is_empty() || self.kinds.iter().any(|own| own == kind.name || own == kind.family.name())
        };
        let takes = |kind: &&FaultKind| self.parties().iter().any(|party| party.takes(kind));
        kinds::all().filter(is_asked).filter(takes).collect()
    }

    fn parties(&self) -> Vec<FaultyParty> {
        if self.parties.is_empty() { FaultyParty::ALL.to_vec() } else { self.parties.clone() }
    }
}

/// Plants all requested faults in a scenario. The result does not depend on the number of threads.
///
/// # Errors
/// The errors of the proof without a fault; [`ErrorKind::Input`] if that proof disagrees;
/// [`ErrorKind::Unsupported`] if the allowed work is not enough.
pub fn mutate(scenario: &Scenario, asked: &MutationPlan, progress: Progress) -> Result<Mutated> {
    let stage = Stage::new(scenario, &asked.options)?;
    if stage.verdict == "disagree" {
        let help = sentences::PROVE_IT_WITHOUT_A_FAULT;
        return Err(Error::new(ErrorKind::Input, sentences::disagrees_without_a_fault_so(&scenario.name)).help(help));
    }
    let kinds = asked.kinds();
    allowed(&stage, &kinds, asked)?;
    let threads = if asked.jobs == 0 { cores() } else { asked.jobs };
    let done = |count: usize| progress(count as f64 / kinds.len() as f64);
    let found = made(&kinds, threads, |kind| of_kind(&stage, kind, asked), done);
    let (mut mutants, mut without) = (Vec::new(), Vec::new());
    for (kind, planting) in kinds.iter().zip(found) {
        let planted = planting?;
        if planted.is_empty() {
            without.push(kind.name);
        }
        mutants.extend(planted);
    }
    let is_real = |mutant: &Mutant| !matches!(mutant.outcome, FaultyProof::Equivalent(_));
    let instead = if mutants.iter().any(is_real) { Vec::new() } else { families(&stage)? };
    let formulas = stage.formulas().len();
    let Stage { verdict, engine, .. } = stage;
    let (name, input) = (scenario.name.clone(), scenario.case.crank().input);
    Ok(Mutated { scenario: name, input, verdict, engine, mutants, formulas, without, instead })
}

/// Work allowed for all faults of a file, divided by the work allowed for one proof.
/// Shipped mechanisms need less than five times the work allowed for one proof.
const PROOFS: f64 = 10.0;
/// Number of proofs needed to find the smallest size at which a fault is found.
const SIZES: f64 = 8.0;

/// Checks that the allowed work is enough for all requested faults.
///
/// # Errors
/// [`ErrorKind::Unsupported`] if the allowed work is not enough; the message contains the work needed.
fn allowed(stage: &Stage, kinds: &[&'static FaultKind], asked: &MutationPlan) -> Result<()> {
    let [sides, engine] = stage.work;
    let formulas = stage.formulas().len() as f64 * stage.work_of_formulas();
    let (mut faults, mut work) = (0usize, 0.0);
    for kind in kinds {
        for party in asked.parties().into_iter().filter(|party| party.takes(kind)) {
            let once = match party {
                FaultyParty::Assur | FaultyParty::Newton | FaultyParty::All => sides,
                FaultyParty::Engine => engine,
                FaultyParty::Formulas => formulas,
            };
            let is_sized = asked.with_sizes && kind.size.is_some() && party != FaultyParty::All;
            faults += if party == FaultyParty::Formulas { stage.formulas().len() } else { 1 };
            work += once * if is_sized { 1.0 + SIZES } else { 1.0 };
        }
    }
    let budget = asked.options.budget.unwrap_or(BUDGET);
    if work <= PROOFS * budget {
        return Ok(());
    }
    let message = sentences::planting_faults_takes_the_work(
        &stage.scenario.name,
        &faults,
        &format_args!("{work:.1e}"),
        &format_args!("{:.1e}", PROOFS * budget),
    );
    let help = sentences::PLANT_FEWER_OF_THEM_SOME;
    Err(Error::new(ErrorKind::Unsupported, message).help(help).or_help(Advice::MoreWork { to: work / PROOFS }))
}

/// Names of the families in which at least one kind changes something in a scenario.
fn families(stage: &Stage) -> Result<Vec<&'static str>> {
    let mut names = Vec::new();
    for family in FaultFamily::ALL {
        for kind in kinds::all().filter(|kind| kind.family == family) {
            let changes = match kind.plant {
                Plant::Formula(mistake) => !spoiled(stage, kind, mistake, true)?.is_empty(),
                Plant::Case(_) | Plant::Answer(_) => matches!(stage.effect(fault(kind))?, Effect::Changes(_)),
            };
            if changes {
                names.push(family.name());
                break;
            }
        }
    }
    Ok(names)
}

/// A fault of this kind at its initial size.
fn fault(kind: &'static FaultKind) -> Fault {
    Fault { kind, size: kind.size.unwrap_or(1.0) }
}

/// Every formula in which `mistake` can be planted: number of the formula, planted mistake and effect.
/// If `only_real` is true, only the first mistake with an effect is returned.
fn spoiled(
    stage: &Stage,
    kind: &'static FaultKind,
    mistake: Mistake,
    only_real: bool,
) -> Result<Vec<(usize, formulas::Planting, Effect)>> {
    let mut all = Vec::new();
    for index in stage.formulas() {
        let Some(own) = stage.planting(kind, mistake, index, fault(kind).size) else { continue };
        let effect = stage.formula_effect(&own)?;
        let is_real = !matches!(effect, Effect::Equivalent(_) | Effect::None);
        if is_real || !only_real {
            all.push((index, own, effect));
        }
        if is_real && only_real {
            break;
        }
    }
    Ok(all)
}

fn in_formulas(stage: &Stage, kind: &'static FaultKind, mistake: Mistake, asked: &MutationPlan) -> Result<Vec<Mutant>> {
    let found = |index: usize, size: f64| {
        stage.planting(kind, mistake, index, size).is_some_and(|own| stage.formula_outcome(&own).is_found())
    };
    let mut mutants = Vec::new();
    for (index, own, effect) in spoiled(stage, kind, mistake, false)? {
        let (outcome, effect) = match effect {
            Effect::Equivalent(change) => (FaultyProof::Equivalent(change), Some(change)),
            Effect::Changes(change) => (stage.formula_outcome(&own), Some(change)),
            Effect::None | Effect::Unsolved => (stage.formula_outcome(&own), None),
        };
        let sized = kind.size.filter(|_| asked.with_sizes).zip(outcome.margin());
        let smallest = sized.map(|(size, margin)| smallest(size, margin, &|size| found(index, size)));
        mutants.push(Mutant { kind, party: FaultyParty::Formulas, formula: Some(own.what), outcome, effect, smallest });
    }
    Ok(mutants)
}

/// The outcomes of one kind; empty if the kind affects no part of the scenario.
fn of_kind(stage: &Stage, kind: &'static FaultKind, asked: &MutationPlan) -> Result<Vec<Mutant>> {
    if let Plant::Formula(mistake) = kind.plant {
        return in_formulas(stage, kind, mistake, asked);
    }
    let fault = fault(kind);
    let effect = stage.effect(fault)?;
    let change = match effect {
        Effect::None => return Ok(Vec::new()),
        Effect::Unsolved => None,
        Effect::Equivalent(change) | Effect::Changes(change) => Some(change),
    };
    let parties = asked.parties().into_iter().filter(|party| party.takes(kind));
    let one = |party: FaultyParty| {
        let outcome = match effect {
            Effect::Equivalent(change) => FaultyProof::Equivalent(change),
            Effect::None | Effect::Unsolved | Effect::Changes(_) => stage.proven(fault, party),
        };
        let sized = asked.with_sizes && kind.size.is_some() && party != FaultyParty::All;
        let is_found = |size: f64| stage.proven(Fault { size, ..fault }, party).is_found();
        let smallest = outcome.margin().filter(|_| sized).map(|margin| smallest(fault.size, margin, &is_found));
        Mutant { kind, party, formula: None, outcome, effect: change, smallest }
    };
    Ok(parties.map(one).collect())
}

/// Smallest size that is tried, divided by the first size. Effects of smaller faults are below rounding error.
const LEAST: f64 = 1e-16;
/// Largest factor between successive sizes of the search.
/// If the margin of the fault at its first size is unknown, the first guess is the first size divided by this factor.
const STEP: f64 = 10.0;
/// The search ends if the smallest detected size is at most this multiple of the largest undetected size.
const FACTOR: f64 = 2.0;
/// Upper limit of the number of proofs in one search.
const MOST: usize = 24;

/// The smallest size for which `is_found` returns true, to a factor of two.
/// At the size `whole`, the largest difference is `margin` times its bound.
pub(super) fn smallest(whole: f64, margin: f64, is_found: &dyn Fn(f64) -> bool) -> f64 {
    let mut left = MOST;
    let mut is_found = |size: f64| {
        left = left.saturating_sub(1);
        left > 0 && is_found(size)
    };
    // Most effects are proportional to the size, so the margin predicts the size below which the fault is not found.
    let guess = if margin.is_finite() && margin > 1.0 { whole / margin } else { whole / STEP };
    let mut found = whole;
    let mut lost = None;
    let mut size = (guess * FACTOR).smaller(whole / FACTOR);
    while lost.is_none() && size > LEAST * whole {
        if is_found(size) {
            found = size;
            size /= if size <= guess * FACTOR { FACTOR * FACTOR } else { STEP };
        } else {
            lost = Some(size);
        }
    }
    let Some(mut lost) = lost else { return found };
    // If the first guess was too small, the search increases the size in steps. The search then bisects the interval
    // between the last undetected size and the first detected size.
    while found > STEP * lost {
        let size = lost * STEP;
        if is_found(size) {
            found = size;
        } else {
            lost = size;
        }
    }
    while found > FACTOR * lost {
        let middle = (found * lost).sqrt();
        if is_found(middle) {
            found = middle;
        } else {
            lost = middle;
        }
    }
    found
}
