//! Wording of advice in a report.

use linkage::error::Advice;

/// Function that words an advice. A program with options names them; `Advice::to_string` names none.
pub type Tell = fn(&Advice) -> String;
