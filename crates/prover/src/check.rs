//! Check of claims: the formulas of a scenario, and their time derivatives, are compared with the results of one side
//! of the proof.
//!
//! The rounding error of a formula is propagated through its operations ([`formula::Rounded`]).
//! The error of the side's channels is propagated through the claim.
//! The bound is the sum of both errors. If the formula states an error, this error is added to the bound.

mod cause;
mod course;
mod dimension;
mod judge;
mod judged;
mod missing;
mod slips;
mod terms;
mod trial;
mod undefined;

pub use cause::{CUT, CauseSearch, FormulaCause, MOST_WORK, cause};
pub use course::{KnownTrajectory, needed, telling};
pub use judge::judge;
pub use judged::{FormulaAtInstant, FormulaOutcome, JudgedFormula};
pub use missing::Missing;
pub use slips::{FormulaMark, FormulaSlip, SlipKind, planted};
pub use terms::{Term, Wrong, missing_in_numbers};
pub use undefined::{Undefined, undefined};

/// Order of the derivative with respect to time, in words.
pub const WORDS: [&str; 3] = ["", "first derivative", "second derivative"];
