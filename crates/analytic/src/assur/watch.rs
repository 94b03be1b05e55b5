//! Watches the dyads for which [`super::gauges`] cannot prove that a step contains no change point.
//!
//! The closed form keeps the sign of a dyad's sine. At a change point, the computed motion therefore has a corner: the
//! dyad's clearance falls to zero and rises again.
//! The watch is only an estimate: the speeds of the carrying links between two poses are inferred from these poses.
//! The estimate misses a clearance that falls to zero, rises and falls again within one step.
//! For dyads behind a higher group, a step is 2 degrees.
//! See docs/numerics/change_points.md.

use super::gauges::Gauges;
use crate::assur::groups::{SingularityDistance, SolutionPlan};
use linkage::math::{KeepNan, Motion};
use linkage::mechanism::{PerGroup, PerLink};

/// If the clearance of a dyad is below this value, a change point may lie within a step.
/// While the clearance goes from 0.8 to 0 and back, the links of the dyad turn by 106 deg relative to each other.
/// If this relative rotation is [`FAST`] times as fast as the crank's rotation, the crank turns by 7 deg in the same
/// time.
/// These 7 deg are more than one step for dyads behind a higher group (2 deg), but less than one step (15 deg) if the
/// mechanism has only dyads.
const NARROW: f64 = 0.8;
/// A clearance is assumed to stay above zero if it exceeds this multiple of its expected change over the rest of the
/// step.
/// Near a change point the sine is linear in the crank angle.
/// The sine then changes equally over the last step and the next step, and a factor of 1 would suffice.
/// Near a dead point the sine is proportional to the root of the distance.
/// The change of the sine over the next step is then up to (1 + root 2) times its change over the last step.
/// The difference between the factor `CLEAR` and 1 + root 2 is a reserve, not a proof.
pub(super) const CLEAR: f64 = 4.0;
/// Largest expected rotation of a dyad's links relative to each other, divided by the rotation of the crank.
/// The value is an assumption. The assumption is valid if every link that carries a dyad turns at less than 16 times
/// the speed of the crank.
const FAST: f64 = 16.0;

/// Placeholder for a group without a clearance.
const NONE: SingularityDistance = SingularityDistance { sine: f64::NAN, rate: f64::NAN };

/// Clearances of one group. Rates are derivatives with respect to the crank angle; NaN if unknown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub(super) last: SingularityDistance,
    pub(super) now: SingularityDistance,
    /// Magnitude of the clearance's change over the last step.
    fall: f64,
    /// Whether the group is watched.
    is_watched: bool,
}

impl Seen {
    /// Whether the clearance may have fallen to zero and risen again. `sense` is the crank's direction in this step.
    #[inline]
    pub(super) fn may_pass(&self, sense: f64) -> bool {
        // `last.rate` may be unknown (NaN). The comparison of `last.rate` is negated, so that an unknown rate counts as
        // falling.
        self.last.sine.smaller(self.now.sine) < NARROW
            && !(self.last.rate * sense >= 0.0)
            && self.now.rate * sense > 0.0
    }
}

/// Clearances of all groups at the last two poses.
#[derive(Debug)]
pub(super) struct Watch {
    is_needed: bool,
    pub(super) motions: PerLink<Motion>,
    pub(super) groups: PerGroup<Seen>,
    /// Magnitude of the last step of the crank (rad).
    step: f64,
}

impl Watch {
    pub(super) fn of(plan: &SolutionPlan, gauges: &Gauges) -> Self {
        let seen = Seen { last: NONE, now: NONE, fall: f64::NAN, is_watched: false };
        let groups = vec![seen; plan.steps().len()].into();
        let mut watch = Watch { is_needed: false, motions: PerLink::default(), groups, step: 0.0 };
        watch.leave_to(gauges, plan);
        watch
    }

    /// Watches nothing.
    pub(super) fn none() -> Self {
        Watch { is_needed: false, motions: PerLink::default(), groups: PerGroup::default(), step: 0.0 }
    }

    /// Watches the groups that have a clearance and are not among the gauges' proven groups.
    pub(super) fn leave_to(&mut self, gauges: &Gauges, plan: &SolutionPlan) {
        for (seen, step) in self.groups.iter_mut().zip(plan.steps()) {
            seen.is_watched = step.has_clearance();
        }
        for group in gauges.proven() {
            self.groups[group].is_watched = false;
        }
        for seen in &mut self.groups {
            if !seen.is_watched {
                (seen.last, seen.fall) = (NONE, f64::NAN);
            }
        }
        self.is_needed = self.groups.iter().any(|seen| seen.is_watched);
    }

    /// Whether a watched group has an unknown clearance at the last pose.
    #[inline]
    pub(super) fn begins(&self) -> bool {
        self.groups.iter().any(|seen| seen.is_watched && seen.last.sine.is_nan())
    }

    /// Whether at least one group is watched.
    #[inline]
    pub(super) fn is_needed(&self) -> bool {
        self.is_needed
    }

    /// Computes the clearances from the present velocities, which were computed for the given angular velocity of the
    /// crank.
    /// Returns whether a group may have passed a change point.
    #[inline]
    pub(super) fn see(&mut self, plan: &SolutionPlan, motions: &[Motion], omega: f64, sense: f64) -> bool {
        let per_unit = 1.0 / omega;
        let mut may_pass = false;
        for (group, seen) in plan.steps().iter().zip(&mut self.groups).filter(|(_, seen)| seen.is_watched) {
            if let Some(found) = group.clearance(motions) {
                seen.now = SingularityDistance { rate: found.rate * per_unit, ..found };
                may_pass |= seen.may_pass(sense);
            }
        }
        may_pass
    }

    /// Whether the positions alone show that no group passes a change point on this step of the crank.
    /// A step through a change point changes the angle between the dyad's links by at least the sum of the sines before
    /// and after the step.
    /// A group is therefore safe if this sum exceeds both of the following limits.
    /// The first limit is the largest expected rotation in this step.
    /// The second limit is `CLEAR` times the change of the clearance over the last step, scaled to this step.
    #[inline]
    pub(super) fn is_far(&mut self, step: f64, plan: &SolutionPlan, motions: &[Motion]) -> bool {
        let (steps, mut is_far) = (CLEAR * step / self.step, true);
        for (group, seen) in plan.steps().iter().zip(&mut self.groups).filter(|(_, seen)| seen.is_watched) {
            if let Some(sine) = group.sine(motions) {
                let both = seen.last.sine + sine;
                is_far &= both > FAST * step && both > steps * seen.fall;
                seen.fall = (sine - seen.last.sine).abs();
                seen.now = SingularityDistance { sine, rate: f64::NAN };
            }
        }
        self.step = step;
        is_far
    }
}
