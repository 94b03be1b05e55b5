//! How far an engine's judgement is from being conclusive, and which part of its bounds is to blame.

use linkage::math::KeepNan;
use linkage::math::statistics::share;

use super::judge::Judged;
use crate::compare::Verdict;
use crate::tolerance::Part;

/// Share of instants that may be left out because they are too close to a reversal for the step.
pub(super) const MOST_LEFT_OUT: f64 = 0.03;
/// Need of a step that leaves out more, over what is wanted.
const LEFT_OUT: f64 = 2.0;

/// What is farthest from being conclusive.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) enum Of {
    /// The bound of a channel or check.
    Bound,
    /// The instants that a step leaves out.
    Instants,
}

/// How far a trial is from being conclusive.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) struct Need {
    /// Whether the runs show no order, so that the bound means little.
    pub(super) is_vague: bool,
    /// Largest bound over what is wanted.
    pub(super) share: f64,
    /// What it is that needs it.
    pub(super) of: Of,
}

impl Need {
    /// Whether a bound that means something is at most `most` of what is wanted.
    pub(super) fn is_within(self, most: f64) -> bool {
        !self.is_vague && self.share <= most
    }

    /// Whether this is at most `part` of another need, or shows an order where that one does not.
    pub(super) fn is_less(self, part: f64, other: Need) -> bool {
        match (self.is_vague, other.is_vague) {
            (false, true) => true,
            (true, false) => false,
            (true, true) | (false, false) => self.share <= part * other.share,
        }
    }

    /// Whether all that is missing is a step that leaves out fewer instants.
    pub(super) fn is_of_instants(self) -> bool {
        !self.is_vague && self.of == Of::Instants
    }
}

/// Part of a bound up to which the sweeps share the blame for it.
const SHARED: f64 = 0.8;

/// What is to blame for the largest bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Blame {
    /// Its largest part.
    pub(super) part: Part,
    /// Whether that is the sweeps, but the step leaves a good part too: half the step makes both smaller.
    pub(super) is_shared: bool,
}

/// The largest bound of a channel or check over what is wanted, `wanted` of its scale, and what is to blame.
/// Those whose runs show no order come first.
pub(super) fn need(judged: &Judged, wanted: f64) -> (Need, Blame) {
    let channels =
        judged.proof.channels.iter().map(|own| (own.parts, own.residual.scale, &own.convergence, &own.verdict));
    let checks = judged.proof.checks.iter().filter_map(|check| {
        let (parts, convergence) = check.estimate.as_ref()?;
        Some((*parts, 1.0, convergence, &check.verdict))
    });
    // A step that leaves out many instants proves nothing about them.
    let (least, of) = if judged.too_coarse > MOST_LEFT_OUT { (LEFT_OUT, Of::Instants) } else { (0.0, Of::Bound) };
    let none = Blame { part: Part::Discretisation, is_shared: false };
    let mut worst = (Need { is_vague: false, share: least, of }, none);
    for (parts, scale, convergence, verdict) in channels.chain(checks) {
        let share = share(parts.sum(), wanted * scale);
        let is_open = matches!(verdict, Verdict::Inconclusive { .. });
        // Open for another reason than its bound: no setting changes that.
        let is_vague = is_open && !convergence.is_trusted();
        let share = if is_open && !is_vague && share <= 1.0 { 0.0 } else { share.larger(0.0) };
        let own = Need { is_vague, share: if share.is_nan() { f64::INFINITY } else { share }, of: Of::Bound };
        if own > worst.0 {
            // Where no order is seen, the sweeps are to blame as soon as they leave a part that counts.
            let sweeps = is_vague && 10.0 * parts.iteration > parts.discretisation;
            let part = if sweeps { Part::Iteration } else { parts.largest() };
            worst =
                (own, Blame { part, is_shared: part == Part::Iteration && parts.iteration <= SHARED * parts.sum() });
        }
    }
    worst
}
