//! How side 1 passes change points: where two branches of a group cross, the mechanism continues on the branch with
//! continuous velocities.
//!
//! Along this branch all positions and transfer functions are smooth functions of the driving link's angle.
//! At the change point, only the equations of the group are singular; the motion is not.
//! The sine of the transmission angle, or the corresponding measure of the dyad, passes through zero linearly.
//! The closed form keeps the sign of this sine, but beyond the change point the opposite sign is correct.
//! In a [`Window`] around the change point, the equations of the pose are not solved.
//! The results come from polynomials through poses on both sides.
//! See docs/numerics/change_points.md.

mod forces;
mod search;
mod window;

use crate::assur::groups::{OutOfReach, SingularityDistance, SolutionPlan};
use crate::sentences;
use linkage::case::Case;
use linkage::error::{Error, ErrorKind};
use linkage::input::InputValue;
use linkage::math::{KeepNan, Motion};
use linkage::mechanism::GroupId;
use window::Window;

/// If the estimated distance to a change point is below this value (rad), the change point is searched for.
/// The search thus comes before a step can lead into the window.
const LOOK: f64 = 1.0;
/// No search is made if a known change point lies nearer than this multiple of the estimated distance.
/// The known change point is then the estimated change point or lies before it.
/// Later change points are searched for from the window of the known change point.
const NEXT: f64 = 1.3;
/// Two change points closer together than this (rad) count as one change point, at which several groups are singular.
const SAME: f64 = 1e-6;
/// Largest number of windows kept; the nearest windows are kept. If a discarded window is needed again, its change
/// point is searched for again.
const MOST_WINDOWS: usize = 8;
/// Largest number of remembered intervals without a change point. A motion of many small steps produces this many
/// intervals.
const MOST_CLEAR: usize = 256;

/// The change points found so far in a mechanism with one driving link.
#[derive(Debug)]
pub(super) struct Passing {
    /// Ratio of the windows' half width to the usual half width.
    share: f64,
    windows: Vec<Window>,
    /// Intervals of the driving link's angle (rad) in which a search found no change point: group, direction of the
    /// search, ends.
    clear: Vec<(GroupId, f64, [f64; 2])>,
    /// The window that contains the last pose; `None` if the pose lies outside all windows.
    inside: Option<usize>,
    motions: Vec<Motion>,
    /// Ends of windows from which the next change point has already been searched for.
    looked: Vec<f64>,
    /// Angle of the last pose outside all windows, and the determinants of the higher groups at this pose.
    last: (f64, Vec<Option<f64>>),
}

impl Passing {
    /// Starts without a known change point.
    /// `share` is the ratio of the windows' half widths to the usual half widths.
    /// The difference between two runs with different ratios shows the remaining error of the windows.
    pub(super) fn new(share: f64) -> Self {
        Passing {
            share,
            windows: Vec::new(),
            clear: Vec::new(),
            inside: None,
            motions: Vec::new(),
            looked: Vec::new(),
            last: (f64::NAN, Vec::new()),
        }
    }

    /// The window that contains the last placed pose; `None` if the pose lies outside all windows.
    pub(super) fn inside(&self) -> Option<&Window> {
        self.inside.map(|index| &self.windows[index])
    }

    /// Places the mechanism with its driving link at the angle `to`.
    /// The last pose is at the angle `from`, which may differ from `to` by at most the largest step of `turns.rs`.
    /// In a window the pose comes from the window, and the plan is not used.
    pub(super) fn place(
        &mut self,
        [from, to]: [f64; 2],
        plan: &mut SolutionPlan,
        motions: &mut [Motion],
    ) -> Result<(), OutOfReach> {
        if self.enter(to, plan, motions) {
            return Ok(());
        }
        let mut from = from;
        // If the step leaves or passes over a window, continue from the window's outermost node on the side of `to`, on
        // the branch of this node.
        while let Some(index) = self.left([from, to]) {
            let window = &self.windows[index];
            let [end, before] = window.ends(to);
            plan.clone_from(&end.plan);
            motions.copy_from_slice(&end.motions);
            from = window.at + end.offset;
            let place = (window.at + before.offset, window.determinants(before));
            if self.looked.contains(&from) {
                break;
            }
            // Search from the end of the window, because the next change point may be nearer than a step.
            let old = (self.looked.len() + 1).saturating_sub(MOST_CLEAR);
            self.looked.drain(..old);
            self.looked.push(from);
            self.last = place;
            self.look(from, plan, motions)?;
            if self.enter(to, plan, motions) {
                return Ok(());
            }
        }
        self.inside = None;
        plan.positions(&[to], motions)?;
        self.look(to, plan, motions)?;
        self.enter(to, plan, motions);
        Ok(())
    }

    /// The window that a step between two angles leaves or passes over. If the step leaves or passes over several
    /// windows, returns the window nearest to the end of the step.
    fn left(&self, [from, to]: [f64; 2]) -> Option<usize> {
        let over =
            |window: &Window| (from - window.at) * (to - window.at) <= 0.0 || (from - window.at).abs() < window.reach;
        let all = self.windows.iter().enumerate().filter(|(_, window)| over(window));
        all.min_by(|(_, a), (_, b)| (a.at - to).abs().total_cmp(&(b.at - to).abs())).map(|(index, _)| index)
    }

    /// If a window contains this angle, computes the positions of all links from that window. Otherwise returns
    /// `false`.
    fn enter(&mut self, angle: f64, plan: &SolutionPlan, motions: &mut [Motion]) -> bool {
        self.inside = self.windows.iter().position(|window| (angle - window.at).abs() < window.reach);
        if let Some(window) = self.inside() {
            window.positions(angle, motions);
            plan.turn_drivers(&[angle], motions);
        }
        self.inside.is_some()
    }

    /// Searches for change points near a pose that has just been placed.
    fn look(&mut self, angle: f64, plan: &mut SolutionPlan, motions: &[Motion]) -> Result<(), OutOfReach> {
        self.motions.clear();
        self.motions.extend_from_slice(motions);
        plan.velocities(&[1.0], &mut self.motions);
        let (before, dets) = &self.last;
        let slope = |group: GroupId| {
            // For a higher group, the determinant is extrapolated linearly from the last two poses.
            let (now, last) = (plan.determinant(group)?.abs(), dets.get(group.index()).copied().flatten()?.abs());
            (angle != *before).then(|| now * (angle - before) / (now - last))
        };
        let near = |(group, clearance): (GroupId, Option<SingularityDistance>)| {
            let ahead = match clearance {
                Some(SingularityDistance { sine, rate }) => -sine / rate,
                None => -slope(group)?,
            };
            (ahead.abs() < LOOK).then_some((group, ahead))
        };
        let found: Vec<(GroupId, f64)> =
            plan.steps().ids().zip(plan.clearances(&self.motions)).filter_map(near).collect();
        self.last = (angle, plan.steps().ids().map(|group| plan.determinant(group)).collect());
        // Forget the oldest intervals. If a forgotten interval is needed again, the search for change points in it is
        // repeated.
        let old = self.clear.len().saturating_sub(MOST_CLEAR);
        self.clear.drain(..old);
        for (group, ahead) in found {
            let known = self.windows.iter().any(|window| {
                let from = window.at - angle;
                from * ahead > 0.0 && from.abs() < NEXT * ahead.abs()
            });
            let is_clear = |&(own, way, [low, high]): &(GroupId, f64, [f64; 2])| {
                own == group && way == ahead.signum() && low <= angle && angle <= high
            };
            if known || self.clear.iter().any(is_clear) {
                continue;
            }
            let start = search::Start { angle, plan, motions };
            match search::change_point(&start, group, ahead) {
                Ok(at) if self.windows.iter().any(|window| (window.at - at).abs() < SAME) => {
                    self.clear.push((group, ahead.signum(), [angle.smaller(at), angle.larger(at)]));
                }
                Ok(at) => self.keep(Window::around(at, group, &start, self.share)?, angle),
                Err(end) => {
                    let ends = [angle.smaller(end), angle.larger(end)];
                    self.clear.push((group, ahead.signum(), ends));
                }
            }
        }
        Ok(())
    }

    fn keep(&mut self, window: Window, angle: f64) {
        self.looked.retain(|end| (end - window.at).abs() > 2.0 * window.reach);
        self.windows.push(window);
        self.windows.sort_by(|a, b| (a.at - angle).abs().total_cmp(&(b.at - angle).abs()));
        self.windows.truncate(MOST_WINDOWS);
    }
}

/// The error for reactions that grow without bound at a change point.
pub(super) fn unbounded(at: InputValue) -> Error {
    let message = sentences::this_is_a_change_point_and_towards(&at);
    let error = Error::new(ErrorKind::Numeric, message).at_input(at);
    error.help(WITHOUT_POLE)
}

/// Advice if reactions have a pole at the requested instant.
const WITHOUT_POLE: &str = sentences::LEAVE_THIS_VERY_INSTANT_OUT;

/// Advice for passing a pose that may be a change point.
pub(super) fn way_through(case: &Case) -> &'static str {
    match case.crank().passes() || !case.drives.further().is_empty() {
        // Either the case is already set to pass change points and has failed to pass this pose, or it has several
        // drives and cannot pass change points.
        true => sentences::LET_THE_GRID_END_BEFORE_IT,
        false => sentences::PASS_IT_WITH_THROUGH_SMOOTH,
    }
}
