//! Planted faults and their outcomes.

use super::kinds::{FaultKind, Plant};
use super::seen::FaultyProof;
use linkage::input::Input;

linkage::words! {
    /// Who gets a fault.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum FaultyParty: name {
        /// Analytic side 1.
        Assur = "assur",
        /// Analytic side 2.
        Newton = "newton",
        /// The engine.
        Engine = "engine",
        /// The code that all parties share.
        All = "trunk",
        /// The judged formulas.
        Formulas = "formulas",
    }
}

impl FaultyParty {
    /// Whether the party can have a fault of a kind.
    pub fn takes(self, kind: &FaultKind) -> bool {
        matches!(kind.plant, Plant::Formula(_)) == (self == FaultyParty::Formulas)
    }
}

/// A mistake in one formula of a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spoiled {
    /// Name of the formula.
    pub formula: String,
    /// The correct formula or claim, as in the file.
    pub right: String,
    /// The formula or claim with the mistake.
    pub wrong: String,
}

/// A fault planted in one party of a scenario's proof, and its outcome.
#[derive(Clone)]
pub struct Mutant {
    /// The kind of fault.
    pub kind: &'static FaultKind,
    /// The party in which the fault is planted.
    pub party: FaultyParty,
    /// The formula and its text, if the fault is a mistake in a formula.
    pub formula: Option<Spoiled>,
    /// Outcome of the proof with the fault.
    pub outcome: FaultyProof,
    /// Largest change of the exact answers by the fault, relative to the largest number of the changed quantity. `None`
    /// if there is no exact answer.
    pub effect: Option<f64>,
    /// Smallest size at which the fault is still found, to a factor of two.
    /// `None` if the fault has no size, if it is not detected, or if no search was requested.
    pub smallest: Option<f64>,
}

/// All faults planted in one scenario.
#[derive(Clone)]
pub struct Mutated {
    /// Name of the scenario.
    pub scenario: String,
    /// Kind of the scenario's input: a crank angle, a joint angle or a slide.
    pub input: Input,
    /// Verdict of the scenario's proof without a fault.
    pub verdict: &'static str,
    /// Name of the engine.
    pub engine: &'static str,
    /// The faults, kind by kind.
    pub mutants: Vec<Mutant>,
    /// Number of formulas with planted mistakes, including steps of derivations.
    pub formulas: usize,
    /// Kinds that affect no part of the scenario.
    pub without: Vec<&'static str>,
    /// If no planted fault has an effect: the families with kinds that would have an effect in this scenario.
    pub instead: Vec<&'static str>,
}
