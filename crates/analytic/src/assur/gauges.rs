//! Proof that no dyad passes a change point on a step of `PoseSolver`.
//!
//! In a pose where two branches of a dyad meet, the dyad's [gauge](crate::assur::groups::Step::gauge) is at an end of
//! the range of the gauge.
//! Between two poses the gauge differs from linear interpolation by at most M h^2 / 8.
//! Here h is the step and M a bound of the gauge's second derivative.
//! If the gauge cannot leave its range even with this deviation, the dyad stays on one branch.
//! For a dyad on the ground and on driving links of constant speed ratio, M is known.
//! If the deviation for the whole step is too large for a proof, the step is divided.
//! The division ends when the proof holds for every part of the step, or when a change point is found.
//! For a dyad on other dyads, M follows from the bounds of the dyads that carry it.
//! These bounds grow from dyad to dyad, and with the inverse of the sine of each dyad's transmission angle.
//! If these bounds give no proof, the estimate of [`super::watch`] decides.
//! The estimate of [`super::watch`] also serves dyads on higher groups, dyads on RPP or PRP dyads, and mechanisms
//! with several driving links whose speed ratios change.
//!
//! The bounds of one step are stored and used for later steps.
//! For this purpose they are computed for a band of each gauge that is wider than the present step needs.
//! The stored bounds hold until a gauge leaves its band, a step is longer than the stored step, or the crank has moved
//! farther than the stored travel.
//! See docs/numerics/change_points.md.

use crate::assur::groups::{Bound, Limit, Misfit, OutOfReach, SINGULAR, SolutionPlan};
use linkage::case::Case;
use linkage::math::{KeepNan, Motion};
use linkage::mechanism::GroupId;

/// During the present step, a gauge stays in a band within its range.
/// The stored band is wider: between it and each end of the range, only this fraction of the original gap remains.
const SPARE: f64 = 0.25;
/// Bounds are computed for a step that is longer than the present step by this factor, because the steps of a grid are
/// equal only within rounding error.
const LONGER: f64 = 1.0 + 1e-6;
/// A gauge without an upper limit may grow by this factor while the bounds are valid.
const GROWN: f64 = 4.0;
/// If no proof is found, the next attempt follows after this many steps.
const AGAIN: f64 = 16.0;

/// A group with a gauge.
#[derive(Clone, Copy, Debug)]
struct Watched {
    group: GroupId,
    /// Whether the group is attached to driving links and the ground only.
    is_direct: bool,
    /// Whether the proof for this step is missing.
    is_open: bool,
    /// Limits of the gauge at the two ends of a step.
    /// If the gauge lies between `low` and `high` at both ends, a step of at most the stored length is proven.
    low: f64,
    high: f64,
    /// Gauges at the pose before the last and at the last pose; NaN before the first pose.
    before: f64,
    last: f64,
}

/// The gauges of all groups for which a proof is possible.
#[derive(Debug)]
pub(super) struct Gauges {
    watched: Vec<Watched>,
    /// Speed ratios of the driving links to the crank.
    ratios: Vec<f64>,
    links: Vec<Option<Bound>>,
    /// Longest step (rad) that the stored bounds cover, and remaining crank travel (rad) for which the bounds are
    /// valid.
    reach: f64,
    left: f64,
}

/// One end of a step: crank angle, gauges of all watched groups, and pose. The pose is used only at the second end of a
/// step.
#[derive(Clone, Debug)]
struct End {
    crank: f64,
    gauges: Vec<f64>,
    motions: Vec<Motion>,
}

impl Gauges {
    pub(super) fn of(case: &Case, plan: &SolutionPlan, motions: &[Motion]) -> Self {
        let speeds: Option<Vec<f64>> = case.drives.iter().map(|drive| drive.constant_speed()).collect();
        let ratios = match speeds {
            Some(speeds) => speeds.iter().map(|speed| speed / speeds[0]).collect(),
            None if case.drives.len() == 1 => vec![1.0],
            None => Vec::new(),
        };
        let links = vec![None; case.mechanism.links().len()];
        let mut gauges = Gauges { watched: Vec::new(), ratios, links, reach: -1.0, left: 0.0 };
        if gauges.ratios.is_empty() {
            return gauges;
        }
        let (none, mut driven) = (f64::NAN, gauges.links.clone());
        plan.bound_drivers(&gauges.ratios, &mut gauges.links);
        driven.clone_from(&gauges.links);
        for (group, step) in plan.steps().entries() {
            let has_limit = |links: &[Option<Bound>]| step.limit(links, motions, 1.0, 0.0).is_some();
            if has_limit(&gauges.links) {
                let is_direct = has_limit(&driven);
                let (low, high, before, last) = (none, none, none, none);
                gauges.watched.push(Watched { group, is_direct, is_open: false, low, high, before, last });
                step.bound([none, none], 0.0, motions, &mut gauges.links);
            }
        }
        gauges
    }

    /// Returns an empty set of gauges: every step counts as proven.
    pub(super) fn none() -> Self {
        Gauges { watched: Vec::new(), ratios: Vec::new(), links: Vec::new(), reach: f64::INFINITY, left: f64::INFINITY }
    }

    /// The groups proven not to pass a change point in this step. These groups need no estimate.
    pub(super) fn proven(&self) -> impl Iterator<Item = GroupId> {
        self.watched.iter().filter(|watched| !watched.is_open).map(|watched| watched.group)
    }

    /// Records the pose that `plan` has just found. `step` is the unsigned crank angle (rad) between the last pose and
    /// this pose.
    /// Returns whether the stored bounds cover this step; if not, call [`Gauges::pass_closely`].
    #[inline(always)]
    pub(super) fn pass(&mut self, step: f64, plan: &SolutionPlan) -> bool {
        self.left -= step;
        let mut passes = step <= self.reach && self.left >= 0.0;
        for watched in &mut self.watched {
            let gauge = plan.steps()[watched.group].gauge();
            passes &= watched.low <= gauge && gauge <= watched.high;
            (watched.before, watched.last) = (watched.last, gauge);
        }
        passes
    }

    /// Undoes the record of the last pose.
    #[cold]
    pub(super) fn take_back(&mut self) {
        self.watched.iter_mut().for_each(|watched| watched.last = watched.before);
        self.reach = -1.0;
    }

    /// Checks the step between two crank angles (rad) with bounds for this step, and divides the step where necessary.
    ///
    /// # Errors
    /// [`Misfit::Passed`] with the change point. After this error, the last recorded pose is again the pose before the
    /// step.
    #[cold]
    pub(super) fn pass_closely(
        &mut self,
        [from, to]: [f64; 2],
        case: &Case,
        plan: &SolutionPlan,
        motions: &[Motion],
    ) -> Result<(), OutOfReach> {
        let (step, begins) = ((to - from).abs(), self.watched.iter().any(|watched| watched.before.is_nan()));
        let ends = [
            End { crank: from, gauges: self.watched.iter().map(|own| own.before).collect(), motions: Vec::new() },
            End { crank: to, gauges: self.watched.iter().map(|own| own.last).collect(), motions: motions.to_vec() },
        ];
        self.watched.iter_mut().for_each(|watched| watched.is_open = false);
        if begins {
            return Ok(());
        }
        if self.prove(&ends, plan, step * LONGER, SPARE) {
            if self.is_open() {
                // Repeat the proof with bounds that hold for this step only.
                self.prove(&ends, plan, step * LONGER, 1.0);
            }
            if self.is_open() {
                self.left = self.left.smaller(AGAIN * step);
            }
            return Ok(());
        }
        let mut plan = plan.clone();
        let proven = self.divide(case, &mut plan, ends);
        self.reach = -1.0;
        self.watched.iter_mut().for_each(|watched| watched.is_open = !watched.is_direct);
        if proven.is_err() {
            self.take_back();
        }
        proven
    }

    fn is_open(&self) -> bool {
        self.watched.iter().any(|watched| watched.is_open)
    }

    /// Whether the gauges of all direct groups stay within their ranges between the two poses `ends`, if the step from
    /// pose to pose is at most `step` (rad).
    /// Stores the bounds of this proof, with a band for each gauge.
    /// The stored band is wider than the band of this step: of the gap between this step's band and each end of the
    /// gauge's range, only the fraction `share` remains.
    /// A group that is not direct and has no proof is marked open.
    fn prove(&mut self, ends: &[End; 2], plan: &SolutionPlan, step: f64, share: f64) -> bool {
        let motions = &ends[1].motions;
        (self.reach, self.left) = (-1.0, f64::INFINITY);
        plan.bound_drivers(&self.ratios, &mut self.links);
        for (index, watched) in self.watched.iter_mut().enumerate() {
            let group = &plan.steps()[watched.group];
            let [first, second] = [0, 1].map(|end| ends[end].gauges[index]);
            let (least, most) = (first.smaller(second), first.larger(second));
            let limit = group.limit(&self.links, motions, GROWN * most, step);
            let found = limit.and_then(|limit| band(limit, [least, most], step, share));
            watched.is_open = found.is_none();
            let Some((limit, band, bulge)) = found else {
                if watched.is_direct {
                    return false;
                }
                (watched.low, watched.high) = (f64::NEG_INFINITY, f64::INFINITY);
                continue;
            };
            (watched.low, watched.high) = (band[0] + bulge, band[1] - bulge);
            self.left = self.left.smaller(limit.way);
            group.bound(band, step, motions, &mut self.links);
        }
        self.reach = step;
        true
    }

    /// Proves the step for the direct groups, which are attached to driving links and the ground only.
    /// Divides the step where necessary.
    fn divide(&self, case: &Case, plan: &mut SolutionPlan, ends: [End; 2]) -> Result<(), OutOfReach> {
        let (from, to) = (ends[0].crank, ends[1].crank);
        let step = (to - from).abs();
        let mut links = vec![None; self.links.len()];
        plan.bound_drivers(&self.ratios, &mut links);
        let direct = || self.watched.iter().enumerate().filter(|(_, watched)| watched.is_direct);
        let is_open = |&(index, watched): &(usize, &Watched)| {
            let [first, second] = [0, 1].map(|end| ends[end].gauges[index]);
            let (least, most) = (first.smaller(second), first.larger(second));
            let limit = plan.steps()[watched.group].limit(&links, &ends[1].motions, GROWN * most, step);
            limit.and_then(|limit| band(limit, [least, most], step, 1.0)).is_none()
        };
        let Some((_, open)) = direct().find(is_open) else { return Ok(()) };
        let middle = f64::midpoint(from, to);
        let passed = |group: GroupId| OutOfReach { group, why: Misfit::Passed { crank: middle } };
        if !(step > 8.0 * f64::EPSILON * to.abs().larger(1.0)) {
            return Err(passed(open.group));
        }
        let mut motions = ends[1].motions.clone();
        let groups = direct().map(|(_, watched)| watched.group);
        plan.some_positions(groups, &case.drives.coordinates(middle), &mut motions)
            .map_err(|reach| passed(reach.group))?;
        let mut gauges = vec![f64::NAN; self.watched.len()];
        for (index, watched) in direct() {
            let group = &plan.steps()[watched.group];
            // A group without a clearance has no sine and does not count as singular.
            if group.sine(&motions).is_some_and(|sine| sine < 10.0 * SINGULAR) {
                return Err(passed(watched.group));
            }
            gauges[index] = group.gauge();
        }
        let middle = End { crank: middle, gauges, motions };
        let [first, last] = ends;
        self.divide(case, plan, [first, middle.clone()])?;
        self.divide(case, plan, [middle, last])
    }
}

/// Returns the band in which a gauge stays during a step, and its largest deviation from linear interpolation.
/// `least` and `most` are the gauge's smaller and larger values at the ends of the step.
/// Returns `None` if the gauge may leave its range.
fn band(limit: Limit, [least, most]: [f64; 2], step: f64, share: f64) -> Option<(Limit, [f64; 2], f64)> {
    let bulge = limit.second * step * step / 8.0;
    let [start, end] = limit.range;
    let end = if end.is_finite() { end } else { GROWN * most };
    let (under, over) = (least - bulge - start, end - most - bulge);
    // The comparison is negated so that NaN gives no proof.
    if !(under > 0.0 && over > 0.0) {
        return None;
    }
    let high = if limit.range[1].is_finite() { end - share * over } else { end };
    Some((limit, [start + share * under, high], bulge))
}
