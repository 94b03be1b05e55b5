//! What a proof has done, part by part, and what it could leave out.

use linkage::work::{Work, counted};

/// One part of a proof.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LedgerEntry {
    /// The part.
    pub part: String,
    /// Why it was done, or why not.
    pub why: &'static str,
    /// What it took; `None` if it was not done.
    pub work: Option<Work>,
}

/// All parts so far, in their order.
#[derive(Debug, Default)]
pub struct Ledger(pub(super) Vec<LedgerEntry>);

impl Ledger {
    /// Does a part and counts it.
    pub(super) fn done<T>(&mut self, part: impl Into<String>, why: &'static str, run: impl FnOnce() -> T) -> T {
        let (answer, work) = counted(run);
        self.0.push(LedgerEntry { part: part.into(), why, work: Some(work) });
        answer
    }

    /// Notes a part that was not done.
    pub(super) fn skipped(&mut self, part: impl Into<String>, why: &'static str) {
        self.0.push(LedgerEntry { part: part.into(), why, work: None });
    }
}
