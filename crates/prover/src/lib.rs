//! The proof: a case is solved twice, and the two results are compared within justified bounds and judged.
//!
//! - [`run`]: one scenario from the two analytic sides to the verdict.
//! - [`bounds`], [`tolerance`]: residuals, orders of convergence, verdicts.
//! - [`check`]: formulas against the mechanism.
//! - [`compare`], [`tables`]: tables and recordings of other programs against a scenario.
//! - [`diagnosis`]: the likely cause of a disagreement.
//! - [`mark`]: answers of students, with the causes of wrong answers.
//! - [`accept`]: accepted values against the values found now.
//! - [`engines`]: all engines by name.

pub mod accept;
pub mod bounds;
pub mod check;
pub mod compare;
pub mod diagnosis;
pub mod engines;
pub mod mark;
pub mod numbers;
pub mod run;
mod sentences;
pub mod tables;
pub mod tolerance;
