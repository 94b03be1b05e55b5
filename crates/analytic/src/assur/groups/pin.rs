//! Outer revolute pair of a dyad: a link that turns about a point of one that is known.

use linkage::math::{Motion, Vec2, turned};
use linkage::mechanism::{Joint, Side};

/// A link on its pin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pin {
    pub(super) link: usize,
    /// The known link and the joint's place on it.
    base: Side,
    /// The joint's place on the turning link.
    pub(super) own: Vec2,
}

impl Pin {
    pub(super) fn of(joint: &Joint, link: usize) -> Self {
        Pin { link, base: joint.other(link), own: joint.on(link).expect("the joint is on the link") }
    }

    /// World place of the pin.
    #[inline]
    pub(super) fn place(&self, motions: &[Motion]) -> Vec2 {
        motions[self.base.link].point(self.base.local)
    }

    /// Velocity of the pin.
    #[inline]
    pub(super) fn velocity(&self, motions: &[Motion]) -> Vec2 {
        motions[self.base.link].point_velocity(self.base.local)
    }

    /// Acceleration of the pin.
    #[inline]
    pub(super) fn acceleration(&self, motions: &[Motion]) -> Vec2 {
        motions[self.base.link].point_acceleration(self.base.local)
    }

    /// Places the turning link by its direction.
    #[inline]
    pub(super) fn put(&self, direction: Vec2, motions: &mut [Motion]) {
        let place = self.place(motions);
        let motion = &mut motions[self.link];
        motion.direction = direction;
        motion.origin = place - motion.arm(self.own);
    }

    /// Moves the turning link by its angular velocity.
    #[inline]
    pub(super) fn put_velocity(&self, omega: f64, motions: &mut [Motion]) {
        let velocity = self.velocity(motions);
        let motion = &mut motions[self.link];
        motion.omega = omega;
        motion.velocity = velocity - turned(motion.arm(self.own)) * omega;
    }

    /// Accelerates the turning link by its angular acceleration.
    #[inline]
    pub(super) fn put_acceleration(&self, alpha: f64, motions: &mut [Motion]) {
        let acceleration = self.acceleration(motions);
        let motion = &mut motions[self.link];
        let arm = motion.arm(self.own);
        motion.alpha = alpha;
        motion.acceleration = acceleration - turned(arm) * alpha + arm * (motion.omega * motion.omega);
    }
}
