//! Tests whether the cross-check finds faults.
//! Single faults are planted in one party of a proof at default settings, or in the code that all parties share.
//!
//! A fault is a wrapper around a solver or an engine. Apart from this wrapper, the proof is the one that a user would
//! run.
//! If the fault is in one analytic side and the other side contradicts that side, the verdict needs no engine run.
//! Proofs in which the engine has no fault share the same engine runs.
//! New engine runs would give the same verdicts, because an engine's runs do not depend on the data with which they are
//! compared.
//!
//! The formulas of a scenario are a party too.
//! A mistake in a formula is judged by both analytic sides, whose motion is correct.

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
