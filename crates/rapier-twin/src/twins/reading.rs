//! Converts impulses to forces.

use super::joints::Frame;
use super::{Twin, wide};
use crate::world::World;
use linkage::math::{Vec2, cross, rotated, turned};
use linkage::mechanism::{JointId, LinkId};

impl Twin {
    /// Stores points of action and axes of the joints to be read.
    /// Points and axes are interpolated between the stored frames and the present frames.
    /// `share` is the weight of the present frames.
    /// Rapier gives impulses in the axes at the start of the last substep. This instant lies between two poses that can
    /// be read.
    /// Between these poses, frames are assumed to move along a straight line, with errors of second order.
    /// The errors of the impulses themselves are of first order.
    pub(super) fn keep_frames(&mut self, share: f64) {
        for index in 0..self.cuts.len() {
            let joint = &self.cuts[index].joint;
            let sides = [joint.first, joint.second];
            let [first, second] = sides.map(|side| self.point(side));
            let direction = self.frames[joint.first.link].direction;
            let (axis, place) = match joint.axis_on(joint.first.link) {
                None => match self.cuts[index].steered {
                    Some((link, axis)) => (rotated(self.frames[link].direction, axis), first),
                    None => (direction, first),
                },
                Some(axis) => {
                    // In the direction of the free axis, the rows' point of action coincides with the point on the
                    // second body.
                    let normal = turned(rotated(direction, axis));
                    (rotated(direction, axis), second - normal * normal.dot(&(second - first)))
                }
            };
            let centre = |link: LinkId| self.point(linkage::mechanism::JointSide { link, local: self.centres[link] });
            let arms = [place - centre(joint.first.link), second - centre(joint.second.link)];
            let start = &mut self.cuts[index].start;
            *start = if share == 1.0 { Frame { axis, arms } } else { start.towards(Frame { axis, arms }, share) };
        }
    }

    pub(super) fn read_reaction(&self, joint: JointId) -> Option<(Vec2, f64)> {
        let cut = self.cuts.iter().find(|cut| cut.index == joint)?;
        let impulses = self.world.impulse_joints.get(cut.handle)?.impulses;
        let mut rows = [impulses[0], impulses[1], impulses[2]].map(wide);
        let Frame { axis, arms } = cut.start;
        let across = turned(axis);
        let inverse = [cut.joint.first.link, cut.joint.second.link].map(|link| self.inverse[link]);
        let turning =
            |of: [f64; 2], other: [f64; 2]| of[0] * other[0] * inverse[0][1] + of[1] * other[1] * inverse[1][1];
        let lever = |along: Vec2| arms.map(|arm| cross(arm, along));
        // Rapier makes a joint's rows orthogonal to each other only if the joint connects separate bodies. The impulses
        // of other joints are therefore not corrected.
        let is_orthogonal = self.multibodies.is_empty();
        let (force, moment) = match cut.joint.keeps_angle() {
            true => {
                if is_orthogonal {
                    // Rapier made the row across the axis orthogonal to the row that keeps the angle.
                    // The impulse of the row that keeps the angle is corrected for this orthogonalisation.
                    rows[2] -= rows[1] * turning(lever(across), [1.0; 2]) / turning([1.0; 2], [1.0; 2]);
                }
                (across * rows[1], rows[2])
            }
            false => {
                if is_orthogonal {
                    // Rapier made the second row orthogonal to the first row. The impulse of the first row is corrected
                    // for this orthogonalisation.
                    let mass = inverse[0][0] + inverse[1][0] + turning(lever(axis), lever(axis));
                    rows[0] -= rows[1] * turning(lever(axis), lever(across)) / mass;
                }
                (axis * rows[0] + across * rows[1], 0.0)
            }
        };
        // The impulse is that of the last substep, and acts on Rapier's first body.
        // The reaction is the force on the joint's second link, so its sign depends on the order of the bodies.
        let swapped = cut.steered.is_some_and(|(link, _)| link != cut.joint.first.link);
        let duration = if swapped { self.substep() } else { -self.substep() };
        Some((force / duration, moment / duration))
    }

    pub(super) fn read_torque(&self, drive: usize) -> f64 {
        let motor = &self.motors[drive];
        let joint = self.world.impulse_joints.get(motor.handle).expect("the motor exists");
        if joint.data.motor_axes.is_empty() {
            // For a motor that is off, Rapier keeps the impulse of its last active step, so the impulse is not read.
            return 0.0;
        }
        -wide(joint.data.motors[motor.axis as usize].impulse) / self.substep() * motor.sense
    }
}
