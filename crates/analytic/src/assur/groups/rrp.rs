//! Dyad of a connecting rod and a slider: outer and inner revolute pair, outer prismatic pair (class II, order 2).
//!
//! The outer pin is P, the inner joint C, r = C - P; the guide has the axis e and its normal n.
//! C lies on a line along e, so that h = n . r is known and e . r = +-sqrt(l^2 - h^2).
//! E is the point of the guide's link at C.
//! The condition v_P + omega x r = v_E + s' e gives omega = n . (v_E - v_P) / (e . r).
//! The accelerations, with the Coriolis part 2 omega_E s' n, give alpha = (n . (a_E - a_P + omega^2 r) + 2 omega_E s')
//! / (e . r).
//! These equations are derived here from the closure of the vector contour.
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.

use super::bounds::{Bound, Bounds, Limit, least_product};
use super::guide::{Guide, turn_between};
use super::half::of_dyad;
use super::misfit::{Misfit, SINGULAR, SingularityDistance};
use super::pin::Pin;
use linkage::math::{Motion, Vec2, turned};
use linkage::mechanism::{AssemblyMode, Group, LinkId, Mechanism};

/// If the guide turns, a bound is valid over a crank rotation of this many steps.
const FAR: f64 = 16.0;

/// RRP dyad, prepared for solving.
#[derive(Clone, Copy, Debug)]
pub struct Rrp {
    rod: Pin,
    /// Vector from the outer pin to the inner joint in the rod's frame.
    span: Vec2,
    guide: Guide,
    /// The inner joint in the slider's frame.
    inner: Vec2,
    sense: f64,
    /// h at the last pose (m).
    gauge: f64,
}

impl Rrp {
    /// Prepares the dyad `group` in the assembly mode `mode`.
    #[must_use]
    pub fn of(mechanism: &Mechanism, group: &Group, mode: AssemblyMode) -> Self {
        let [slider, rod] = of_dyad(mechanism, group, |outer, _| outer.slides());
        let inner = &mechanism.joints()[group.inner[0]];
        let on = |link: LinkId| inner.on(link).expect("the inner joint is on both links");
        let pin = Pin::of(rod.outer, rod.link);
        Rrp {
            rod: pin,
            span: on(rod.link) - pin.own,
            guide: Guide::of(slider.outer, slider.link),
            inner: on(slider.link),
            sense: if mode == AssemblyMode::Behind { -1.0 } else { 1.0 },
            gauge: f64::NAN,
        }
    }

    #[inline]
    pub(super) fn positions(&mut self, motions: &mut [Motion]) -> Result<(), Misfit> {
        self.guide.aim(motions);
        let axis = self.guide.axis(motions);
        let pin = self.rod.place(motions);
        let across = turned(axis).dot(&(self.guide.at_zero(self.inner, motions) - pin));
        self.gauge = across;
        let squared = self.span.norm_squared();
        let along_squared = squared - across * across;
        if !(along_squared >= 0.0) {
            return Err(Misfit::Guide { distance: across.abs(), length: squared.sqrt() });
        }
        if along_squared <= SINGULAR * SINGULAR * squared {
            return Err(Misfit::Singular);
        }
        let r = axis * (self.sense * along_squared.sqrt()) + turned(axis) * across;
        self.rod.put(turn_between(r, self.span) / squared, motions);
        self.guide.put(self.inner, pin + r, motions);
        Ok(())
    }

    /// Returns the dyad, switched to its other configuration.
    pub(super) fn flipped(self) -> Self {
        Self { sense: -self.sense, ..self }
    }

    /// Gauge at the last pose: the signed distance of the outer pin from the line on which the inner joint moves (m).
    #[inline]
    pub(super) fn gauge(&self) -> f64 {
        self.gauge
    }

    /// Returns bounds of the speed and acceleration of the outer pin and of the point Q, and the bounds of the guide's
    /// link.
    /// Q is the point of the guide's link at which the inner joint lies at slide zero.
    /// The last value is an upper bound of the distance between pin and Q while the crank turns by at most `way` from
    /// the present pose.
    fn outer_rates(&self, links: &Bounds, motions: &[Motion], way: f64) -> Option<([f64; 2], [f64; 2], Bound, f64)> {
        let (pin, link) = (self.rod.rates(links)?, links[self.guide.base.link]?);
        let (base, at_zero) = (&motions[self.guide.base.link], self.guide.at_zero(self.inner, motions));
        let arm = (at_zero - base.point(link.about)).norm();
        let zero = link.beyond(arm);
        Some((pin, zero, link, (at_zero - self.rod.place(motions)).norm() + (pin[0] + zero[0]) * way))
    }

    /// Limit of the gauge during a step of the crank.
    /// The gauge is h = n . (Q - P), so that |h''| <= |a| + 2 omega |v| + (alpha + omega^2) |Q - P|.
    /// Here v and a are the velocity and acceleration of Q relative to P; omega and alpha are the rates of the guide's
    /// angle.
    pub(super) fn limit(&self, links: &Bounds, motions: &[Motion], step: f64) -> Option<Limit> {
        let way = FAR * step;
        let (pin, zero, link, distance) = self.outer_rates(links, motions, way)?;
        let length = self.span.norm();
        let second = pin[1] + zero[1] + 2.0 * link.turn * (pin[0] + zero[0]) + link.centripetal() * distance;
        let rests = link.turn == 0.0 && link.spin == 0.0;
        Some(Limit { range: [-length, length], second, way: if rests { f64::INFINITY } else { way } })
    }

    /// Writes the bounds of the dyad's links. The bounds hold while the gauge stays in `band`, for `FAR` steps of the
    /// crank.
    /// The bounds follow from the formulas of omega and alpha, with the smallest |e . r| = sqrt(l^2 - h^2) in `band`.
    pub(super) fn bound(&self, band: [f64; 2], step: f64, motions: &[Motion], links: &mut Bounds) {
        let Some((pin, zero, guide, distance)) = self.outer_rates(links, motions, FAR * step) else { return };
        let length = self.span.norm();
        let along = least_product([-length, length], band).sqrt();
        // Bounds of the guide's link at the inner joint. The inner joint is at most one rod length away from the pin.
        let speed = zero[0] + guide.turn * (distance + length);
        let second = zero[1] + guide.centripetal() * (distance + length);
        let turn = (speed + pin[0]) / along;
        let slide = speed + pin[0] + turn * length;
        let spin = (second + pin[1] + turn * turn * length + 2.0 * guide.turn * slide) / along;
        let rod = Bound { about: self.rod.own, speed: pin[0], second: pin[1], turn, spin };
        let [speed, second] = rod.beyond(length);
        links[self.rod.link] = Some(rod);
        links[self.guide.link] = Some(Bound { about: self.inner, speed, second, ..guide });
    }

    /// The two links of the dyad.
    pub(super) fn links(&self) -> [LinkId; 2] {
        [self.rod.link, self.guide.link]
    }

    /// Sine of the transmission angle, without sign.
    pub(super) fn sine(&self, motions: &[Motion]) -> f64 {
        (self.guide.axis(motions).dot(&motions[self.rod.link].arm(self.span)) / self.span.norm()).abs()
    }

    /// Distance of the dyad from a singular pose. Velocities must be known.
    pub(super) fn clearance(&self, motions: &[Motion]) -> SingularityDistance {
        let (axis, r, length) = (self.guide.axis(motions), motions[self.rod.link].arm(self.span), self.span.norm());
        let turn = motions[self.guide.base.link].omega - motions[self.rod.link].omega;
        let cosine = axis.dot(&r) / length;
        SingularityDistance { sine: cosine.abs(), rate: cosine.signum() * turned(axis).dot(&r) / length * turn }
    }

    #[inline]
    pub(super) fn velocities(&self, motions: &mut [Motion]) {
        let (axis, r) = (self.guide.axis(motions), motions[self.rod.link].arm(self.span));
        let pin = self.rod.velocity(motions);
        let guided = motions[self.guide.base.link].velocity_at(self.rod.place(motions) + r);
        let omega = turned(axis).dot(&(guided - pin)) / axis.dot(&r);
        self.rod.put_velocity(omega, motions);
        self.guide.put_velocity(self.inner, pin + turned(r) * omega, motions);
    }

    #[inline]
    pub(super) fn accelerations(&self, motions: &mut [Motion]) {
        let (axis, r) = (self.guide.axis(motions), motions[self.rod.link].arm(self.span));
        let (base, place) = (&motions[self.guide.base.link], self.rod.place(motions) + r);
        let slide = axis.dot(&(motions[self.guide.link].point_velocity(self.inner) - base.velocity_at(place)));
        let pin = self.rod.acceleration(motions);
        let centripetal = r * motions[self.rod.link].omega.powi(2);
        let normal = turned(axis).dot(&(base.acceleration_at(place) - pin + centripetal));
        let alpha = (normal + 2.0 * base.omega * slide) / axis.dot(&r);
        self.rod.put_acceleration(alpha, motions);
        self.guide.put_acceleration(self.inner, pin + turned(r) * alpha - centripetal, motions);
    }
}
