//! Reactions and driving moment from the engine's own motion: the equations of Newton and Euler of all links at once.
//!
//! Unknown are two components of every joint's reaction and the driving moment: the force of a revolute joint; of a prismatic one
//! the force across its axis, at the place on the second link, and the moment. For every link m (a - g) = sum of forces + loads
//! and J alpha = sum of moments about the mass centre + those of the loads.

use crate::case::Case;
use crate::drive::Wrench;
use crate::error::{Error, ErrorKind, Result};
use crate::math::dense::Lu;
use crate::math::{Vec2, cross, turned};
use crate::mechanism::EQUATIONS;
use crate::mechanism::Joint;
use crate::solver::State;

/// The linear system, reused from pose to pose.
#[derive(Debug)]
pub(super) struct NewtonEuler {
    matrix: Lu,
    unknown: Vec<f64>,
    /// Mass and moment of inertia of every link.
    masses: Vec<[f64; 2]>,
    loads: Vec<Wrench>,
    /// Share of the loads that is counted.
    load_share: f64,
}

impl NewtonEuler {
    pub(super) fn new(case: &Case) -> Self {
        let masses = case.mechanism.links().iter().map(|link| [link.mass, link.inertia]).collect();
        NewtonEuler::of(masses, 1.0)
    }

    /// The equations with other masses and moments of inertia, and with a share of the loads.
    pub(super) fn of(masses: Vec<[f64; 2]>, load_share: f64) -> Self {
        let n = 3 * (masses.len() - 1);
        let loads = vec![Wrench::ZERO; masses.len()];
        NewtonEuler { matrix: Lu::new(n), unknown: vec![0.0; n], masses, loads, load_share }
    }

    /// Fills in the forces and the driving moment of a state whose motion is known.
    pub(super) fn solve(&mut self, case: &Case, state: &mut State, t: f64) -> Result<()> {
        self.matrix.clear();
        for (index, joint) in case.mechanism.joints().iter().enumerate() {
            let column = 2 * index;
            let normal = normal(joint, state);
            for (side, sign) in [(joint.first, -1.0), (joint.second, 1.0)] {
                let Some(row) = (3 * side.link).checked_sub(3) else { continue };
                let motion = &state.motions[side.link];
                if let Some(normal) = normal {
                    let place = state.motions[joint.second.link].point(joint.second.local);
                    let arm = place - motion.point(case.mechanism.links()[side.link].mass_centre);
                    self.matrix.add(row, column, normal.x * sign);
                    self.matrix.add(row + 1, column, normal.y * sign);
                    self.matrix.add(row + 2, column, cross(arm, normal) * sign);
                    self.matrix.add(row + 2, column + 1, sign);
                } else {
                    let arm: Vec2 = motion.arm(side.local - case.mechanism.links()[side.link].mass_centre);
                    self.matrix.add(row, column, sign);
                    self.matrix.add(row + 1, column + 1, sign);
                    self.matrix.add(row + 2, column, -arm.y * sign);
                    self.matrix.add(row + 2, column + 1, arm.x * sign);
                }
            }
        }
        let first = EQUATIONS * case.mechanism.joints().len();
        for (index, drive) in case.drives().enumerate() {
            self.matrix.add(3 * drive.link - 1, first + index, 1.0);
        }
        case.loads_on(&state.motions, &state.angles, &mut self.loads);
        for (index, link) in case.mechanism.links().iter().enumerate().skip(1) {
            let motion = &state.motions[index];
            let [mass, inertia] = self.masses[index];
            let Wrench { force, moment } = self.loads[index];
            let inertial =
                (motion.point_acceleration(link.mass_centre) - case.gravity) * mass - force * self.load_share;
            let row = 3 * (index - 1);
            self.unknown[row] = inertial.x;
            self.unknown[row + 1] = inertial.y;
            self.unknown[row + 2] = inertia * motion.alpha - moment * self.load_share;
        }
        if !self.matrix.factor() {
            return Err(Error::new(
                ErrorKind::Numeric,
                format!("the reactions are not determined at t = {t:.6} s (dead point)"),
            )
            .help("shorten the grid to the crank angles before the dead point"));
        }
        self.matrix.solve(&mut self.unknown);
        for (index, joint) in case.mechanism.joints().iter().enumerate() {
            let (first, second) = (self.unknown[2 * index], self.unknown[2 * index + 1]);
            let reaction = match normal(joint, state) {
                None => (Vec2::new(first, second), 0.0),
                Some(normal) => (normal * first, second),
            };
            (state.forces[index], state.moments[index]) = reaction;
        }
        state.torques.copy_from_slice(&self.unknown[first..]);
        Ok(())
    }
}

/// Unit vector across the axis of a prismatic joint.
fn normal(joint: &Joint, state: &State) -> Option<Vec2> {
    Some(turned(state.motions[joint.first.link].arm(joint.axis_on(joint.first.link)?)))
}
