//! Reactions and driving moment from the engine's own motion: the equations of Newton and Euler of all links at once.
//!
//! Unknown are the force of every joint and the driving moment; for every link m (a - g) = sum of forces and
//! J alpha = sum of moments about the mass centre + loads.

use crate::case::Case;
use crate::error::{Error, ErrorKind, Result};
use crate::math::Vec2;
use crate::math::dense::Lu;
use crate::solver::State;

/// The linear system, reused from pose to pose.
#[derive(Debug)]
pub(super) struct NewtonEuler {
    matrix: Lu,
    unknown: Vec<f64>,
}

impl NewtonEuler {
    pub(super) fn new(case: &Case) -> Self {
        let n = 3 * (case.mechanism.links().len() - 1);
        NewtonEuler { matrix: Lu::new(n), unknown: vec![0.0; n] }
    }

    /// Fills in the forces and the driving moment of a state whose motion is known.
    pub(super) fn solve(&mut self, case: &Case, state: &mut State, t: f64) -> Result<()> {
        self.matrix.clear();
        for (index, joint) in case.mechanism.joints().iter().enumerate() {
            let column = 2 * index;
            for (side, sign) in [(joint.first, -1.0), (joint.second, 1.0)] {
                let Some(row) = (3 * side.link).checked_sub(3) else { continue };
                let motion = &state.motions[side.link];
                let arm: Vec2 = motion.arm(side.local - case.mechanism.links()[side.link].mass_centre);
                self.matrix.add(row, column, sign);
                self.matrix.add(row + 1, column + 1, sign);
                self.matrix.add(row + 2, column, -arm.y * sign);
                self.matrix.add(row + 2, column + 1, arm.x * sign);
            }
        }
        let last = self.unknown.len() - 1;
        self.matrix.add(3 * case.drive.link - 1, last, 1.0);
        for (index, link) in case.mechanism.links().iter().enumerate().skip(1) {
            let motion = &state.motions[index];
            let inertial = (motion.point_acceleration(link.mass_centre) - case.gravity) * link.mass;
            let row = 3 * (index - 1);
            self.unknown[row] = inertial.x;
            self.unknown[row + 1] = inertial.y;
            self.unknown[row + 2] = link.inertia * motion.alpha - case.load_moment(index, motion.omega);
        }
        if !self.matrix.factor() {
            return Err(Error::new(
                ErrorKind::Numeric,
                format!("the reactions are not determined at t = {t:.6} s (dead point)"),
            )
            .help("shorten the grid to the crank angles before the dead point"));
        }
        self.matrix.solve(&mut self.unknown);
        for (index, force) in state.forces.iter_mut().enumerate() {
            *force = Vec2::new(self.unknown[2 * index], self.unknown[2 * index + 1]);
        }
        state.torque = self.unknown[last];
        Ok(())
    }
}
