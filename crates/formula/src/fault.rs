//! What is wrong with a formula, and where.

use std::fmt;
use std::ops::Range;

/// What is wrong with the text of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What was found.
    pub message: String,
    /// Bytes of the text that it is about.
    pub at: Range<usize>,
    /// The way out.
    pub help: String,
}

impl Fault {
    /// A fault with its place and the way out.
    pub(crate) fn new(message: impl Into<String>, at: Range<usize>, help: impl Into<String>) -> Self {
        Fault { message: message.into(), at, help: help.into() }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message)
    }
}

impl std::error::Error for Fault {}
