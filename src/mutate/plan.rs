//! Which faults are planted where, and all of them at once.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

use super::effect::Effect;
use super::kinds::{self, Family, Kind};
use super::lost::smallest;
use super::mutant::{Mutant, Mutated, Party};
use super::planted::Fault;
use super::seen::Outcome;
use super::stage::Stage;
use crate::proof::Options;
use crate::scenario::Scenario;
use linkage::error::{Error, ErrorKind, Result};

/// What is asked for.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    /// Names of kinds or families; all if empty.
    pub kinds: Vec<String>,
    /// Parties; all if empty.
    pub parties: Vec<Party>,
    /// Whether the size is searched at which a fault is lost.
    pub with_sizes: bool,
    /// Number of threads; as many as there are cores if zero.
    pub jobs: usize,
    /// Options of the proofs.
    pub options: Options,
}

impl Asked {
    fn kinds(&self) -> Vec<&'static Kind> {
        let is_asked = |kind: &&Kind| {
            self.kinds.is_empty() || self.kinds.iter().any(|own| own == kind.name || own == kind.family.name())
        };
        kinds::all().filter(is_asked).collect()
    }
}

/// Plants all faults that are asked for in a scenario. The result does not depend on the number of threads.
///
/// # Errors
/// Those of the proof without a fault; [`ErrorKind::Input`] if it disagrees.
pub fn mutate(scenario: &Scenario, asked: &Asked, progress: &mut dyn FnMut(f64)) -> Result<Mutated> {
    let stage = Stage::new(scenario, &asked.options)?;
    if stage.verdict == "disagree" {
        let message = format!("{} disagrees without a fault, so that every fault would count as found", scenario.name);
        let help = "prove it without a fault, and mend what disagrees";
        return Err(Error::new(ErrorKind::Input, message).help(help));
    }
    let kinds = asked.kinds();
    let next = AtomicUsize::new(0);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = if asked.jobs == 0 { cores } else { asked.jobs };
    let (tell, told) = mpsc::channel();
    let mut found: Vec<Option<Result<Planting>>> = kinds.iter().map(|_| None).collect();
    std::thread::scope(|scope| {
        for _ in 0..threads.min(kinds.len()) {
            let (tell, next, kinds, stage) = (tell.clone(), &next, &kinds, &stage);
            scope.spawn(move || {
                while let Some(kind) = kinds.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let _ = tell.send((kind.name, of_kind(stage, kind, asked)));
                }
            });
        }
        drop(tell);
        for (count, (name, planting)) in told.into_iter().enumerate() {
            let index = kinds.iter().position(|kind| kind.name == name).expect("the kind is one of these");
            found[index] = Some(planting);
            progress((count + 1) as f64 / kinds.len() as f64);
        }
    });
    let (mut mutants, mut without) = (Vec::new(), Vec::new());
    for (kind, planting) in kinds.iter().zip(found) {
        match planting.expect("every kind was planted")? {
            Planting::Nowhere => without.push(kind.name),
            Planting::Done(own) => mutants.extend(own),
        }
    }
    let is_real = |mutant: &Mutant| !matches!(mutant.outcome, Outcome::Equivalent(_));
    let instead = if mutants.iter().any(is_real) { Vec::new() } else { families(&stage)? };
    let Stage { verdict, engine, .. } = stage;
    Ok(Mutated { scenario: scenario.name.clone(), verdict, engine, mutants, without, instead })
}

/// Names of the families of which a kind changes something in a scenario.
fn families(stage: &Stage) -> Result<Vec<&'static str>> {
    let mut names = Vec::new();
    for family in Family::ALL {
        for kind in kinds::all().filter(|kind| kind.family == family) {
            if matches!(stage.effect(fault(kind))?, Effect::Changes(_)) {
                names.push(family.name());
                break;
            }
        }
    }
    Ok(names)
}

/// A kind at the size that is tried first.
fn fault(kind: &'static Kind) -> Fault {
    Fault { kind, size: kind.size.unwrap_or(1.0) }
}

/// What came of one kind.
enum Planting {
    Nowhere,
    Done(Vec<Mutant>),
}

fn of_kind(stage: &Stage, kind: &'static Kind, asked: &Asked) -> Result<Planting> {
    let fault = fault(kind);
    let effect = stage.effect(fault)?;
    let change = match effect {
        Effect::None => return Ok(Planting::Nowhere),
        Effect::Unsolved => None,
        Effect::Equivalent(change) | Effect::Changes(change) => Some(change),
    };
    let parties = if asked.parties.is_empty() { Party::ALL.to_vec() } else { asked.parties.clone() };
    let one = |party: Party| {
        let outcome = match effect {
            Effect::Equivalent(change) => Outcome::Equivalent(change),
            Effect::None | Effect::Unsolved | Effect::Changes(_) => stage.proven(fault, party),
        };
        let sized = asked.with_sizes && kind.size.is_some() && party != Party::All;
        let smallest = outcome.margin().filter(|_| sized).map(|margin| smallest(stage, fault, party, margin));
        Mutant { kind, party, outcome, effect: change, smallest }
    };
    Ok(Planting::Done(parties.into_iter().map(one).collect()))
}
