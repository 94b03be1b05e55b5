//! Side 1 through change points: where two branches of a group cross, the mechanism goes on along the one on which
//! velocities go on.
//!
//! Along this branch all positions and transfer functions are smooth functions of the driving link's angle.
//! Only the equations of the group are singular: its sine, or what it is for the dyad, passes through zero linearly,
//! and the sign that the closed form keeps is another one on the far side.
//! Around such an angle (a [`Window`]) nothing is calculated from the equations of the pose, but from polynomials
//! through poses on both sides of it.
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

/// Largest estimated distance (rad) at which a change point is looked for: before a step can lead into its window.
const LOOK: f64 = 1.0;
/// A known change point up to this multiple of the estimated distance is the one that is meant, or comes before it:
/// then what lies behind is looked for from there.
const NEXT: f64 = 1.3;
/// Distance (rad) up to which two change points are one, at which several groups are singular.
const SAME: f64 = 1e-6;
/// Windows that are kept, the nearest ones. After many turns the others are found again.
const MOST_WINDOWS: usize = 8;
/// Number of intervals without a change point that are remembered: a motion of many small steps finds as many.
const MOST_CLEAR: usize = 256;

/// The change points of a mechanism with one driving link, as far as they have been met.
#[derive(Debug)]
pub(super) struct Passing {
    /// Share of the usual half widths that windows have.
    share: f64,
    windows: Vec<Window>,
    /// Intervals of the driving link's angle (rad) in which a search in this direction has found nothing: group,
    /// direction, ends.
    clear: Vec<(GroupId, f64, [f64; 2])>,
    /// The window of the last pose, if it lies in one.
    inside: Option<usize>,
    motions: Vec<Motion>,
    /// Ends of windows from which the next change point has been looked for.
    looked: Vec<f64>,
    /// Angle of the last pose outside of windows, and the determinants of higher groups there.
    last: (f64, Vec<Option<f64>>),
}

impl Passing {
    /// No change point met yet. Windows have this share of their usual half widths: two runs with different shares show
    /// the error that is left in them.
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

    /// The window of the last pose placed, if it lies in one.
    pub(super) fn inside(&self) -> Option<&Window> {
        self.inside.map(|index| &self.windows[index])
    }

    /// Places the mechanism with its driving link at the angle `to`, from the last pose at `from`, at most a step away.
    /// In a window the plan itself is not placed.
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
        // Out of windows, or over them: on along the branch of the nodes on that side.
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
            // The next change point may be nearer than a step.
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

    /// The window that a way leaves or passes over, the nearest one to its end.
    fn left(&self, [from, to]: [f64; 2]) -> Option<usize> {
        let over =
            |window: &Window| (from - window.at) * (to - window.at) <= 0.0 || (from - window.at).abs() < window.reach;
        let all = self.windows.iter().enumerate().filter(|(_, window)| over(window));
        all.min_by(|(_, a), (_, b)| (a.at - to).abs().total_cmp(&(b.at - to).abs())).map(|(index, _)| index)
    }

    /// Places the mechanism by a window, if there is one at this angle.
    fn enter(&mut self, angle: f64, plan: &SolutionPlan, motions: &mut [Motion]) -> bool {
        self.inside = self.windows.iter().position(|window| (angle - window.at).abs() < window.reach);
        if let Some(window) = self.inside() {
            window.positions(angle, motions);
            plan.turn_drivers(&[angle], motions);
        }
        self.inside.is_some()
    }

    /// Looks for change points near a pose that has just been placed.
    fn look(&mut self, angle: f64, plan: &mut SolutionPlan, motions: &[Motion]) -> Result<(), OutOfReach> {
        self.motions.clear();
        self.motions.extend_from_slice(motions);
        plan.velocities(&[1.0], &mut self.motions);
        let (before, dets) = &self.last;
        let slope = |group: GroupId| {
            // Of a higher group, the determinant's way from pose to pose.
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
        // What is forgotten is only searched once more.
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

/// The error for reactions at a change point that grow without bound.
pub(super) fn unbounded(at: InputValue) -> Error {
    let message = sentences::this_is_a_change_point_and_towards(&at);
    let error = Error::new(ErrorKind::Numeric, message).at_input(at);
    error.help(WITHOUT_POLE)
}

/// The way out where reactions have a pole.
const WITHOUT_POLE: &str = sentences::LEAVE_THIS_VERY_INSTANT_OUT;

/// The way through a pose that may be a change point.
pub(super) fn way_through(case: &Case) -> &'static str {
    match case.crank().passes() || !case.drives.further().is_empty() {
        // It is passed already, or there are several drives, with which none is passed.
        true => sentences::LET_THE_GRID_END_BEFORE_IT,
        false => sentences::PASS_IT_WITH_THROUGH_SMOOTH,
    }
}
