//! Dyad of a pinned link that slides on a slider: outer revolute, inner and outer prismatic joint (class II, order 2).
//!
//! All angles follow from the guide's link, which carries the axis e.
//! The inner axis is b, and X is a point of the slider on the inner axis.
//! X slides along e. X also lies on a line along b through the point C of the pinned link.
//! The condition b x (X - C) = 0 gives the slide s, and the condition b x (v_E - v_A) + s' b x e = 0 gives s'.
//! E and A are the points of the guide's link and of the pinned link at X.
//! The accelerations, with both Coriolis parts, give s''.
//! These equations are derived here from the closure of the vector contour.
//! In Artobolevsky's classification this dyad is the class II group of the fifth kind.
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.

use super::guide::{Guide, turn_between};
use super::half::of_dyad;
use super::misfit::{Misfit, kept_side};
use super::pin::Pin;
use linkage::math::{Motion, Vec2, cross, turned};
use linkage::mechanism::{Group, Mechanism};

/// RPP dyad, prepared for solving.
#[derive(Clone, Copy, Debug)]
pub struct Rpp {
    pinned: Pin,
    guide: Guide,
    /// Inner axis in the frames of the pinned link and of the slider.
    axes: [Vec2; 2],
    /// Position of the inner joint in the frames of the pinned link and of the slider.
    inner: [Vec2; 2],
    /// Sign of the sine of the angle between the axes on the followed branch; 0 before the first pose.
    side: f64,
}

/// Values of a pose that are used for positions, velocities and accelerations.
struct Pose {
    axis: Vec2,
    inner_axis: Vec2,
    /// World position of the inner joint on the slider.
    place: Vec2,
}

impl Rpp {
    /// Prepares the dyad `group`. The dyad has only one configuration.
    #[must_use]
    pub fn of(mechanism: &Mechanism, group: &Group) -> Self {
        let [slider, pinned] = of_dyad(mechanism, group, |outer, _| outer.slides());
        let inner = &mechanism.joints()[group.inner[0]];
        let links = [pinned.link, slider.link];
        Rpp {
            pinned: Pin::of(pinned.outer, pinned.link),
            guide: Guide::of(slider.outer, slider.link),
            axes: links.map(|link| inner.axis_on(link).expect("the inner joint is prismatic")),
            inner: links.map(|link| inner.on(link).expect("the inner joint is on both links")),
            side: 0.0,
        }
    }

    #[inline]
    pub(super) fn positions(&mut self, motions: &mut [Motion]) -> Result<(), Misfit> {
        self.guide.aim(motions);
        let inner_axis = motions[self.guide.link].arm(self.axes[1]);
        self.pinned.put(turn_between(inner_axis, self.axes[0]), motions);
        let axis = self.guide.axis(motions);
        let from = self.guide.at_zero(self.inner[1], motions);
        let sine = cross(inner_axis, axis);
        self.side = kept_side(self.side, sine)?;
        let slide = cross(inner_axis, motions[self.pinned.link].point(self.inner[0]) - from) / sine;
        self.guide.put(self.inner[1], from + axis * slide, motions);
        Ok(())
    }

    #[inline]
    fn pose(&self, motions: &[Motion]) -> Pose {
        let slider = &motions[self.guide.link];
        let place = slider.point(self.inner[1]);
        Pose { axis: self.guide.axis(motions), inner_axis: slider.arm(self.axes[1]), place }
    }

    #[inline]
    pub(super) fn velocities(&self, motions: &mut [Motion]) {
        let Pose { axis, inner_axis, place } = self.pose(motions);
        self.pinned.put_velocity(motions[self.guide.base.link].omega, motions);
        let guided = motions[self.guide.base.link].velocity_at(place);
        let carried = motions[self.pinned.link].velocity_at(place);
        let speed = cross(inner_axis, carried - guided) / cross(inner_axis, axis);
        self.guide.put_velocity(self.inner[1], guided + axis * speed, motions);
    }

    #[inline]
    pub(super) fn accelerations(&self, motions: &mut [Motion]) {
        let Pose { axis, inner_axis, place } = self.pose(motions);
        let (base, omega) = (self.guide.base.link, motions[self.guide.base.link].omega);
        self.pinned.put_acceleration(motions[base].alpha, motions);
        let velocity = motions[self.guide.link].velocity_at(place);
        let speed = axis.dot(&(velocity - motions[base].velocity_at(place)));
        let inner_speed = inner_axis.dot(&(velocity - motions[self.pinned.link].velocity_at(place)));
        let guided = motions[base].acceleration_at(place) + turned(axis) * (2.0 * omega * speed);
        let carried =
            motions[self.pinned.link].acceleration_at(place) + turned(inner_axis) * (2.0 * omega * inner_speed);
        let second = cross(inner_axis, carried - guided) / cross(inner_axis, axis);
        self.guide.put_acceleration(self.inner[1], guided + axis * second, motions);
    }
}
