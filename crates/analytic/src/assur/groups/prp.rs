//! Dyad of two sliders on one pin: outer prismatic joints, inner revolute joint (class II, order 2).
//!
//! Both links turn with their guides.
//! The inner joint C lies on two lines along the axes e and b: (C1 + s e - C2) x b = 0.
//! C1 and C2 are the positions of C on the two links at slide zero.
//! E1 and E2 are the points of the guides' links at C. The velocities of E1 and E2 satisfy v_E1 + s' e = v_E2 + t' b.
//! The accelerations of E1 and E2, with their Coriolis parts, satisfy the corresponding equation with s'' and t''.
//! The equations are derived from the closure of the vector contour. In Artobolevsky's classification, the PRP dyad is
//! the class II group of the fourth kind.
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.

use super::bounds::{Bounds, Limit};
use super::guide::Guide;
use super::misfit::{Misfit, kept_side};
use linkage::math::{Motion, Vec2, cross, turned};
use linkage::mechanism::{Group, Mechanism};

/// PRP dyad, prepared for solving.
#[derive(Clone, Copy, Debug)]
pub struct Prp {
    guides: [Guide; 2],
    /// The inner joint in each slider's frame.
    inner: [Vec2; 2],
    /// Sign of the sine of the angle between the axes on the followed branch; 0 before the first pose.
    side: f64,
    /// Sine of the angle between the axes at the last pose, times the sign of this sine on the followed branch.
    gauge: f64,
}

impl Prp {
    /// Prepares the dyad `group`. The dyad has only one configuration.
    #[must_use]
    pub fn of(mechanism: &Mechanism, group: &Group) -> Self {
        let joints = mechanism.joints();
        let inner = &joints[group.inner[0]];
        let sliders = [group.links[0], group.links[1]];
        Prp {
            guides: [0, 1].map(|k| Guide::of(&joints[group.outer[k]], sliders[k])),
            inner: sliders.map(|link| inner.on(link).expect("the inner joint is on both links")),
            side: 0.0,
            gauge: f64::NAN,
        }
    }

    /// Gauge at the last pose: the sine of the angle between the dyad's axes, times its sign on the followed branch.
    #[inline]
    pub(super) fn gauge(&self) -> f64 {
        self.gauge
    }

    /// Limit of the gauge during a step of the crank. The angle between the axes changes with the rotation of the
    /// guides.
    pub(super) fn limit(&self, links: &Bounds) -> Option<Limit> {
        let [first, second] = self.guides.map(|guide| links[guide.base.link]);
        let (first, second) = (first?, second?);
        let turn = first.turn + second.turn;
        let second = first.spin + second.spin + turn * turn;
        Some(Limit { range: [0.0, f64::INFINITY], second, way: f64::INFINITY })
    }

    #[inline]
    fn axes(&self, motions: &[Motion]) -> [Vec2; 2] {
        self.guides.map(|guide| guide.axis(motions))
    }

    #[inline]
    pub(super) fn positions(&mut self, motions: &mut [Motion]) -> Result<(), Misfit> {
        self.guides.iter().for_each(|guide| guide.aim(motions));
        let [e, b] = self.axes(motions);
        let [from, other] = [0, 1].map(|k| self.guides[k].at_zero(self.inner[k], motions));
        let sine = cross(b, e);
        self.side = kept_side(self.side, sine)?;
        self.gauge = sine * self.side;
        let slide = cross(b, other - from) / sine;
        for (guide, inner) in self.guides.iter().zip(self.inner) {
            guide.put(inner, from + e * slide, motions);
        }
        Ok(())
    }

    #[inline]
    pub(super) fn velocities(&self, motions: &mut [Motion]) {
        let [e, b] = self.axes(motions);
        let place = motions[self.guides[0].link].point(self.inner[0]);
        let [first, second] = self.guides.map(|guide| motions[guide.base.link].velocity_at(place));
        let velocity = first + e * (cross(b, second - first) / cross(b, e));
        for (guide, inner) in self.guides.iter().zip(self.inner) {
            guide.put_velocity(inner, velocity, motions);
        }
    }

    #[inline]
    pub(super) fn accelerations(&self, motions: &mut [Motion]) {
        let axes = self.axes(motions);
        let slider = &motions[self.guides[0].link];
        let (place, velocity) = (slider.point(self.inner[0]), slider.point_velocity(self.inner[0]));
        let [first, second] = [0, 1].map(|k| {
            let base = &motions[self.guides[k].base.link];
            let speed = axes[k].dot(&(velocity - base.velocity_at(place)));
            base.acceleration_at(place) + turned(axes[k]) * (2.0 * base.omega * speed)
        });
        let [e, b] = axes;
        let acceleration = first + e * (cross(b, second - first) / cross(b, e));
        for (guide, inner) in self.guides.iter().zip(self.inner) {
            guide.put_acceleration(inner, acceleration, motions);
        }
    }
}
