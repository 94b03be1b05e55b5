//! Planted faults and their outcomes.

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
        /// All of them alike: the code they share is wrong.
        All = "trunk",
        /// The formulas that are judged.
        Formulas = "formulas",
    }
}

impl FaultyParty {
    /// Whether the party can have a fault of a kind.
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
    /// The formula, or its claim, as in the file.
    pub right: String,
    /// With the mistake.
    pub wrong: String,
}

/// One fault, planted in one party of one scenario's proof, and its outcome.
#[derive(Clone)]
pub struct Mutant {
    /// The kind of fault.
    pub kind: &'static FaultKind,
    /// Where it is planted.
    pub party: FaultyParty,
    /// For a mistake in a formula: the formula, and its text.
    pub formula: Option<Spoiled>,
    /// What came of it.
    pub outcome: FaultyProof,
    /// Largest change of exact answers, relative to the largest number of a quantity; `None` without an exact answer.
    pub effect: Option<f64>,
    /// For a detected fault with a size: the smallest size still found, to a factor of two.
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
    /// Number of formulas in which mistakes are planted, including steps of derivations.
    pub formulas: usize,
    /// Kinds for which the scenario has no part.
    pub without: Vec<&'static str>,
    /// If no planted fault changes anything: the families whose kinds would change something in this scenario.
    pub instead: Vec<&'static str>,
}
