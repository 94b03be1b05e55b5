//! How advice is worded in a report.

use linkage::error::Advice;

/// How advice is told: a program with options names them, [`Advice::to_string`] names none.
pub type Tell = fn(&Advice) -> String;
