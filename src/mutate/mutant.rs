//! Planted faults and what came of them.

use super::kinds::Kind;
use super::seen::Outcome;

/// Who gets a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Party {
    /// Side 1.
    Assur,
    /// Side 2.
    Newton,
    /// The engine.
    Engine,
    /// All of them alike: what they share is wrong.
    All,
}

impl Party {
    /// All parties.
    pub const ALL: [Party; 4] = [Party::Assur, Party::Newton, Party::Engine, Party::All];

    /// Name, as on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Party::Assur => "assur",
            Party::Newton => "newton",
            Party::Engine => "engine",
            Party::All => "trunk",
        }
    }
}

/// One fault, planted in one party of one scenario's proof, and what came of it.
#[derive(Clone)]
pub struct Mutant {
    /// The kind of fault.
    pub kind: &'static Kind,
    /// Where it is planted.
    pub party: Party,
    /// What came of it.
    pub outcome: Outcome,
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
    /// Kinds that the scenario has no part for.
    pub without: Vec<&'static str>,
    /// Where no fault was planted that changes anything: the families of kinds that the scenario has parts for.
    pub instead: Vec<&'static str>,
}
