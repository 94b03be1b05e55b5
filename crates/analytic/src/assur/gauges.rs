//! Proof that no dyad passes a change point on a step of `PoseSolver`.
//!
//! Where two branches of a dyad meet, its [gauge](crate::assur::groups::Step::gauge) is at an end of its range.
//! Between two poses the gauge differs from the straight line through its values there by M h^2 / 8 at most. If that
//! band is within the range, the dyad is on one branch all the way. If it is not, the step is divided.
//! M is known for dyads that hang on driving links of constant speed ratio and on other such dyads. It is not for those
//! that hang on higher groups, or on sliders of two guides: [`super::watch`] sees to these.
//!
//! Bounds are kept for the next steps. They are those of a band that is wider than the step needs, so that they hold
//! until a gauge leaves it, a step is longer, or a moving guide has gone far.

use crate::assur::groups::{Bound, Limit, Misfit, OutOfReach, Plan, SINGULAR};
use linkage::case::Case;
use linkage::math::{KeepNan, Motion};

/// Share of the way from the end of the range to the band of a step that the kept band leaves out.
const SPARE: f64 = 0.25;
/// Steps are kept that are a little longer too: those of a grid are equal to rounding only.
const LONGER: f64 = 1.0 + 1e-6;
/// Gauges without an end may grow to this multiple.
const GROWN: f64 = 4.0;
/// Poses by which one step is divided at most. More are needed only where several dyads are singular at once.
const MOST_POSES: usize = 1 << 14;

/// A group with a gauge.
#[derive(Clone, Copy, Debug)]
struct Watched {
    group: usize,
    /// Between these a step of the kept length is proven.
    low: f64,
    high: f64,
    /// The gauge at the last two poses; NaN before the first.
    before: f64,
    last: f64,
}

/// The gauges of all groups for which a proof is possible.
#[derive(Debug)]
pub(super) struct Gauges {
    watched: Vec<Watched>,
    /// Speeds of the driving links in that of the crank.
    ratios: Vec<f64>,
    links: Vec<Option<Bound>>,
    /// Longest step of the crank (rad) for which the kept bounds are good, and the way for which they still are.
    reach: f64,
    left: f64,
}

/// One end of a step: crank angle, gauges in the order of the watched groups, and the pose. The pose is only read at
/// the far end.
#[derive(Clone, Debug)]
struct End {
    crank: f64,
    gauges: Vec<f64>,
    motions: Vec<Motion>,
}

impl Gauges {
    pub(super) fn of(case: &Case, plan: &Plan, motions: &[Motion]) -> Self {
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
        plan.bound_drivers(&gauges.ratios, &mut gauges.links);
        for (group, step) in plan.steps().iter().enumerate() {
            if step.limit(&gauges.links, motions, 1.0, 0.0).is_some() {
                let none = f64::NAN;
                gauges.watched.push(Watched { group, low: none, high: none, before: none, last: none });
                step.bound([none, none], 0.0, motions, &mut gauges.links);
            }
        }
        gauges
    }

    /// Whether a group is watched here.
    pub(super) fn has(&self, group: usize) -> bool {
        self.watched.iter().any(|watched| watched.group == group)
    }

    /// Takes the pose that `plan` has just found, a step (rad, without sign) of the crank after the last one. Returns
    /// whether the kept bounds prove that nothing is passed on it; otherwise [`Gauges::pass_closely`] must.
    #[inline(always)]
    pub(super) fn pass(&mut self, step: f64, plan: &Plan) -> bool {
        self.left -= step;
        let mut passes = step <= self.reach && self.left >= 0.0;
        for watched in &mut self.watched {
            let gauge = plan.steps()[watched.group].gauge();
            passes &= watched.low <= gauge && gauge <= watched.high;
            (watched.before, watched.last) = (watched.last, gauge);
        }
        passes
    }

    /// The same with bounds of this very step between two crank angles (rad), divided where it must be.
    ///
    /// # Errors
    /// [`Misfit::Passed`] with the first change point; the last pose is then that before the step again.
    #[cold]
    pub(super) fn pass_closely(
        &mut self,
        [from, to]: [f64; 2],
        case: &Case,
        plan: &Plan,
        motions: &[Motion],
    ) -> Result<(), OutOfReach> {
        let (step, begins) = ((to - from).abs(), self.watched.iter().any(|watched| watched.before.is_nan()));
        let ends = [
            End { crank: from, gauges: self.watched.iter().map(|own| own.before).collect(), motions: Vec::new() },
            End { crank: to, gauges: self.watched.iter().map(|own| own.last).collect(), motions: motions.to_vec() },
        ];
        if begins || self.prove(&ends, plan, step * LONGER, SPARE) {
            return Ok(());
        }
        let mut search = Search { case, plan: plan.clone(), left: MOST_POSES };
        let proven = self.divide(&mut search, ends);
        self.reach = -1.0;
        if proven.is_err() {
            self.watched.iter_mut().for_each(|watched| watched.last = watched.before);
        }
        proven
    }

    /// Whether all gauges stay within their ranges between two poses, over steps of this length.
    /// Keeps the bounds that prove it, of bands that leave out this share of what the step leaves.
    fn prove(&mut self, ends: &[End; 2], plan: &Plan, step: f64, share: f64) -> bool {
        let motions = &ends[1].motions;
        (self.reach, self.left) = (-1.0, f64::INFINITY);
        plan.bound_drivers(&self.ratios, &mut self.links);
        for (index, watched) in self.watched.iter_mut().enumerate() {
            let [first, second] = [0, 1].map(|end| ends[end].gauges[index]);
            let (least, most) = (first.smaller(second), first.larger(second));
            let group = &plan.steps()[watched.group];
            let Some(Limit { range, second, way }) = group.limit(&self.links, motions, GROWN * most, step) else {
                return false;
            };
            let bulge = second * step * step / 8.0;
            let end = if range[1].is_finite() { range[1] } else { GROWN * most };
            let (under, over) = (least - bulge - range[0], end - most - bulge);
            // Written so that NaN proves nothing.
            if !(under > 0.0 && over > 0.0) {
                return false;
            }
            let band = [range[0] + share * under, if range[1].is_finite() { end - share * over } else { end }];
            (watched.low, watched.high) = (band[0] + bulge, band[1] - bulge);
            self.left = self.left.smaller(way);
            group.bound(band, step, motions, &mut self.links);
        }
        self.reach = step;
        true
    }

    /// The same for a step that may have to be divided.
    fn divide(&mut self, search: &mut Search, ends: [End; 2]) -> Result<(), OutOfReach> {
        let (from, to) = (ends[0].crank, ends[1].crank);
        if self.prove(&ends, &search.plan, (to - from).abs(), 1.0) {
            return Ok(());
        }
        let middle = f64::midpoint(from, to);
        let passed = |group: usize| OutOfReach { group, why: Misfit::Passed { crank: middle } };
        let first = self.watched.first().map_or(0, |watched| watched.group);
        search.left = search.left.checked_sub(1).ok_or(passed(first))?;
        if (to - from).abs() <= 8.0 * f64::EPSILON * to.abs().larger(1.0) {
            return Err(passed(first));
        }
        let groups = self.watched.iter().map(|watched| watched.group);
        let angles = search.case.drives.world_angles(middle);
        let mut motions = ends[1].motions.clone();
        search.plan.some_positions(groups, &angles, &mut motions).map_err(|reach| passed(reach.group))?;
        let steps = search.plan.steps();
        let near = |own: &&Watched| steps[own.group].sine(&motions).is_some_and(|sine| sine < 10.0 * SINGULAR);
        if let Some(own) = self.watched.iter().find(near) {
            return Err(passed(own.group));
        }
        let gauges = self.watched.iter().map(|watched| steps[watched.group].gauge()).collect();
        let middle = End { crank: middle, gauges, motions };
        let [first, last] = ends;
        self.divide(search, [first, middle.clone()])?;
        self.divide(search, [middle, last])
    }
}

/// Poses between those of a step, without those of the groups that are not watched.
struct Search<'a> {
    case: &'a Case,
    plan: Plan,
    /// Poses that may still be found.
    left: usize,
}
