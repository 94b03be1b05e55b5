//! Dyad of a swinging guide and a block: outer revolute joints, inner prismatic joint (class II, order 2).
//!
//! The outer pins are P1 (on the prismatic joint's first link) and P2. The axis is e, with the normal n.
//! The vector between the pins is d = P2 - P1 = e s + n h.
//! The distance h is a constant of the two links, and s = +-sqrt(d^2 - h^2) gives the direction of e.
//! Both links turn with e.
//! The derivative d' = s' e + omega x d gives omega = n . d' / s and s' = e . d' + omega h.
//! The second derivative of d gives alpha = (n . d'' - 2 s' omega + omega^2 h) / s.
//! These equations are derived here from the closure of the vector contour.
//! In Artobolevsky's classification this dyad is the class II group of the third kind.
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.

use super::bounds::{Bound, Bounds, Limit, of_square};
use super::guide::turn_between;
use super::misfit::{Misfit, SINGULAR, SingularityDistance};
use super::pin::Pin;
use linkage::math::{Motion, Vec2, cross, rotated, turned};
use linkage::mechanism::{AssemblyMode, Group, LinkId, Mechanism};

/// RPR dyad, prepared for solving.
#[derive(Clone, Copy, Debug)]
pub struct Rpr {
    pins: [Pin; 2],
    /// The axis in the frame of each link.
    axes: [Vec2; 2],
    /// Distance of the second pin from the line through the first pin along the axis; positive if the second pin is to
    /// the left of this line.
    across: f64,
    sense: f64,
    /// Size of the mechanism (m), with which the distance of the pins along the axis is compared.
    size: f64,
    /// d^2 at the last pose (m^2).
    gauge: f64,
}

impl Rpr {
    /// Prepares the dyad `group` in the assembly mode `mode`.
    #[must_use]
    pub fn of(mechanism: &Mechanism, group: &Group, mode: AssemblyMode) -> Self {
        let joints = mechanism.joints();
        let inner = &joints[group.inner[0]];
        let sides = [inner.first, inner.second];
        let pins = sides.map(|side| {
            let outer = group.outer_on(mechanism, side.link).expect("each link of a dyad has one outer joint");
            Pin::of(&joints[outer], side.link)
        });
        let axes = sides.map(|side| inner.axis_on(side.link).expect("the inner joint is prismatic"));
        let off = |k: usize| cross(axes[k], sides[k].local - pins[k].own);
        let sense = if mode == AssemblyMode::Behind { -1.0 } else { 1.0 };
        Rpr { pins, axes, across: off(0) - off(1), sense, size: mechanism.size(), gauge: f64::NAN }
    }

    #[inline]
    pub(super) fn positions(&mut self, motions: &mut [Motion]) -> Result<(), Misfit> {
        let [p1, p2] = self.pins.map(|pin| pin.place(motions));
        let d = p2 - p1;
        let squared = d.norm_squared();
        self.gauge = squared;
        let along_squared = squared - self.across * self.across;
        // The vector between coincident pins has no direction, so the second condition refuses coincident pins.
        if !(along_squared >= 0.0 && squared > 0.0) {
            return Err(Misfit::Swing { distance: squared.sqrt(), shortest: self.across.abs() });
        }
        if along_squared <= SINGULAR * SINGULAR * self.size * self.size {
            return Err(Misfit::Singular);
        }
        let local = Vec2::new(self.sense * along_squared.sqrt(), self.across);
        let axis = turn_between(d, local) / squared;
        for (pin, own) in self.pins.iter().zip(self.axes) {
            pin.put(turn_between(axis, own), motions);
        }
        Ok(())
    }

    /// World direction of the axis, and the distance of the pins along it.
    #[inline]
    fn along(&self, motions: &[Motion]) -> (Vec2, f64) {
        let axis = rotated(motions[self.pins[0].link].direction, self.axes[0]);
        (axis, axis.dot(&(self.pins[1].place(motions) - self.pins[0].place(motions))))
    }

    /// Returns the dyad, switched to its other configuration.
    pub(super) fn flipped(self) -> Self {
        Self { sense: -self.sense, ..self }
    }

    /// Gauge at the last pose: the squared distance of the pins (m^2).
    #[inline]
    pub(super) fn gauge(&self) -> f64 {
        self.gauge
    }

    /// Limit of the gauge during a step of the crank. `farthest` is a bound of the squared distance of the pins at the
    /// ends of the step (m^2). `step` is the crank's rotation in the step (rad).
    /// Inside the step, the distance of the pins exceeds the larger distance at the ends by at most `step` times the
    /// sum of the pins' speeds.
    pub(super) fn limit(&self, links: &Bounds, farthest: f64, step: f64) -> Option<Limit> {
        let [[v1, a1], [v2, a2]] = [self.pins[0].rates(links)?, self.pins[1].rates(links)?];
        let second = of_square([v1 + v2, a1 + a2], farthest.sqrt() + (v1 + v2) * step);
        Some(Limit { range: [self.across * self.across, f64::INFINITY], second, way: f64::INFINITY })
    }

    /// Writes the bounds of the dyad's links. The bounds hold while the gauge stays above the lower end of `band`.
    /// The bounds follow from the formulas of omega and alpha.
    pub(super) fn bound(&self, band: [f64; 2], links: &mut Bounds) {
        let [Some(first), Some(second)] = self.pins.map(|pin| pin.rates(links)) else { return };
        let (speed, rate) = (first[0] + second[0], first[1] + second[1]);
        let along = (band[0] - self.across * self.across).sqrt();
        let turn = speed / along;
        let slide = speed + turn * self.across.abs();
        let spin = (rate + 2.0 * slide * turn + turn * turn * self.across.abs()) / along;
        for (pin, [speed, second]) in self.pins.iter().zip([first, second]) {
            links[pin.link] = Some(Bound { about: pin.own, speed, second, turn, spin });
        }
    }

    /// The two links of the dyad.
    pub(super) fn links(&self) -> [LinkId; 2] {
        self.pins.map(|pin| pin.link)
    }

    /// The `sine` of [`Self::clearance`], which is zero in a singular pose.
    pub(super) fn sine(&self, motions: &[Motion]) -> f64 {
        self.along(motions).1.abs() / self.size
    }

    /// Distance of the dyad from a singular pose. Velocities must be known.
    pub(super) fn clearance(&self, motions: &[Motion]) -> SingularityDistance {
        let (axis, along) = self.along(motions);
        let [v1, v2] = self.pins.map(|pin| pin.velocity(motions));
        let slide = axis.dot(&(v2 - v1)) + motions[self.pins[0].link].omega * self.across;
        SingularityDistance { sine: along.abs() / self.size, rate: along.signum() * slide / self.size }
    }

    #[inline]
    pub(super) fn velocities(&self, motions: &mut [Motion]) {
        let (axis, along) = self.along(motions);
        let [v1, v2] = self.pins.map(|pin| pin.velocity(motions));
        let omega = turned(axis).dot(&(v2 - v1)) / along;
        self.pins.iter().for_each(|pin| pin.put_velocity(omega, motions));
    }

    #[inline]
    pub(super) fn accelerations(&self, motions: &mut [Motion]) {
        let (axis, along) = self.along(motions);
        let omega = motions[self.pins[0].link].omega;
        let [v1, v2] = self.pins.map(|pin| pin.velocity(motions));
        let slide = axis.dot(&(v2 - v1)) + omega * self.across;
        let [a1, a2] = self.pins.map(|pin| pin.acceleration(motions));
        let alpha = (turned(axis).dot(&(a2 - a1)) - 2.0 * slide * omega + omega * omega * self.across) / along;
        self.pins.iter().for_each(|pin| pin.put_acceleration(alpha, motions));
    }
}
