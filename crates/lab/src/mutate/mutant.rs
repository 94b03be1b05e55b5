//! Planted faults and what came of them.

use super::kinds::{FaultKind, Plant};
use super::seen::FaultyProof;

linkage::words! {
    /// Who gets a fault.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum FaultyParty: name {
        /// Side 1.
        Assur = "assur",
        /// Side 2.
        Newton = "newton",
        /// The engine.
        Engine = "engine",
        /// All of them alike: what they share is wrong.
        All = "trunk",
        /// The formulas that are judged.
        Formulas = "formulas",
    }
}

impl FaultyParty {
    /// Whether it can have a fault of a kind.
    #[must_use]
    pub fn takes(self, kind: &FaultKind) -> bool {
        matches!(kind.plant, Plant::Formula(_)) == (self == FaultyParty::Formulas)
    }
}

/// A mistake in one formula of a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spoiled {
    /// Name of the formula.
    pub formula: String,
    /// The formula, or what it claims, as it is in the file.
    pub right: String,
    /// With the mistake.
    pub wrong: String,
}

/// One fault, planted in one party of one scenario's proof, and what came of it.
#[derive(Clone)]
pub struct Mutant {
    /// The kind of fault.
    pub kind: &'static FaultKind,
    /// Where it is planted.
    pub party: FaultyParty,
    /// Of a mistake in a formula: which one, and how it reads.
    pub formula: Option<Spoiled>,
    /// What came of it.
    pub outcome: FaultyProof,
    /// Largest change of exact answers, relative to the largest number of a quantity; `None` where there is no answer.
    pub effect: Option<f64>,
    /// Of a fault with a size that is found: the smallest size still found, to a factor of two.
    pub smallest: Option<f64>,
}

/// All faults planted in one scenario.
#[derive(Clone)]
pub struct Mutated {
    /// Name of the scenario.
    pub scenario: String,
    /// Verdict of its proof without a fault.
    pub verdict: &'static str,
    /// The engine.
    pub engine: &'static str,
    /// The faults, kind by kind.
    pub mutants: Vec<Mutant>,
    /// Number of formulas that mistakes are planted in, steps of derivations among them.
    pub formulas: usize,
    /// Kinds that the scenario has no part for.
    pub without: Vec<&'static str>,
    /// Where no fault was planted that changes anything: the families of kinds that the scenario has parts for.
    pub instead: Vec<&'static str>,
}
