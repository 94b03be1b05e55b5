//! Outer prismatic joint of a dyad: a link that slides on a known link and turns with it.

use linkage::math::{Motion, Vec2, cross, rotated, turned};
use linkage::mechanism::{Joint, JointSide, LinkId};

/// Direction of a frame whose unit vector `b` points along the world vector `a`: `a` times the conjugate of `b`, as
/// complex numbers.
#[inline]
pub(super) fn turn_between(a: Vec2, b: Vec2) -> Vec2 {
    Vec2::new(b.dot(&a), cross(b, a))
}

/// A link on its guide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guide {
    pub(super) link: LinkId,
    /// The guide's link and the position of the joint on it.
    pub(super) base: JointSide,
    /// The axis in the frame of the guide's link.
    axis: Vec2,
    /// The position of the joint on the sliding link.
    own: Vec2,
    /// Direction of the sliding link's frame in the frame of the guide's link.
    turn: Vec2,
}

impl Guide {
    pub(super) fn of(joint: &Joint, link: LinkId) -> Self {
        let base = joint.other(link);
        let axis = |on: LinkId| joint.axis_on(on).expect("the joint is prismatic and on the link");
        Guide {
            link,
            base,
            axis: axis(base.link),
            own: joint.on(link).expect("the joint is on the link"),
            turn: turn_between(axis(base.link), axis(link)),
        }
    }

    /// Unit vector of the axis in the world.
    #[inline]
    pub(super) fn axis(&self, motions: &[Motion]) -> Vec2 {
        motions[self.base.link].arm(self.axis)
    }

    /// Turns the sliding link with its guide.
    #[inline]
    pub(super) fn aim(&self, motions: &mut [Motion]) {
        motions[self.link].direction = rotated(motions[self.base.link].direction, self.turn);
    }

    /// World position of the point `local` of the sliding link at slide zero. [`Guide::aim`] must have been called.
    #[inline]
    pub(super) fn at_zero(&self, local: Vec2, motions: &[Motion]) -> Vec2 {
        motions[self.base.link].point(self.base.local) + motions[self.link].arm(local - self.own)
    }

    /// Places the point `local` of the sliding link at a world position.
    #[inline]
    pub(super) fn put(&self, local: Vec2, place: Vec2, motions: &mut [Motion]) {
        motions[self.link].origin = place - motions[self.link].arm(local);
    }

    /// Gives the sliding link the guide's angular velocity, and its point `local` the given velocity.
    #[inline]
    pub(super) fn put_velocity(&self, local: Vec2, velocity: Vec2, motions: &mut [Motion]) {
        let omega = motions[self.base.link].omega;
        let motion = &mut motions[self.link];
        motion.omega = omega;
        motion.velocity = velocity - turned(motion.arm(local)) * omega;
    }

    /// Gives the sliding link the guide's angular acceleration, and its point `local` the given acceleration.
    #[inline]
    pub(super) fn put_acceleration(&self, local: Vec2, acceleration: Vec2, motions: &mut [Motion]) {
        let alpha = motions[self.base.link].alpha;
        let motion = &mut motions[self.link];
        let arm = motion.arm(local);
        motion.alpha = alpha;
        motion.acceleration = acceleration - turned(arm) * alpha + arm * (motion.omega * motion.omega);
    }
}
