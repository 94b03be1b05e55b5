//! Does the cross-check see faults? Single faults, planted in one party of a proof at default settings, or in what all
//! parties share.
//!
//! A third join: a fault stands around a solver or an engine, and the proof is the same as that of a user.
//! A fault in an analytic side that the other side contradicts needs no engine for its verdict. Other proofs with the
//! engine unchanged take its runs from the first of them; their verdicts are those of new runs, because an engine's
//! runs do not depend on what they are compared with.

mod effect;
mod kinds;
mod lost;
mod plan;
mod planted;
mod seen;
mod stage;
mod tally;
#[cfg(test)]
mod tests;

pub use kinds::{Family, Kind, Plant, all};
pub use plan::{Asked, Party, mutate};
pub use seen::{Outcome, Sight};
pub use tally::{Share, Tally, tally};

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
}
