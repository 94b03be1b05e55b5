//! Side 1 through change points: where two branches of a group cross, the mechanism goes on along the one on which
//! velocities go on.
//!
//! Along this branch all positions and transfer functions are smooth functions of the driving link's angle.
//! Only the equations of the group are singular: its sine, or what it is for the dyad, passes through zero linearly,
//! and the sign that the closed form keeps is another one on the far side.
//! Around such an angle (a [`Window`]) nothing is calculated from the equations of the pose, but from polynomials
//! through poses on both sides of it.

mod forces;
mod search;
mod window;

use crate::assur::groups::{OutOfReach, Plan};
use linkage::error::{Error, ErrorKind};
use linkage::math::{KeepNan, Motion};
use window::Window;

/// Largest estimated distance (rad) at which a change point is looked for: before a step can lead into its window.
const LOOK: f64 = 1.0;
/// Windows that are kept, the nearest ones. After many turns the others are found again.
const MOST_WINDOWS: usize = 8;

/// The change points of a mechanism with one driving link, as far as they have been met.
#[derive(Debug)]
pub(super) struct Passing {
    /// Share of the usual half widths that windows have.
    share: f64,
    windows: Vec<Window>,
    /// Intervals of the driving link's angle (rad) in which a search in this direction has found nothing: group,
    /// direction, ends.
    clear: Vec<(usize, f64, [f64; 2])>,
    /// The window of the last pose, if it lies in one.
    inside: Option<usize>,
    motions: Vec<Motion>,
}

impl Passing {
    /// No change point met yet. Windows have this share of their usual half widths: two runs with different shares show
    /// the error that is left in them.
    pub(super) fn new(share: f64) -> Self {
        Passing { share, windows: Vec::new(), clear: Vec::new(), inside: None, motions: Vec::new() }
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
        plan: &mut Plan,
        motions: &mut [Motion],
    ) -> Result<(), OutOfReach> {
        if self.enter(to, plan, motions) {
            return Ok(());
        }
        // Out of a window, or over it: the branch of the nodes on that side.
        let left = self.windows.iter().filter(|window| {
            let over = (from - window.at) * (to - window.at) <= 0.0;
            over || (from - window.at).abs() <= window.reach
        });
        let nearest = left.min_by(|a, b| (a.at - to).abs().total_cmp(&(b.at - to).abs()));
        if let Some(window) = nearest {
            let node = window.end(to);
            plan.clone_from(&node.plan);
            motions.copy_from_slice(&node.motions);
        }
        self.inside = None;
        plan.positions(&[to], motions)?;
        self.look(to, plan, motions)?;
        self.enter(to, plan, motions);
        Ok(())
    }

    /// Places the mechanism by a window, if there is one at this angle.
    fn enter(&mut self, angle: f64, plan: &Plan, motions: &mut [Motion]) -> bool {
        self.inside = self.windows.iter().position(|window| (angle - window.at).abs() < window.reach);
        if let Some(window) = self.inside() {
            window.positions(angle, motions);
            plan.turn_drivers(&[angle], motions);
        }
        self.inside.is_some()
    }

    /// Looks for change points near a pose that has just been placed.
    fn look(&mut self, angle: f64, plan: &mut Plan, motions: &[Motion]) -> Result<(), OutOfReach> {
        self.motions.clear();
        self.motions.extend_from_slice(motions);
        plan.velocities(&[1.0], &mut self.motions);
        let near = |(group, clearance): (usize, Option<_>)| {
            let clearance: crate::assur::groups::Clearance = clearance?;
            let ahead = -clearance.sine / clearance.rate;
            (ahead.abs() < LOOK).then_some((group, ahead))
        };
        let found: Vec<(usize, f64)> = plan.clearances(&self.motions).enumerate().filter_map(near).collect();
        for (group, ahead) in found {
            let known = self.windows.iter().any(|window| {
                let from = window.at - angle;
                from * ahead > 0.0 && from.abs() < 2.0 * ahead.abs() + window.reach
            });
            let is_clear = |&(own, way, [low, high]): &(usize, f64, [f64; 2])| {
                own == group && way == ahead.signum() && low <= angle && angle <= high
            };
            if known || self.clear.iter().any(is_clear) {
                continue;
            }
            let start = search::Start { angle, plan, motions };
            match search::change_point(&start, group, ahead.signum()) {
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
        self.windows.push(window);
        self.windows.sort_by(|a, b| (a.at - angle).abs().total_cmp(&(b.at - angle).abs()));
        self.windows.truncate(MOST_WINDOWS);
    }
}

/// The error for reactions at a change point that grow without bound.
pub(super) fn unbounded(crank: f64) -> Error {
    let degrees = crank.to_degrees();
    let message = format!(
        "crank angle {degrees:.4} deg: this is a change point, and towards it reactions grow without bound: \
         they must do what the links no longer can"
    );
    let error = Error::new(ErrorKind::Numeric, message).at_crank(crank);
    error.help("leave this very instant out, or ask for positions, velocities and accelerations only")
}
