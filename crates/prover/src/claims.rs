//! Claims: what formulas say of a mechanism, against what a side of the proof finds, by value and by derivative.
//!
//! A formula's own rounding is passed through its operations ([`formula::Rounded`]); what the side knows of its channels
//! is passed through the claim. Both make the bound: it is not chosen.

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
pub use slips::{FormulaSlip, SlipKind, planted};
pub use terms::{Term, Wrong, missing_in_numbers};
pub use undefined::{Undefined, undefined};

/// Which derivative with respect to time.
pub const WORDS: [&str; 3] = ["", "first derivative", "second derivative"];
