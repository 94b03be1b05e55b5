//! Side 2 through change points: where the determinant of a block passes through zero although the mechanism goes on,
//! it takes the branch on which velocities go on.
//!
//! The way is followed over the crank's angle, with the first and second derivatives of all coordinates by it.
//! Around a change point (a [`Window`]) no system of equations is solved: the coordinates are an osculating polynomial
//! through poses on both sides, and velocities and accelerations follow by its derivatives.
//! See docs/numerics/change_points.md.

mod multipliers;
mod osculating;
mod reading;
mod search;
mod spot;
mod window;

use super::steps::{HALVINGS, TRACKING_STEP};
use super::system::System;
use crate::sentences;
use linkage::error::Result;
use linkage::math::KeepNan;
use spot::{Spot, place, walked};
use window::Window;

/// Largest estimated distance (rad) at which a change point is looked for.
const LOOK: f64 = 0.8;
/// Turn of the crank (rad) that shows the slope of the determinants at the start.
const PROBE: f64 = 1e-4;
/// A known change point up to this multiple of the estimated distance is the one that is meant, or comes before it:
/// then what lies behind is looked for from there.
const NEXT: f64 = 1.3;
/// Distance (rad) up to which two change points are one, at which several groups are singular.
const SAME: f64 = 1e-6;
/// Windows that are kept, the nearest ones.
const MOST_WINDOWS: usize = 8;
/// Number of intervals without a change point that are remembered: a motion of many small steps finds as many.
const MOST_CLEAR: usize = 256;

/// The way of a mechanism with one driving link, and its change points as far as they have been met.
#[derive(Clone, Debug)]
pub(super) struct Passing {
    pub(super) spot: Spot,
    /// Share of the usual half widths that windows have.
    pub(super) share: f64,
    windows: Vec<Window>,
    /// Intervals of the crank's angle in which a search of a block in this direction has found nothing.
    clear: Vec<(usize, f64, [f64; 2])>,
    inside: Option<usize>,
}

impl Passing {
    /// The way from the present pose of a system whose Jacobian is factored there.
    pub(super) fn from(system: &mut System) -> Self {
        Passing { spot: spot::spot(system), share: 1.0, windows: Vec::new(), clear: Vec::new(), inside: None }
    }

    /// The window of the last pose, if it lies in one.
    pub(super) fn inside(&self) -> Option<&Window> {
        self.inside.map(|index| &self.windows[index])
    }

    /// Follows the way to the crank's angle `target` (rad).
    pub(super) fn travel(&mut self, system: &mut System, target: f64) -> Result<()> {
        if self.spot.shares.is_empty() {
            self.begin(system)?;
        }
        let mut step = TRACKING_STEP;
        while !self.enter(target) {
            self.leave(target);
            let left = target - self.spot.angle;
            let to = if left.abs() <= step { target } else { self.spot.angle + step.copysign(left) };
            match walked(system, &self.spot, to) {
                Ok(spot) => {
                    let before = std::mem::replace(&mut self.spot, spot);
                    self.look(system, &before)?;
                    step = (2.0 * step).smaller(TRACKING_STEP);
                    // A dead point at the very target shows only here.
                    if to == target && !self.enter(target) {
                        place(system, &self.spot)?;
                        return system.check_singular();
                    }
                }
                Err(error) if step <= TRACKING_STEP * 0.5f64.powi(HALVINGS as i32) => return Err(error),
                Err(_) => step = 0.5 * step.smaller(left.abs()),
            }
        }
        system.inputs[0].value = target;
        system.q.copy_from_slice(&self.spot.q);
        Ok(())
    }

    /// The slopes of the determinants at the first pose.
    fn begin(&mut self, system: &mut System) -> Result<()> {
        self.spot.shares = system.jacobian.shares().collect();
        // The change point may lie between, on either side.
        let probes = [PROBE, -PROBE, 0.01 * PROBE, -0.01 * PROBE];
        let mut found = probes.iter().map(|probe| walked(system, &self.spot, self.spot.angle + probe));
        let before = match found.find(Result::is_ok) {
            Some(before) => before?,
            None => walked(system, &self.spot, self.spot.angle + PROBE)?,
        };
        self.look(system, &before)?;
        place(system, &self.spot)
    }

    /// Places the mechanism by a window, if there is one at this angle.
    fn enter(&mut self, angle: f64) -> bool {
        self.inside = self.windows.iter().position(|window| (angle - window.at).abs() < window.reach);
        if let Some(index) = self.inside {
            self.windows[index].put(angle, &mut self.spot);
        }
        self.inside.is_some()
    }

    /// Out of a window, or over it, towards an angle: on from its last pose on that side.
    fn leave(&mut self, target: f64) {
        let from = self.spot.angle;
        let over = |window: &&Window| {
            (from - window.at) * (target - window.at) <= 0.0 || (from - window.at).abs() < window.reach
        };
        let nearest =
            self.windows.iter().filter(over).min_by(|a, b| (a.at - target).abs().total_cmp(&(b.at - target).abs()));
        if let Some(window) = nearest {
            self.spot.clone_from(window.end(target));
        }
    }

    /// Looks for change points near the present pose; `before` is one near it.
    fn look(&mut self, system: &mut System, before: &Spot) -> Result<()> {
        let turned = self.spot.angle - before.angle;
        if turned == 0.0 {
            return Ok(());
        }
        // What is forgotten is only searched once more.
        let old = self.clear.len().saturating_sub(MOST_CLEAR);
        self.clear.drain(..old);
        for block in 0..self.spot.shares.len() {
            let share = self.spot.shares[block];
            let ahead = -share * turned / (share - before.shares[block]);
            if !(ahead.abs() < LOOK) {
                continue;
            }
            let angle = self.spot.angle;
            let known = self.windows.iter().any(|window| {
                let from = window.at - angle;
                from * ahead > 0.0 && from.abs() < NEXT * ahead.abs()
            });
            let is_clear = |&(own, way, [low, high]): &(usize, f64, [f64; 2])| {
                own == block && way == ahead.signum() && low <= angle && angle <= high
            };
            if known || self.clear.iter().any(is_clear) {
                continue;
            }
            match search::change_point(system, &self.spot, block, ahead) {
                Ok(at) if self.windows.iter().any(|window| (window.at - at).abs() < SAME) => {
                    self.clear.push((block, ahead.signum(), [angle.smaller(at), angle.larger(at)]));
                }
                Ok(at) => {
                    let window = Window::around(system, &self.spot, [at, self.share], block)?;
                    self.windows.push(window);
                    self.windows.sort_by(|a, b| (a.at - angle).abs().total_cmp(&(b.at - angle).abs()));
                    self.windows.truncate(MOST_WINDOWS);
                }
                Err(end) => {
                    self.clear.push((block, ahead.signum(), [angle.smaller(end), angle.larger(end)]));
                }
            }
        }
        Ok(())
    }
}

/// The way out where reactions have a pole.
const WITHOUT_POLE: &str = sentences::LEAVE_THIS_VERY_INSTANT_OUT;
