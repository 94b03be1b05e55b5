//! Converts impulses to forces.

use super::{Twin, reactions, wide};
use crate::world::World;
use linkage::math::{Vec2, rotated, turned};
use linkage::mechanism::{JointId, LinkId};
use rapier_reactions::{JointRows, JointType};

impl Twin {
    /// Stores points of action and axes of the joints to be read.
    /// Points and axes are interpolated between the stored frames and the present frames.
    /// `share` is the weight of the present frames.
    /// Rapier gives the components of impulses along the axes that the joints had at the start of the last substep.
    /// This instant lies between two poses that can be read.
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
            let (start, rows) = (&mut self.cuts[index].start, JointRows { axis, arms });
            *start = if share == 1.0 { rows } else { start.towards(rows, share) };
        }
    }

    pub(super) fn read_reaction(&self, joint: JointId) -> Option<(Vec2, f64)> {
        let cut = self.cuts.iter().find(|cut| cut.index == joint)?;
        let impulses = self.world.impulse_joints.get(cut.handle)?.impulses;
        let rows = [impulses[0], impulses[1], impulses[2]].map(wide);
        let links = [cut.joint.first.link, cut.joint.second.link];
        let separate = self.multibodies.is_empty().then(|| links.map(|link| self.inverse[link]));
        let joint_type = if cut.joint.keeps_angle() { JointType::Prismatic } else { JointType::Revolute };
        let (impulse, turning) = cut.start.impulse(joint_type, rows, separate);
        // The impulse is that of the last substep, and acts on Rapier's first body.
        // The reaction is the force on the joint's second link, so its sign depends on the order of the bodies.
        let swapped = cut.steered.is_some_and(|(link, _)| link != cut.joint.first.link);
        let duration = if swapped { self.substep() } else { -self.substep() };
        Some((impulse / duration, turning / duration))
    }

    pub(super) fn read_torque(&self, drive: usize) -> f64 {
        let motor = &self.motors[drive];
        let joint = self.world.impulse_joints.get(motor.handle).expect("the motor exists");
        reactions::motor_effort(joint, motor.axis, self.substep()) * motor.sense
    }
}
