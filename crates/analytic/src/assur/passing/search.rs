//! The search for a change point, in one direction of the crank's rotation.

use crate::assur::groups::{Misfit, OutOfReach, SingularityDistance, SolutionPlan};
use crate::assur::turns::FOLLOWED_STEP;
use linkage::math::{KeepNan, Motion};
use linkage::mechanism::GroupId;

/// Ratio of a search step to the estimated distance of the change point.
/// At a dead point the estimate is twice the distance. A ratio below one half therefore keeps the search on the branch.
const STEP: f64 = 0.4;
/// Ratio of a search step to the estimated distance of the change point, for a higher group.
/// The group refuses steps in which its squared determinant might vanish.
const FOLLOWED: f64 = 0.2;
/// Smallest step (rad) in which a higher group is followed.
const SMALLEST: f64 = 1e-9;
/// If the sine of a group changes linearly and falls below this value, the sine counts as passing through zero.
/// At a change point, rounding of the lengths leaves a sine of at most the square root of the unit roundoff.
/// If a larger sine remains, the pose of the smallest sine is not a change point.
const MET: f64 = 1e-6;
/// Below this sine, the search stores the slope of the sine, for comparison with the slope at `MET`.
/// At a dead point the slope grows with the inverse of the sine.
const LINEAR: f64 = 1e-3;
/// For a higher group, these limits replace `MET` and `LINEAR`.
/// These limits apply to the determinant divided by its value at the start of the search.
/// They are larger because the start may already be near the change point.
const HIGHER: [f64; 2] = [1e-4, 3e-2];
const MOST_STEPS: usize = 200;

/// A pose from which a search begins.
pub(super) struct Start<'a> {
    pub(super) angle: f64,
    pub(super) plan: &'a SolutionPlan,
    pub(super) motions: &'a [Motion],
}

/// Searches for a change point of a group, at a distance of about `ahead` (rad) from a pose.
/// Returns the angle of the driving link at the change point.
/// If the search fails, the error is the angle up to which the group has no change point.
pub(super) fn change_point(start: &Start, group: GroupId, ahead: f64) -> Result<f64, f64> {
    let (mut plan, mut motions) = (start.plan.clone(), start.motions.to_vec());
    let (way, mut angle) = (ahead.signum(), start.angle);
    let mut slope = f64::NAN;
    let whole = plan.determinant(group).map(f64::abs);
    let [met, linear] = if whole.is_some() { HIGHER } else { [MET, LINEAR] };
    let mut before: Option<(f64, f64)> = None;
    for _ in 0..MOST_STEPS {
        let (sine, towards) = match (whole, clearance(&mut plan, &mut motions, group)) {
            (None, Some(SingularityDistance { sine, rate })) => (sine, -rate * way),
            (None, None) => return Err(angle),
            // For a higher group, the slope of the determinant follows from secants.
            (Some(whole), _) => {
                let share = plan.determinant(group).map_or(f64::NAN, |now| now.abs() / whole);
                let towards = before.map_or(share / ahead.abs(), |(x, last)| (last - share) / (angle - x).abs());
                before = Some((angle, share));
                (share, towards)
            }
        };
        // The comparison is negated so that NaN ends the search.
        if !(towards > 0.0) {
            return Err(angle);
        }
        if sine < linear && slope.is_nan() {
            slope = towards;
        }
        if sine < met {
            return if towards < 2.0 * slope { Ok(angle + way * sine / towards) } else { Err(angle) };
        }
        let step = if whole.is_some() { FOLLOWED } else { STEP };
        let to = angle + way * step * (sine / towards).smaller(0.25);
        if walk(&mut plan, &mut motions, [angle, to]).is_err() {
            return Err(angle);
        }
        angle = to;
    }
    Err(angle)
}

/// Clearance of a group at the last pose of a plan.
pub(super) fn clearance(
    plan: &mut SolutionPlan,
    motions: &mut [Motion],
    group: GroupId,
) -> Option<SingularityDistance> {
    plan.velocities(&[1.0], motions);
    plan.clearances(motions).nth(group.index()).flatten()
}

/// Places a plan at an angle, starting from its last pose. Higher groups are followed in small steps.
pub(super) fn walk(plan: &mut SolutionPlan, motions: &mut [Motion], [from, to]: [f64; 2]) -> Result<(), OutOfReach> {
    if plan.is_closed_form() {
        return plan.positions(&[to], motions);
    }
    let (mut at, mut step) = (from, FOLLOWED_STEP);
    while at != to {
        let next = if (to - at).abs() <= step { to } else { at + step.copysign(to - at) };
        match plan.positions(&[next], motions) {
            Ok(()) => (at, step) = (next, (2.0 * step).smaller(FOLLOWED_STEP)),
            Err(OutOfReach { why: Misfit::Lost, .. }) if step > SMALLEST => step *= 0.5,
            Err(reach) => return Err(reach),
        }
    }
    Ok(())
}
