//! Record of the parts of a proof that were done or skipped.

use linkage::work::{Work, counted};

/// One part of a proof.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LedgerEntry {
    /// The part.
    pub part: String,
    /// Reason why the part was done or skipped.
    pub why: &'static str,
    /// Work of the part; `None` if the part was skipped.
    pub work: Option<Work>,
}

/// All parts that were done or skipped so far, in order.
#[derive(Debug, Default)]
pub struct Ledger(pub(super) Vec<LedgerEntry>);

impl Ledger {
    /// Runs a part and counts its work.
    pub(super) fn done<T>(&mut self, part: impl Into<String>, why: &'static str, run: impl FnOnce() -> T) -> T {
        let (answer, work) = counted(run);
        self.0.push(LedgerEntry { part: part.into(), why, work: Some(work) });
        answer
    }

    /// Records a part that was skipped.
    pub(super) fn skipped(&mut self, part: impl Into<String>, why: &'static str) {
        self.0.push(LedgerEntry { part: part.into(), why, work: None });
    }
}
