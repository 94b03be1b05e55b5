//! Transmissions as Rapier joints: one constraint row along the line of action, realigned before every step.
//!
//! Rapier has no gear joint.
//! A joint between the two members locks the translation along the first line of action, at the point where the force
//! acts.
//! Line and point turn with the carrier, so they are set before every step.
//! The gap of the row is the change of q2 - f(q1) since the start, multiplied by the factor of the contact.

use super::{Mesh, Twin, joints, wide};
use crate::world::World;
use linkage::case::Case;
use linkage::math::{Vec2, rotated};
use linkage::mechanism::{Coordinate, Joint, LinkId, Transmission, TransmissionId};

impl Twin {
    /// Adds the transmissions of a case. The links are in the start pose.
    pub(super) fn mesh(&mut self, case: &Case) {
        for transmission in case.mechanism.transmissions() {
            let [first, second] = transmission.design.links.map(|link| self.bodies[link]);
            let joint = joints::along_a_line();
            let handle = self.world.impulse_joints.insert(first, second, joint, true);
            let phase = self.coupled(transmission);
            self.meshes.push(Mesh { transmission: transmission.clone(), handle, phase });
        }
    }

    /// The coordinates of the members of a transmission.
    fn members(&self, transmission: &Transmission) -> [f64; 2] {
        let slide = |joint: &Joint| {
            let [first, second] = [joint.first, joint.second];
            let axis = rotated(self.frames[first.link].direction, joint.axis_on(first.link).expect("the rack slides"));
            axis.dot(&(self.point(second) - self.point(first)))
        };
        let value = |of: Coordinate| match of {
            Coordinate::Angle(link) => self.angle(link),
            Coordinate::Slide(joint) => slide(&self.joints[joint.index()]),
        };
        let sum = |terms: &Vec<(Coordinate, f64)>| terms.iter().map(|&(of, sign)| sign * value(of)).sum();
        transmission.coordinates.each_ref().map(sum)
    }

    /// The difference q2 - f(q1) of a transmission.
    fn coupled(&self, transmission: &Transmission) -> f64 {
        let [q1, q2] = self.members(transmission);
        q2 - transmission.law(q1)[0]
    }

    /// Lays the rows of the transmissions along their lines of action in the present pose.
    pub(super) fn aim(&mut self) {
        for index in 0..self.meshes.len() {
            let Mesh { transmission, phase, handle } = &self.meshes[index];
            let contact = transmission.contact(self.members(transmission));
            let line = &contact.lines[0];
            let carrier = &self.frames[transmission.design.carrier];
            let direction = rotated(carrier.direction, line.direction);
            let foot = carrier.point(line.feet[0]);
            let gap = direction * (contact.factor * (self.coupled(transmission) - phase));
            let local = |link: LinkId, vector: Vec2| {
                let direction = self.frames[link].direction;
                rotated(Vec2::new(direction.x, -direction.y), vector)
            };
            let [first, second] = transmission.design.links;
            let anchors = [(first, foot), (second, foot + gap)]
                .map(|(link, place)| joints::vector(local(link, place - self.frames[link].origin)));
            let axes = [first, second].map(|link| joints::vector(local(link, direction)));
            let joint = self.world.impulse_joints.get_mut(*handle, true).expect("the transmission exists");
            joint.data.set_local_anchor1(anchors[0]).set_local_anchor2(anchors[1]);
            joint.data.set_local_axis1(axes[0]).set_local_axis2(axes[1]);
        }
    }

    /// Force in the first line of action (N), from the impulse of the last step.
    pub(super) fn read_transmitted(&self, transmission: TransmissionId) -> f64 {
        let mesh = &self.meshes[transmission.index()];
        let joint = self.world.impulse_joints.get(mesh.handle).expect("the transmission exists");
        -wide(joint.impulses[0]) / self.substep()
    }
}
