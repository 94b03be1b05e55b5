//! Tests whether the cross-check finds faults.
//! One fault at a time is planted in one party of a proof, or in the code that all parties share.
//! The proof has default settings.
//!
//! A fault is a wrapper around a solver or an engine. The rest of the proof is the same as in a user's run.
//! If the two analytic sides contradict each other, the verdict needs no engine run.
//! Proofs in which the engine has no fault share the same engine runs.
//! The verdicts are the same as with new engine runs, because an engine's run does not depend on the data of the other
//! parties.
//!
//! The formulas of a scenario are a party too.
//! A wrong formula is judged with the correct motion of both analytic sides.

mod effect;
mod formulas;
#[cfg(test)]
mod judging;
mod kinds;
mod mutant;
mod plan;
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
