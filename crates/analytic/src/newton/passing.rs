//! How side 2 passes change points, where the determinant of a block passes through zero but the mechanism moves on.
//! At a change point, side 2 follows the branch with continuous velocities.
//!
//! The path is followed as a function of the crank angle, with the first and second derivatives of all coordinates with
//! respect to this angle.
//! In a [`Window`] around a change point, no system of equations is solved.
//! Instead, an osculating polynomial through poses on both sides gives the coordinates. The polynomial's derivatives
//! give velocities and accelerations.
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

/// If the estimated distance to a change point is below this value (rad), the change point is searched for.
const LOOK: f64 = 0.8;
/// At the start, the slopes of the determinants are computed over this rotation of the crank (rad).
const PROBE: f64 = 1e-4;
/// No search is made if a known change point lies nearer than this multiple of the estimated distance.
/// The known change point is then the estimated change point or lies before it.
/// Later change points are searched for from the window of the known change point.
const NEXT: f64 = 1.3;
/// Two change points closer together than this (rad) count as one change point, at which several groups are singular.
const SAME: f64 = 1e-6;
/// Largest number of windows kept; the nearest windows are kept.
const MOST_WINDOWS: usize = 8;
/// Largest number of remembered intervals without a change point. A motion of many small steps produces this many
/// intervals.
const MOST_CLEAR: usize = 256;

/// The path of a mechanism with one driving link, and the change points found so far.
#[derive(Clone, Debug)]
pub(super) struct Passing {
    pub(super) spot: Spot,
    /// Ratio of the windows' half width to the usual half width.
    pub(super) share: f64,
    windows: Vec<Window>,
    /// Intervals of the crank angle in which a search found no change point: block, direction of the search, ends.
    clear: Vec<(usize, f64, [f64; 2])>,
    inside: Option<usize>,
}

impl Passing {
    /// The path from the present pose of a system. The system's Jacobian must be factored at this pose.
    pub(super) fn from(system: &mut System) -> Self {
        Passing { spot: spot::spot(system), share: 1.0, windows: Vec::new(), clear: Vec::new(), inside: None }
    }

    /// The window that contains the last pose; `None` if the pose lies outside all windows.
    pub(super) fn inside(&self) -> Option<&Window> {
        self.inside.map(|index| &self.windows[index])
    }

    /// Follows the path to the crank angle `target` (rad).
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
                    // Only this check finds a dead point exactly at the target.
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

    /// Computes the slopes of the determinants at the first pose.
    fn begin(&mut self, system: &mut System) -> Result<()> {
        self.spot.shares = system.jacobian.shares().collect();
        // If a change point lies within a probe on one side, the next probe is used.
        let probes = [PROBE, -PROBE, 0.01 * PROBE, -0.01 * PROBE];
        let mut found = probes.iter().map(|probe| walked(system, &self.spot, self.spot.angle + probe));
        let before = match found.find(Result::is_ok) {
            Some(before) => before?,
            None => walked(system, &self.spot, self.spot.angle + PROBE)?,
        };
        self.look(system, &before)?;
        place(system, &self.spot)
    }

    /// If a window contains this angle, takes the pose from that window. Otherwise returns `false`.
    fn enter(&mut self, angle: f64) -> bool {
        self.inside = self.windows.iter().position(|window| (angle - window.at).abs() < window.reach);
        if let Some(index) = self.inside {
            self.windows[index].put(angle, &mut self.spot);
        }
        self.inside.is_some()
    }

    /// Leaves or passes over a window towards the angle `target`: the path continues from the window's last pose on the
    /// side of `target`.
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

    /// Searches for change points near the present pose; `before` is a pose near the present one.
    fn look(&mut self, system: &mut System, before: &Spot) -> Result<()> {
        let turned = self.spot.angle - before.angle;
        if turned == 0.0 {
            return Ok(());
        }
        // Forget the oldest intervals. If a forgotten interval is needed again, the search for change points in it is
        // repeated.
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

/// Advice if reactions have a pole at the requested instant.
const WITHOUT_POLE: &str = sentences::LEAVE_THIS_VERY_INSTANT_OUT;
