//! Where changes of the case are tried, and what comes of one.

use std::rc::Rc;

use super::bench::{Bench, Misfit};
use super::cause::{Change, DataSlip, DisagreementCause};
use super::knobs::Knob;
use super::question::{Found, Rank};
use linkage::case::Case;
use linkage::trajectory::{Channel, Stage};

pub(super) type Make = Box<dyn Fn(&Case) -> Option<Case>>;

/// A change that explains something at the instants of a bench.
pub(super) struct Candidate {
    pub(super) found: Found,
    /// How it is solved on any grid.
    pub(super) make: Make,
    /// How much it changes in agreeing channels, in shares of their bounds.
    pub(super) claim: f64,
    /// For a value that was found: its part, the value, and the middle of the values that would do.
    pub(super) number: Option<(Rc<Knob>, [f64; 2])>,
}

impl Candidate {
    /// A change that leaves `misfit` of what is left by the reference, `start`; `None` if it explains nothing.
    pub(super) fn of(
        bench: &Bench,
        [start, misfit]: [&Misfit; 2],
        rank: Rank,
        cause: impl FnOnce(Vec<Channel>) -> DisagreementCause,
        make: Make,
    ) -> Option<Self> {
        let (explained, claim) = (bench.explained(start, misfit), bench.claim(start, misfit));
        let is_any = !explained.is_empty();
        let found = Found { cause: cause(explained.clone()), rank, explained };
        is_any.then_some(Candidate { found, make, claim, number: None })
    }

    /// The stage whose channels alone it is about; `None` for all.
    pub(super) fn stage(&self) -> Option<Stage> {
        let DisagreementCause::Values { slip: DataSlip::Late { stage, .. }, .. } = &self.found.cause else {
            return None;
        };
        *stage
    }
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
        for bench in [&self.first, &self.soon].into_iter().filter(|_| self.is_free) {
            if !bench.tried(&make(&bench.case)?)?.fits() {
                return None;
            }
        }
        self.thin.tried(&make(&self.thin.case)?)
    }

    pub(super) fn candidate(&self, misfit: &Misfit, rank: Rank, change: Change, make: Make) -> Option<Candidate> {
        Candidate::of(&self.thin, [&self.starts[1], misfit], rank, |_| DisagreementCause::Case(change), make)
    }
}
