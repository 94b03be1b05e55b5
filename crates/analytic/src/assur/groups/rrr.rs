//! Dyad with three revolute pairs (class II, order 2): closed form of position, velocity and acceleration.
//!
//! The outer joints are P1 and P2, the inner joint is P3.
//! The vectors are r1 = P3 - P1, r2 = P3 - P2 and d = P2 - P1; D = r1 x r2.
//! Position: r1 = d f + (z x d) h with f = (l1^2 - l2^2 + d^2) / 2 d^2 and 4 D^2 = 4 d^4 h^2 = ((l1 + l2)^2 - d^2)
//! (d^2 - (l1 - l2)^2).
//! Velocity: v1 + omega1 x r1 = v2 + omega2 x r2 gives omega1 = (v2 - v1) . r2 / D and omega2 = (v2 - v1) . r1 / D.
//! With the accelerations minus their centripetal parts in place of the velocities, these equations give the angular
//! accelerations.
//! All these equations are derived here from the closure of the vector contour.
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.

use super::bounds::{Bound, Bounds, Limit, least_product, of_square};
use super::misfit::{Misfit, SINGULAR, SingularityDistance};
use linkage::math::{Motion, Vec2, cross, turned};
use linkage::mechanism::{AssemblyMode, GROUND, Group, JointId, JointSide, LinkId, Mechanism};

/// One of the two links of a dyad.
#[derive(Clone, Copy, Debug)]
struct Arm {
    link: LinkId,
    /// The outer joint on the link that is already known.
    base: JointSide,
    /// The outer joint in the link's frame.
    outer: Vec2,
    /// Whether the outer joint is the origin of the link's frame. The vector from the origin to the joint is then zero.
    at_origin: bool,
    /// Vector from outer to inner joint in the link's frame, divided by the square of its length (1/m).
    inverse_span: Vec2,
}

/// RRR dyad, prepared for solving.
#[derive(Clone, Copy, Debug)]
pub struct Rrr {
    arms: [Arm; 2],
    squared: [f64; 2],
    /// Limits of d^2: (l1 - l2)^2 and (l1 + l2)^2 (m^2).
    range: [f64; 2],
    /// 1 / (l1 l2) (1/m^2).
    inverse_lengths: f64,
    /// If 4 D^2 is at most this value, the pose is singular. The value is the square of 2 [`SINGULAR`] l1 l2 (m^4).
    least: f64,
    /// One half, with the sign that D has on the branch.
    half: f64,
    /// World vectors from the origins of the known links to the outer joints (m).
    bases: [Vec2; 2],
    /// World vectors from the origins of the dyad's two links to the outer joints (m).
    outers: [Vec2; 2],
    /// World vectors r1 and r2 from the outer joints to the inner joint (m), and the position of the inner joint (m).
    spans: [Vec2; 2],
    inner: Vec2,
    /// d^2 (m^2).
    gauge: f64,
    /// D = d^2 h (m^2), and 1 / D.
    product: f64,
    inverse: f64,
}

impl Rrr {
    /// Prepares the dyad `group` in the assembly mode `mode`.
    #[must_use]
    pub fn of(mechanism: &Mechanism, group: &Group, mode: AssemblyMode) -> Self {
        let on = |joint: JointId, link: LinkId| mechanism.joints()[joint].on(link).expect("the joint is on the link");
        let mut dyad = Rrr::between(mechanism, [0, 1].map(|k| (group.links[k], group.outer[k])), mode);
        for k in 0..2 {
            let link = group.links[k];
            dyad.reshape(k, on(group.inner[0], link) - on(group.outer[k], link));
        }
        dyad.measure();
        dyad
    }

    /// A dyad of two links with their outer joints. [`Rrr::reshape`] gives the links their lengths.
    pub(super) fn between(mechanism: &Mechanism, ends: [(LinkId, JointId); 2], mode: AssemblyMode) -> Self {
        let on = |joint: JointId, link: LinkId| mechanism.joints()[joint].on(link).expect("the joint is on the link");
        let arms = ends.map(|(link, outer)| Arm {
            link,
            base: mechanism.joints()[outer].other(link),
            outer: on(outer, link),
            at_origin: on(outer, link) == Vec2::zeros(),
            inverse_span: Vec2::zeros(),
        });
        Rrr {
            arms,
            squared: [f64::NAN; 2],
            range: [f64::NAN; 2],
            inverse_lengths: f64::NAN,
            least: f64::NAN,
            half: if mode == AssemblyMode::Right { -0.5 } else { 0.5 },
            bases: [Vec2::zeros(); 2],
            outers: [Vec2::zeros(); 2],
            spans: [Vec2::zeros(); 2],
            inner: Vec2::zeros(),
            gauge: f64::NAN,
            product: f64::NAN,
            inverse: f64::NAN,
        }
    }

    /// Sets the vector from outer to inner joint of the arm `k`, in the frame of its link (m).
    /// [`Rrr::measure`] must follow.
    #[inline]
    pub(super) fn reshape(&mut self, k: usize, span: Vec2) {
        self.squared[k] = span.norm_squared();
        self.arms[k].inverse_span = span / self.squared[k];
    }

    /// From the lengths of the arms, computes the limits of d^2, 1 / (l1 l2), and the limit of 4 D^2.
    #[inline]
    pub(super) fn measure(&mut self) {
        let squared = self.squared;
        let lengths = squared.map(f64::sqrt);
        self.range = [(lengths[0] - lengths[1]).powi(2), (lengths[0] + lengths[1]).powi(2)];
        self.inverse_lengths = 1.0 / (squared[0] * squared[1]).sqrt();
        self.least = 4.0 * SINGULAR * SINGULAR * squared[0] * squared[1];
    }

    /// World vectors from the outer joints of the group's first and second link to the inner joint (m), and the inverse
    /// of their vector product (1/m^2). Positions and velocities must be known.
    #[inline]
    #[must_use]
    pub fn spans(&self) -> ([Vec2; 2], f64) {
        (self.spans, self.inverse)
    }

    /// World position of the inner joint (m). Positions must be known.
    #[inline]
    pub(in crate::assur) fn inner(&self) -> Vec2 {
        self.inner
    }

    /// For the outer joint of an arm: the vector from the origin of the known link to the joint, and the joint's
    /// position, velocity and acceleration.
    /// For joints on the ground, nothing is computed.
    #[inline(always)]
    fn base(arm: &Arm, motions: &[Motion]) -> [Vec2; 4] {
        let local = arm.base.local;
        if arm.base.link == GROUND {
            return [local, local, Vec2::zeros(), Vec2::zeros()];
        }
        let motion = &motions[arm.base.link];
        let vector = motion.arm(local);
        [vector, motion.origin + vector, motion.velocity_beyond(vector), motion.acceleration_beyond(vector)]
    }

    /// For outer joints at these positions: the vectors r1 and r2, then D = r1 x r2 and d^2.
    #[inline(always)]
    fn close(&self, [p1, p2]: [Vec2; 2]) -> Result<([Vec2; 2], [f64; 2]), Misfit> {
        let d = p2 - p1;
        let d_squared = d.norm_squared();
        // `along` is f d^2, where f is the component of r1 along d, divided by the length of d.
        // 4 D^2 follows from Heron's formula, which loses no digits near a singular pose.
        // The square root does not need the division by d^2, so the processor can do both operations at the same time.
        let along = 0.5 * (self.squared[0] - self.squared[1] + d_squared);
        let square = (self.range[1] - d_squared) * (d_squared - self.range[0]);
        // The comparison is negated so that NaN is refused too.
        if !(square >= 0.0) {
            return Err(self.too_far(d_squared));
        }
        // Refuses a singular pose: the sine of the transmission angle, D / (l1 l2), is too small.
        if square <= self.least {
            return Err(Misfit::Singular);
        }
        let product = self.half * square.sqrt();
        let r1 = (d * along + turned(d) * product) * (1.0 / d_squared);
        Ok(([r1, r1 - d], [product, d_squared]))
    }

    #[cold]
    fn too_far(&self, d_squared: f64) -> Misfit {
        let [l1, l2] = self.squared.map(f64::sqrt);
        Misfit::Span { distance: d_squared.sqrt(), reach: [(l1 - l2).abs(), l1 + l2] }
    }

    #[inline]
    pub(super) fn positions(&mut self, motions: &mut [Motion]) -> Result<(), Misfit> {
        let [base1, base2] = [0, 1].map(|k| Self::base(&self.arms[k], motions));
        self.bases = [base1[0], base2[0]];
        let pivots = [base1[1], base2[1]];
        (self.spans, [self.product, self.gauge]) = self.close(pivots)?;
        self.inner = pivots[0] + self.spans[0];
        for (k, (pivot, r)) in pivots.into_iter().zip(self.spans).enumerate() {
            let Arm { link, outer, inverse_span, .. } = self.arms[k];
            let motion = &mut motions[link];
            // The direction of the frame is the quotient of the world vector and the vector in the link's frame, as
            // complex numbers.
            motion.direction = Vec2::new(inverse_span.dot(&r), cross(inverse_span, r));
            self.outers[k] = motion.arm(outer);
            motion.origin = pivot - self.outers[k];
        }
        Ok(())
    }

    /// Positions, velocities and accelerations in one pass. Shared values stay in registers, and every motion is
    /// written once.
    /// The arithmetic operations are the same as in the three separate functions, so the bits are the same too.
    #[inline(always)]
    pub(super) fn motions(&mut self, motions: &mut [Motion]) -> Result<(), Misfit> {
        let [[bases0, p1, v1, a1], [bases1, p2, v2, a2]] = [0, 1].map(|k| Self::base(&self.arms[k], motions));
        let ([r1, r2], [product, gauge]) = self.close([p1, p2])?;
        let inverse = 1.0 / product;
        let quotient = (v2 - v1) * inverse;
        let [w1, w2] = [quotient.dot(&r2), quotient.dot(&r1)];
        let [square1, square2] = [w1 * w1, w2 * w2];
        let quotient = ((a2 - r2 * square2) - (a1 - r1 * square1)) * inverse;
        let [e1, e2] = [quotient.dot(&r2), quotient.dot(&r1)];
        let mut place = |k: usize, r: Vec2, p: Vec2, [v, a]: [Vec2; 2], [omega, square, alpha]: [f64; 3]| {
            let arm = &self.arms[k];
            let motion = &mut motions[arm.link];
            (motion.omega, motion.alpha) = (omega, alpha);
            motion.direction = Vec2::new(arm.inverse_span.dot(&r), cross(arm.inverse_span, r));
            if arm.at_origin {
                // The outer joint is the frame's origin: the vector between them is zero and needs no update.
                (motion.origin, motion.velocity, motion.acceleration) = (p, v, a);
                return;
            }
            let outer = motion.arm(arm.outer);
            motion.origin = p - outer;
            motion.velocity = v - turned(outer) * omega;
            motion.acceleration = a - turned(outer) * alpha + outer * square;
            self.outers[k] = outer;
        };
        place(0, r1, p1, [v1, a1], [w1, square1, e1]);
        place(1, r2, p2, [v2, a2], [w2, square2, e2]);
        (self.bases, self.spans) = ([bases0, bases1], [r1, r2]);
        (self.inner, self.gauge, self.product, self.inverse) = (p1 + r1, gauge, product, inverse);
        Ok(())
    }

    /// Returns the dyad, switched to its other configuration.
    pub(super) fn flipped(self) -> Self {
        Self { half: -self.half, ..self }
    }

    /// Gauge at the last pose: the squared distance of the outer joints (m^2).
    #[inline]
    pub(super) fn gauge(&self) -> f64 {
        self.gauge
    }

    /// Bounds of the speeds and accelerations of the outer joints; `None` if a carrying link has no bounds.
    fn outer_rates(&self, links: &Bounds) -> Option<[[f64; 2]; 2]> {
        let [first, second] = self.arms.map(|arm| links[arm.base.link].map(|link| link.at(arm.base.local)));
        Some([first?, second?])
    }

    /// Limit of the gauge during a step of the crank.
    pub(super) fn limit(&self, links: &Bounds, step: f64) -> Option<Limit> {
        let [[v1, a1], [v2, a2]] = self.outer_rates(links)?;
        let range = self.range;
        // The dyad is assembled at both ends of the step. Between the ends, the distance of the outer joints is
        // therefore at most this value.
        let most = range[1].sqrt() + (v1 + v2) * step;
        Some(Limit { range, second: of_square([v1 + v2, a1 + a2], most), way: f64::INFINITY })
    }

    /// Writes the bounds of the dyad's links. The bounds hold while the gauge stays in `band`.
    /// The bounds follow from omega1 = (v2 - v1) . r2 / D and |D| = l1 l2 s.
    /// Here s is the sine of the transmission angle; with the gauge g, 4 l1^2 l2^2 s^2 = (g - low) (high - g).
    pub(super) fn bound(&self, band: [f64; 2], links: &mut Bounds) {
        let rates = self.outer_rates(links);
        let sine = 0.5 * least_product(self.range, band).sqrt() * self.inverse_lengths;
        let lengths = self.squared.map(f64::sqrt);
        let Some([[v1, a1], [v2, a2]]) = rates else { return };
        let turns = lengths.map(|length| (v1 + v2) / (length * sine));
        let centripetal = lengths[0] * turns[0] * turns[0] + lengths[1] * turns[1] * turns[1];
        for (k, [speed, second]) in [[v1, a1], [v2, a2]].into_iter().enumerate() {
            let (turn, spin) = (turns[k], (a1 + a2 + centripetal) / (lengths[k] * sine));
            links[self.arms[k].link] = Some(Bound { about: self.arms[k].outer, speed, second, turn, spin });
        }
    }

    /// The two links of the dyad.
    pub(super) fn links(&self) -> [LinkId; 2] {
        self.arms.map(|arm| arm.link)
    }

    /// Sine of the transmission angle, without sign.
    #[inline]
    pub(super) fn sine(&self) -> f64 {
        (self.product * self.inverse_lengths).abs()
    }

    /// Distance of the dyad from a singular pose. Velocities must be known.
    #[inline]
    pub(super) fn clearance(&self, motions: &[Motion]) -> SingularityDistance {
        self.clearance_with(0.0, motions)
    }

    /// [`Rrr::clearance`] of a dyad whose bodies change their shape: the vectors between outer and inner joint turn in
    /// the frames of their links. `shape` (rad/s) is the rate of the second vector minus the rate of the first vector.
    #[inline]
    pub(super) fn clearance_with(&self, shape: f64, motions: &[Motion]) -> SingularityDistance {
        let [r1, r2] = self.spans;
        let (sine, cosine) = (self.product * self.inverse_lengths, r1.dot(&r2) * self.inverse_lengths);
        let turn = motions[self.arms[1].link].omega - motions[self.arms[0].link].omega + shape;
        SingularityDistance { sine: sine.abs(), rate: sine.signum() * cosine * turn }
    }

    #[inline]
    pub(super) fn velocities(&mut self, motions: &mut [Motion]) {
        self.velocities_with([Vec2::zeros(); 2], motions);
    }

    /// Like [`Rrr::velocities`], but the inner joint also moves relative to the two links.
    /// `extra` contains these relative velocities (m/s).
    #[inline]
    pub(super) fn velocities_with(&mut self, extra: [Vec2; 2], motions: &mut [Motion]) {
        let [r1, r2] = self.spans;
        self.inverse = 1.0 / self.product;
        let [v1, v2] = [0, 1].map(|k| motions[self.arms[k].base.link].velocity_beyond(self.bases[k]));
        let quotient = ((v2 + extra[1]) - (v1 + extra[0])) * self.inverse;
        for (k, (v, omega)) in [(v1, quotient.dot(&r2)), (v2, quotient.dot(&r1))].into_iter().enumerate() {
            let motion = &mut motions[self.arms[k].link];
            motion.omega = omega;
            motion.velocity = v - turned(self.outers[k]) * omega;
        }
    }

    #[inline]
    pub(super) fn accelerations(&self, motions: &mut [Motion]) {
        self.accelerations_with([Vec2::zeros(); 2], motions);
    }

    /// Like [`Rrr::accelerations`], but the inner joint has the additional accelerations `extra` (m/s^2) on the two
    /// links.
    #[inline]
    pub(super) fn accelerations_with(&self, extra: [Vec2; 2], motions: &mut [Motion]) {
        let [r1, r2] = self.spans;
        let [a1, a2] = [0, 1].map(|k| motions[self.arms[k].base.link].acceleration_beyond(self.bases[k]));
        let [w1, w2] = self.arms.map(|arm| motions[arm.link].omega);
        let quotient = ((a2 - r2 * (w2 * w2) + extra[1]) - (a1 - r1 * (w1 * w1) + extra[0])) * self.inverse;
        for (k, (a, alpha)) in [(a1, quotient.dot(&r2)), (a2, quotient.dot(&r1))].into_iter().enumerate() {
            let motion = &mut motions[self.arms[k].link];
            let outer = self.outers[k];
            motion.alpha = alpha;
            motion.acceleration = a - turned(outer) * alpha + outer * (motion.omega * motion.omega);
        }
    }
}
