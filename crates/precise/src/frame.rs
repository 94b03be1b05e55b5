//! State of a link, and of the whole mechanism at one instant.

use linkage::case::Case;
use linkage::math::Vec2;
use linkage::mechanism::LinkId;

use super::Long;
use super::vector::Vector;

/// Motion of a link's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) origin: Vector,
    /// Direction of the frame's x axis.
    pub(crate) direction: Vector,
    pub(crate) omega: Long,
    pub(crate) alpha: Long,
    pub(crate) velocity: Vector,
    pub(crate) acceleration: Vector,
}

impl Frame {
    pub(crate) const REST: Frame = Frame {
        origin: Vector::ZERO,
        direction: Vector::X,
        omega: Long::ZERO,
        alpha: Long::ZERO,
        velocity: Vector::ZERO,
        acceleration: Vector::ZERO,
    };

    /// Vector from the frame's origin to a point of the link, in world axes.
    pub(crate) fn arm(&self, local: Vec2) -> Vector {
        Vector::of(local).rotated(self.direction)
    }

    pub(crate) fn point(&self, local: Vec2) -> Vector {
        self.origin + self.arm(local)
    }

    pub(crate) fn point_velocity(&self, local: Vec2) -> Vector {
        self.velocity + self.arm(local).turned() * self.omega
    }

    pub(crate) fn point_acceleration(&self, local: Vec2) -> Vector {
        let arm = self.arm(local);
        self.acceleration + arm.turned() * self.alpha - arm * (self.omega * self.omega)
    }
}

/// The whole mechanism at one instant.
#[derive(Clone, Debug)]
pub(crate) struct Snapshot {
    pub(crate) frames: Vec<Frame>,
    /// Force that the first link exerts on the second link in every joint.
    pub(crate) forces: Vec<Vector>,
    /// Moment that the first link exerts on the second link in every joint, about the joint's point on the second link.
    pub(crate) moments: Vec<Long>,
    pub(crate) torque: Long,
    /// World angle of the crank, unwrapped.
    pub(crate) crank: Long,
}

impl Snapshot {
    pub(crate) fn at_rest(case: &Case) -> Snapshot {
        let joints = case.mechanism.joints().len();
        Snapshot {
            frames: vec![Frame::REST; case.mechanism.links().len()],
            forces: vec![Vector::ZERO; joints],
            moments: vec![Long::ZERO; joints],
            torque: Long::ZERO,
            crank: Long::ZERO,
        }
    }

    /// Weight and inertia of a link, as a force at the world's origin and the moment about the origin.
    pub(crate) fn inertia(&self, case: &Case, link: LinkId) -> (Vector, Long) {
        let own = &case.mechanism.links()[link];
        let frame = &self.frames[link];
        let mass = Long::of(own.mass);
        let force = (Vector::of(case.gravity) - frame.point_acceleration(own.mass_centre)) * mass;
        let moment = frame.point(own.mass_centre).cross(force) - Long::of(own.inertia) * frame.alpha;
        (force, moment)
    }
}
