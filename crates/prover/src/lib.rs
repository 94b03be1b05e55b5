//! The proof: a case solved twice, compared within bounds that have a basis, and judged.
//!
//! - [`proof`]: one scenario from the two sides to the verdict.
//! - [`compare`], [`tolerance`]: residuals, orders of convergence, verdicts.
//! - [`diagnosis`]: the likely cause of a disagreement.
//! - [`claims`]: formulas against the mechanism.
//! - [`versus`], [`tables`]: tables and recordings of other programs against a scenario.
//! - [`accept`]: figures that were kept against those of today.
//! - [`engines`]: all engines by name.

pub mod accept;
pub mod claims;
pub mod compare;
pub mod diagnosis;
pub mod engines;
pub mod numbers;
pub mod proof;
mod sentences;
pub mod tables;
pub mod tolerance;
pub mod versus;
