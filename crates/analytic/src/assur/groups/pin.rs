//! Outer revolute joint of a dyad: a link that turns about a point of a known link.

use super::bounds::Bounds;
use linkage::math::{Motion, Vec2, turned};
use linkage::mechanism::{Joint, JointSide, LinkId};

/// A link on its pin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pin {
    pub(super) link: LinkId,
    /// The known link and the position of the joint on it.
    base: JointSide,
    /// The position of the joint on the turning link.
    pub(super) own: Vec2,
}

impl Pin {
    pub(super) fn of(joint: &Joint, link: LinkId) -> Self {
        Pin { link, base: joint.other(link), own: joint.on(link).expect("the joint is on the link") }
    }

    /// Bounds of the pin's speed and acceleration; `None` if the known link has no bounds.
    pub(super) fn rates(&self, links: &Bounds) -> Option<[f64; 2]> {
        links[self.base.link].map(|link| link.at(self.base.local))
    }

    /// World position of the pin.
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

    /// Places the turning link, given its direction.
    #[inline]
    pub(super) fn put(&self, direction: Vec2, motions: &mut [Motion]) {
        let place = self.place(motions);
        let motion = &mut motions[self.link];
        motion.direction = direction;
        motion.origin = place - motion.arm(self.own);
    }

    /// Sets the velocity of the turning link from its angular velocity.
    #[inline]
    pub(super) fn put_velocity(&self, omega: f64, motions: &mut [Motion]) {
        let velocity = self.velocity(motions);
        let motion = &mut motions[self.link];
        motion.omega = omega;
        motion.velocity = velocity - turned(motion.arm(self.own)) * omega;
    }

    /// Sets the acceleration of the turning link from its angular acceleration.
    #[inline]
    pub(super) fn put_acceleration(&self, alpha: f64, motions: &mut [Motion]) {
        let acceleration = self.acceleration(motions);
        let motion = &mut motions[self.link];
        let arm = motion.arm(self.own);
        motion.alpha = alpha;
        motion.acceleration = acceleration - turned(arm) * alpha + arm * (motion.omega * motion.omega);
    }
}
