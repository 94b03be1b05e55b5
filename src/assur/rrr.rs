//! Dyad with three revolute pairs (class II, order 2): closed form of position, velocity and acceleration.
//!
//! With the outer joints P1, P2, the inner joint P3, r1 = P3 - P1, r2 = P3 - P2 and D = r1 x r2:
//! r1 = d f + (z x d) h with d = P2 - P1, f = (l1^2 - l2^2 + d^2) / 2 d^2, h = +-sqrt(l1^2 / d^2 - f^2);
//! omega1 = (v2 - v1) . r2 / D, omega2 = (v2 - v1) . r1 / D from v1 + omega1 x r1 = v2 + omega2 x r2, and the same with
//! the accelerations less their centripetal parts. Follows from the vector contour of the group, for example Artobolevsky,
//! "Theory of mechanisms and machines", chapter on the kinematics of class II groups.

use super::Misfit;
use crate::math::{Motion, Vec2, cross, turned};
use crate::mechanism::{AssemblyMode, Group, Mechanism, Side};

/// One of the two links of a dyad.
#[derive(Clone, Copy, Debug)]
struct Arm {
    link: usize,
    /// The outer joint on the link that is already known.
    base: Side,
    /// The outer joint in the link's own frame.
    outer: Vec2,
    /// Vector from outer to inner joint in the link's own frame.
    span: Vec2,
}

/// RRR dyad, ready for solving.
#[derive(Clone, Copy, Debug)]
pub struct Rrr {
    arms: [Arm; 2],
    squared: [f64; 2],
    side: f64,
}

impl Rrr {
    /// Prepares the dyad `group` in the assembly mode `mode`.
    #[must_use]
    pub fn of(mechanism: &Mechanism, group: &Group, mode: AssemblyMode) -> Self {
        let arms = [0, 1].map(|k| {
            let link = group.links[k];
            let on_link = |joint: usize| mechanism.joints()[joint].on(link).expect("the joint is on the link");
            let outer = on_link(group.outer[k]);
            Arm {
                link,
                base: mechanism.joints()[group.outer[k]].other(link),
                outer,
                span: on_link(group.inner[0]) - outer,
            }
        });
        Rrr {
            arms,
            squared: arms.map(|arm| arm.span.norm_squared()),
            side: if mode == AssemblyMode::Right { -1.0 } else { 1.0 },
        }
    }

    /// World vectors from the outer joints to the inner one.
    #[inline]
    fn spans(&self, motions: &[Motion]) -> [Vec2; 2] {
        self.arms.map(|arm| motions[arm.link].arm(arm.span))
    }

    #[inline]
    pub(super) fn positions(&self, motions: &mut [Motion]) -> Result<(), Misfit> {
        let [p1, p2] = self.arms.map(|arm| motions[arm.base.link].point(arm.base.local));
        let d = p2 - p1;
        let d_squared = d.norm_squared();
        let along = 0.5 * (self.squared[0] - self.squared[1] + d_squared) / d_squared;
        let across_squared = self.squared[0] / d_squared - along * along;
        // Written so that NaN (outer joints on one point) is refused too.
        if !(across_squared >= 0.0) {
            let [l1, l2] = self.squared.map(f64::sqrt);
            return Err(Misfit::Span { distance: d_squared.sqrt(), reach: [(l1 - l2).abs(), l1 + l2] });
        }
        let r1 = d * along + turned(d) * (self.side * across_squared.sqrt());
        for (k, (pivot, r)) in [(p1, r1), (p2, r1 - d)].into_iter().enumerate() {
            let Arm { link, outer, span, .. } = self.arms[k];
            let motion = &mut motions[link];
            // Quotient of the world and the body vector as complex numbers: the direction of the frame.
            motion.direction = Vec2::new(span.dot(&r), cross(span, r)) / self.squared[k];
            motion.origin = pivot - motion.arm(outer);
        }
        Ok(())
    }

    #[inline]
    pub(super) fn velocities(&self, motions: &mut [Motion]) {
        let [r1, r2] = self.spans(motions);
        let [v1, v2] = self.arms.map(|arm| motions[arm.base.link].point_velocity(arm.base.local));
        let quotient = (v2 - v1) / cross(r1, r2);
        for (arm, (v, omega)) in self.arms.iter().zip([(v1, quotient.dot(&r2)), (v2, quotient.dot(&r1))]) {
            let motion = &mut motions[arm.link];
            motion.omega = omega;
            motion.velocity = v - turned(motion.arm(arm.outer)) * omega;
        }
    }

    #[inline]
    pub(super) fn accelerations(&self, motions: &mut [Motion]) {
        let [r1, r2] = self.spans(motions);
        let [a1, a2] = self.arms.map(|arm| motions[arm.base.link].point_acceleration(arm.base.local));
        let [w1, w2] = self.arms.map(|arm| motions[arm.link].omega);
        let quotient = ((a2 - r2 * (w2 * w2)) - (a1 - r1 * (w1 * w1))) / cross(r1, r2);
        for (arm, (a, alpha)) in self.arms.iter().zip([(a1, quotient.dot(&r2)), (a2, quotient.dot(&r1))]) {
            let motion = &mut motions[arm.link];
            let outer = motion.arm(arm.outer);
            motion.alpha = alpha;
            motion.acceleration = a - turned(outer) * alpha + outer * (motion.omega * motion.omega);
        }
    }
}
