//! State of a link, and of the whole mechanism at one instant.

use linkage::case::Case;
use linkage::mechanism::{Joint, LinkId};

use super::numbers::{CaseNumbers, JointNumbers};
use super::scalar::Scalar;
use super::vector::Vector;

/// Motion of a link's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame<S> {
    pub(crate) origin: Vector<S>,
    /// Direction of the frame's x axis.
    pub(crate) direction: Vector<S>,
    pub(crate) omega: S,
    pub(crate) alpha: S,
    pub(crate) velocity: Vector<S>,
    pub(crate) acceleration: Vector<S>,
}

impl<S: Scalar> Frame<S> {
    pub(crate) const REST: Frame<S> = Frame {
        origin: Vector::ZERO,
        direction: Vector::X,
        omega: S::ZERO,
        alpha: S::ZERO,
        velocity: Vector::ZERO,
        acceleration: Vector::ZERO,
    };

    /// Vector from the frame's origin to a point of the link, in world axes.
    pub(crate) fn arm(&self, local: Vector<S>) -> Vector<S> {
        local.rotated(self.direction)
    }

    pub(crate) fn point(&self, local: Vector<S>) -> Vector<S> {
        self.origin + self.arm(local)
    }

    pub(crate) fn point_velocity(&self, local: Vector<S>) -> Vector<S> {
        self.velocity + self.arm(local).turned() * self.omega
    }

    pub(crate) fn point_acceleration(&self, local: Vector<S>) -> Vector<S> {
        let arm = self.arm(local);
        self.acceleration + arm.turned() * self.alpha - arm * (self.omega * self.omega)
    }
}

/// A force (N), and a moment about the world's origin (N m).
pub(crate) type Wrench<S> = (Vector<S>, S);

/// The whole mechanism at one instant.
#[derive(Clone, Debug)]
pub struct Snapshot<S> {
    pub(crate) frames: Vec<Frame<S>>,
    /// Angle of every link, with whole turns.
    pub(crate) angles: Vec<S>,
    /// Force that the first link exerts on the second link in every joint.
    pub(crate) forces: Vec<Vector<S>>,
    /// Moment that the first link exerts on the second link in every joint, about the joint's point on the second link.
    pub(crate) moments: Vec<S>,
    /// Moment or force of every drive.
    pub(crate) efforts: Vec<S>,
    /// Resultant of all loads on the ground.
    pub(crate) on_ground: Wrench<S>,
    /// Coordinate of the first drive. The coordinate of a crank is its world angle, unwrapped.
    pub(crate) crank: S,
    /// Time of the instant (s).
    pub time: S,
}

impl<S: Scalar> Snapshot<S> {
    pub(crate) fn at_rest(case: &Case) -> Snapshot<S> {
        let (links, joints) = (case.mechanism.links().len(), case.mechanism.joints().len());
        Snapshot {
            frames: vec![Frame::REST; links],
            angles: vec![S::ZERO; links],
            forces: vec![Vector::ZERO; joints],
            moments: vec![S::ZERO; joints],
            efforts: vec![S::ZERO; case.drives.len()],
            on_ground: (Vector::ZERO, S::ZERO),
            crank: S::ZERO,
            time: S::ZERO,
        }
    }

    /// Weight and inertia force of a link, with the moment of both about the world's origin.
    pub(crate) fn inertia(&self, numbers: &CaseNumbers<S>, link: LinkId) -> Wrench<S> {
        let own = &numbers.links[link];
        let frame = &self.frames[link];
        let force = (numbers.gravity - frame.point_acceleration(own.centre)) * own.mass;
        let moment = frame.point(own.centre).cross(force) - own.inertia * frame.alpha;
        (force, moment)
    }
}

/// Slide along the first link's axis, with the first and second derivative of the slide.
/// The slide is computed from the motion of the second point relative to the rotating first link.
pub(crate) fn slide<S: Scalar>(instant: &Snapshot<S>, joint: &Joint, numbers: &JointNumbers<S>) -> [S; 3] {
    let [first, second] = [joint.first.link, joint.second.link].map(|link| &instant.frames[link]);
    let axis = first.arm(numbers.guides.map_or(Vector::X, |[axis, _]| axis));
    let [one, other] = numbers.places;
    let gap = second.point(other) - first.point(one);
    let gap_rate = second.point_velocity(other) - first.point_velocity(one);
    let gap_second = second.point_acceleration(other) - first.point_acceleration(one);
    let (omega, alpha, two) = (first.omega, first.alpha, S::of(2.0));
    // The axis rotates with the first link, so the derivatives of the dot product of axis and gap also contain
    // derivatives of the axis.
    let turned = axis.turned();
    let second_rate =
        axis.dot(gap_second) + two * omega * turned.dot(gap_rate) + (turned * alpha - axis * (omega * omega)).dot(gap);
    [axis.dot(gap), axis.dot(gap_rate) + omega * turned.dot(gap), second_rate]
}
