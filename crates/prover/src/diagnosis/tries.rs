//! The instants at which changes of the case are tried, and the results.

use std::rc::Rc;

use super::bench::{Bench, Misfit};
use super::cause::{Change, DataSlip, DisagreementCause, LateChannels};
use super::knobs::Knob;
use super::question::{Found, Rank};
use linkage::case::Case;
use linkage::trajectory::Channel;

pub(super) type Make = Box<dyn Fn(&Case) -> Option<Case>>;

/// A change that explains disagreeing channels at the instants of a bench.
pub(super) struct Candidate {
    pub(super) found: Found,
    /// Makes the changed case on any grid.
    pub(super) make: Make,
    /// Sum over the agreeing channels: the change of the channel's values, divided by the channel's bound.
    pub(super) claim: f64,
    /// If the change is a found value of a knob: the knob, the value, and the middle of the range of values that
    /// explain the channels.
    pub(super) number: Option<(Rc<Knob>, [f64; 2])>,
}

impl Candidate {
    /// A change that reduces the misfit of the reference, `start`, to `misfit`; `None` if it explains no channel.
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

    /// The channels to which the change is limited.
    pub(super) fn changed_channels(&self) -> LateChannels {
        match &self.found.cause {
            DisagreementCause::Values { slip: DataSlip::Late { of, .. }, .. } => *of,
            DisagreementCause::Values { .. } | DisagreementCause::Case(_) => LateChannels::All,
        }
    }
}

/// The benches at which changes are tried. A free motion is first followed for a short time only: at later times, the
/// motion may depend on the cause in a complicated way, and the solution costs more.
pub(super) struct Tries<'a> {
    /// Bench with the first instant only. Solving the case at this instant costs almost nothing, and already shows a
    /// changed configuration.
    pub(super) first: Bench<'a>,
    pub(super) soon: Bench<'a>,
    pub(super) thin: Bench<'a>,
    /// Misfit of the unchanged reference on `soon` and on `thin`.
    pub(super) starts: [Misfit; 2],
    pub(super) is_free: bool,
}

impl Tries<'_> {
    /// Misfit that remains after a change. A free motion is not followed further if the change does not explain the
    /// first part of the motion.
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
