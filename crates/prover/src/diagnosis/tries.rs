//! Where changes of the case are tried, and what comes of one.

use std::rc::Rc;

use super::bench::{Bench, Misfit};
use super::cause::Cause;
use super::knobs::Knob;
use super::question::Rank;
use linkage::case::Case;
use linkage::trajectory::{Channel, Stage};

pub(super) type Make = Box<dyn Fn(&Case) -> Option<Case>>;

/// A change that explains something at the instants of a bench.
pub(super) struct Candidate {
    pub(super) rank: Rank,
    pub(super) cause: Cause,
    /// How it is solved on any grid.
    pub(super) make: Make,
    pub(super) stage: Option<Stage>,
    pub(super) explained: Vec<Channel>,
    /// How much it changes in agreeing channels, in shares of their bounds.
    pub(super) claim: f64,
    /// For a value that was found: its part, the value, and the middle of the values that would do.
    pub(super) number: Option<(Rc<Knob>, [f64; 2])>,
}

/// The instants on which changes are tried. A free motion is followed for a short time first: later it may depend on
/// its cause in no simple way, and its solution costs more.
pub(super) struct Tries<'a> {
    /// The first instant, which costs nothing: another configuration shows there, and may lead nowhere.
    pub(super) first: Bench<'a>,
    pub(super) soon: Bench<'a>,
    pub(super) thin: Bench<'a>,
    /// What the reference leaves on both.
    pub(super) starts: [Misfit; 2],
    pub(super) is_free: bool,
}

impl Tries<'_> {
    /// What a change leaves. A free motion that it does not explain for a short time is not followed further.
    pub(super) fn of(&self, make: &dyn Fn(&Case) -> Option<Case>) -> Option<Misfit> {
        if self.is_free && !self.first.tried(&make(&self.first.case)?)?.fits() {
            return None;
        }
        if self.is_free && !self.soon.tried(&make(&self.soon.case)?)?.fits() {
            return None;
        }
        self.thin.tried(&make(&self.thin.case)?)
    }

    pub(super) fn candidate(&self, misfit: &Misfit, rank: Rank, cause: Cause, make: Make) -> Option<Candidate> {
        let (explained, claim) =
            (self.thin.explained(&self.starts[1], misfit), self.thin.claim(&self.starts[1], misfit));
        (!explained.is_empty()).then_some(Candidate { rank, cause, make, stage: None, explained, claim, number: None })
    }
}
