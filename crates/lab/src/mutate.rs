//! Does the cross-check see faults? Single faults, planted in one party of a proof at default settings, or in what all
//! parties share.
//!
//! A fault stands around a solver or an engine, and the proof is the same as that of a user.
//! A fault in an analytic side that the other side contradicts needs no engine for its verdict. Other proofs with the
//! engine unchanged take its runs from the first of them; their verdicts are those of new runs, because an engine's
//! runs do not depend on what they are compared with.
//!
//! Formulas are a party too: a mistake in one of them is judged by both sides, whose motion is right.

mod effect;
mod formulas;
#[cfg(test)]
mod judging;
mod kinds;
mod lost;
mod mutant;
mod plan;
mod planted;
mod seen;
mod stage;
mod tally;
#[cfg(test)]
mod tests;

pub use kinds::{FaultFamily, FaultInstant, FaultKind, Mistake, Plant, all, named};
pub use mutant::{FaultyParty, Mutant, Mutated, Spoiled};
pub use plan::{MutationPlan, mutate};
pub use seen::{FaultyProof, Sight};
pub use tally::{FaultCounts, FaultTally, Share, tally};
