//! Equilibrium of all links: reactions of the joints and efforts of the drives.

use linkage::input::Input;
use linkage::mechanism::{GROUND, JointId, LinkId};

use super::equations::Whole;
use super::frame::{Snapshot, Wrench};
use super::loads::loads;
use super::scalar::Scalar;
use super::vector::Vector;

/// First of the three rows of a link: force x, force y, moment about the world's origin.
fn row(link: LinkId) -> usize {
    3 * (link.index() - 1)
}

/// Action of one of a joint's two unknowns on the joint's second link, for the value 1 of the unknown: the force, the
/// moment about the world's origin, and the joint's moment.
/// The joint's moment is a part of the moment about the origin.
type Unit<S> = (Vector<S>, S, S);

impl<S: Scalar> Whole<'_, S> {
    /// The actions of a joint's two unknowns on the joint's second link.
    fn reactions(&self, joint: JointId, at: &Snapshot<S>) -> [Unit<S>; 2] {
        let (own, numbers) = (&self.case.mechanism.joints()[joint], &self.numbers.joints[joint]);
        let place = at.frames[own.second.link].point(numbers.places[1]);
        let along = |force: Vector<S>| (force, place.cross(force), S::ZERO);
        match numbers.guides {
            None => [along(Vector::X), along(Vector::X.turned())],
            Some([axis, _]) => {
                let normal = at.frames[own.first.link].arm(axis).turned();
                [along(normal), (Vector::ZERO, S::ONE, S::ONE)]
            }
        }
    }

    /// The actions on a drive's links if the moment (N m) or force (N) of the drive is 1.
    fn effort(&self, drive: usize, at: &Snapshot<S>) -> Vec<(LinkId, Wrench<S>)> {
        let own = &self.numbers.drives[drive];
        let joint = &self.case.mechanism.joints()[own.joint];
        let ends = [(joint.second.link, S::ONE), (joint.first.link, -S::ONE)];
        match own.input {
            Input::Angle => vec![(own.link, (Vector::ZERO, S::ONE)), (GROUND, (Vector::ZERO, -S::ONE))],
            Input::Turn => ends.map(|(link, sign)| (link, (Vector::ZERO, sign))).to_vec(),
            Input::Slide => {
                let numbers = &self.numbers.joints[own.joint];
                let place = at.frames[joint.second.link].point(numbers.places[1]);
                let axis = numbers.guides.map_or(Vector::X, |[axis, _]| axis);
                let axis = at.frames[joint.first.link].arm(axis);
                ends.map(|(link, sign)| (link, (axis * sign, place.cross(axis) * sign))).to_vec()
            }
        }
    }

    /// Solves the equilibrium of all links. Each link has two force equations and a moment equation about the world's
    /// origin.
    /// `input` is the input of the first drive.
    pub(crate) fn forces(&self, instant: &mut Snapshot<S>, input: S) -> Option<()> {
        let joints = self.case.mechanism.joints();
        let count = 3 * (self.case.mechanism.links().len() - 1);
        let mut matrix = vec![vec![S::ZERO; count]; count];
        let mut put = |k: usize, link: LinkId, (force, moment): Wrench<S>| {
            if link != GROUND {
                for (part, value) in [force.x, force.y, moment].into_iter().enumerate() {
                    matrix[row(link) + part][k] = value;
                }
            }
        };
        for (index, joint) in joints.entries() {
            let unknowns = self.case.mechanism.rows(index);
            for (k, (force, moment, _)) in unknowns.zip(self.reactions(index, instant)) {
                put(k, joint.second.link, (force, moment));
                put(k, joint.first.link, (-force, -moment));
            }
        }
        let first = self.case.mechanism.equations();
        for drive in 0..self.numbers.drives.len() {
            for (link, wrench) in self.effort(drive, instant) {
                put(first + drive, link, wrench);
            }
        }
        let loads = loads(self.case, self.numbers, instant, input);
        instant.on_ground = loads[GROUND];
        let mut right = vec![S::ZERO; count];
        for link in self.case.mechanism.links().ids().skip(1) {
            let (force, moment) = instant.inertia(self.numbers, link);
            let (force, moment) = (force + loads[link].0, moment + loads[link].1);
            for (part, value) in [force.x, force.y, moment].into_iter().enumerate() {
                right[row(link) + part] = -value;
            }
        }
        let found = S::solution(&S::factors(matrix)?, &right);
        for index in joints.ids() {
            let unknowns = self.case.mechanism.rows(index);
            for (&value, (force, _, moment)) in found[unknowns].iter().zip(self.reactions(index, instant)) {
                instant.forces[index] = instant.forces[index] + force * value;
                instant.moments[index] = instant.moments[index] + moment * value;
            }
        }
        instant.efforts = found[first..].to_vec();
        Some(())
    }

    /// Force that joints, drives and loads exert on the ground, and the moment that they exert on the ground, about the
    /// world's origin.
    pub(crate) fn shaking(&self, instant: &Snapshot<S>) -> Wrench<S> {
        let (mut force, mut moment) = instant.on_ground;
        let mut add = |own: Wrench<S>| (force, moment) = (force + own.0, moment + own.1);
        for (index, joint) in self.case.mechanism.joints().entries() {
            let sign = match (joint.first.link, joint.second.link) {
                (GROUND, _) => -S::ONE,
                (_, GROUND) => S::ONE,
                _ => continue,
            };
            let place = self.numbers.joints[index].places[1];
            let place = instant.frames[joint.second.link].point(place);
            let own = instant.forces[index] * sign;
            add((own, place.cross(own) + instant.moments[index] * sign));
        }
        for (drive, effort) in instant.efforts.iter().enumerate() {
            for (link, (force, moment)) in self.effort(drive, instant) {
                if link == GROUND {
                    add((force * *effort, moment * *effort));
                }
            }
        }
        (force, moment)
    }
}
