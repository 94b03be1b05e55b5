//! Claims: what formulas say of a mechanism, against what a side of the proof finds, by value and by derivative.
//!
//! A formula's own rounding is passed through its operations ([`formula::Rounded`]); what the side knows of its channels
//! is passed through the claim. Both make the bound: it is not chosen.

mod cause;
mod course;
mod judge;
mod judged;
mod slips;
mod values;

pub use cause::{Cause, cause};
pub use course::{Course, needed};
pub use judge::{Judge, judge};
pub use judged::{At, Judged, Outcome};
pub use slips::{Kind, Slip};

/// Which derivative with respect to time.
pub const WORDS: [&str; 3] = ["", "first derivative", "second derivative"];
