//! The equations of driving links and RRR dyads for several poses at once.
//!
//! The motion is computed with the equations of [`crate::assur::groups::Rrr`], the forces with the equations of the
//! module `assur::forces`.
//! The sources of the equations are named in these two modules.
//! If the motion of the driving links is the same bit for bit, the results equal those of the two modules bit for bit.

use super::bodies::Body;
use super::groups::{Arm, Driver, Dyad, Groups, Part};
use super::lanes::{Lanes, Plane, Window};
use super::poses::{ACCELERATION, ALPHA, DIRECTION, OMEGA, ORIGIN, VELOCITY};
use super::registers::Registers;
use linkage::case::STANDSTILL;
use linkage::math::Vec2;
use linkage::trajectory::Stage;

/// Higher groups are not solved on pairs of registers, because compiling their unrolled elimination would then take
/// minutes.
const NO_CHAINS: &str = "higher groups are solved on single registers";

/// Acceleration of the tip of the vector v on a rotating link, relative to the foot of v.
/// This acceleration is v rotated by 90 degrees, times alpha, minus omega^2 v.
#[inline(always)]
pub(super) fn swung<R: Registers>(v: Plane<R>, omega: Lanes<R>, alpha: Lanes<R>) -> Plane<R> {
    v.turned() * alpha - v * (omega * omega)
}

impl Groups {
    /// Computes the motion of all links up to the stage `deepest`.
    /// Directions and rates of the driving links must already be in their columns.
    #[inline(always)]
    pub(super) fn move_links<R: Registers>(&self, deepest: Stage, tile: &mut Window<R>, work: &mut Window<R>) {
        for driver in &self.drivers {
            driver.turn(deepest, tile);
        }
        // `reach` becomes NaN as soon as one group cannot be assembled.
        let mut reach = Lanes::splat(tile.on, 0.0);
        for (part, first) in &self.parts {
            let own = match part {
                Part::Dyad(dyad) => dyad.turn(deepest, tile, work, *first),
                Part::Chain(chain) if !R::IS_PAIR => chain.turn(deepest, tile, work, *first),
                Part::Chain(_) => unreachable!("{NO_CHAINS}"),
            };
            reach = reach + own;
        }
        tile.put(self.layout.reach(), reach);
    }

    /// Returns NaN for poses in which the angular velocity of a link with a moment of resistance may be a rounding
    /// error.
    /// Returns 0 for all other poses.
    #[inline(always)]
    pub(super) fn standstill<R: Registers>(&self, tile: &Window<R>) -> Lanes<R> {
        let (zero, doubt) = (Lanes::splat(tile.on, 0.0), Lanes::splat(tile.on, f64::NAN));
        let mut found = zero;
        for loaded in self.bodies().filter(|body| body.resistance.is_some()) {
            let speed = tile.get(loaded.link + OMEGA).abs();
            for other in self.bodies() {
                let least = tile.get(other.link + OMEGA).abs() * STANDSTILL;
                found = found + speed.exceeds(least).of(zero, doubt);
            }
        }
        found
    }

    /// Computes the reactions from the last group to the first, then the reactions and balancing moments of the driving
    /// links.
    #[inline(always)]
    pub(super) fn load_joints<R: Registers>(&self, tile: &mut Window<R>, work: &mut Window<R>) {
        for (part, first) in self.parts.iter().rev() {
            match part {
                Part::Dyad(dyad) => dyad.hold(self.gravity, tile, work, *first),
                Part::Chain(chain) if !R::IS_PAIR => chain.hold(self.gravity, tile, work, *first),
                Part::Chain(_) => unreachable!("{NO_CHAINS}"),
            }
        }
        for (index, driver) in self.drivers.iter().enumerate() {
            let (force, moment) = driver.body.resultant(self.gravity, driver.pole(tile), tile);
            tile.put_vector(driver.reaction.force, force * -driver.reaction.sign);
            tile.put(self.layout.torque(index), -moment);
        }
    }
}

impl Driver {
    #[inline(always)]
    fn turn<R: Registers>(&self, deepest: Stage, tile: &mut Window<R>) {
        let link = self.body.link;
        let zero = Plane::splat(tile.on, Vec2::zeros());
        let (is_plain, ground) = (self.pivot == Vec2::zeros(), Plane::splat(tile.on, self.ground));
        let arm = tile.vector(link + DIRECTION).rotate(-self.pivot);
        tile.put_vector(link + ORIGIN, if is_plain { ground } else { arm + self.ground });
        if deepest >= Stage::Velocities {
            let velocity = if is_plain { zero } else { arm.turned() * tile.get(link + OMEGA) };
            tile.put_vector(link + VELOCITY, velocity);
        }
        if deepest >= Stage::Accelerations {
            let (omega, alpha) = (tile.get(link + OMEGA), tile.get(link + ALPHA));
            let acceleration = if is_plain { zero } else { swung(arm, omega, alpha) };
            tile.put_vector(link + ACCELERATION, acceleration);
        }
    }

    /// World position of the joint on the ground.
    #[inline(always)]
    fn pole<R: Registers>(&self, tile: &Window<R>) -> Plane<R> {
        match self.pivot == Vec2::zeros() {
            true => tile.vector(self.body.link + ORIGIN),
            false => self.body.point(self.pivot, tile),
        }
    }
}

impl Arm {
    /// Position, velocity and acceleration of the outer joint, in world axes. Quantities beyond the stage `deepest` are
    /// 0.
    #[inline(always)]
    fn base<R: Registers>(&self, deepest: Stage, tile: &Window<R>) -> [Plane<R>; 3] {
        let zero = Plane::splat(tile.on, Vec2::zeros());
        let (Some(base), local) = self.base else { return [Plane::splat(tile.on, self.base.1), zero, zero] };
        let vector = tile.vector(base + DIRECTION).rotate(local);
        let place = tile.vector(base + ORIGIN) + vector;
        if deepest < Stage::Velocities {
            return [place, zero, zero];
        }
        let omega = tile.get(base + OMEGA);
        let velocity = tile.vector(base + VELOCITY) + vector.turned() * omega;
        if deepest < Stage::Accelerations {
            return [place, velocity, zero];
        }
        let alpha = tile.get(base + ALPHA);
        let acceleration = tile.vector(base + ACCELERATION) + vector.turned() * alpha - vector * (omega * omega);
        [place, velocity, acceleration]
    }
}

impl Dyad {
    /// Computes the motion of both links. Returns r1 x r2 (m^2), or NaN for poses that cannot be assembled.
    /// The operations and their order are the same as in [`crate::assur::groups::Rrr`], so that the bits are the same.
    #[inline(always)]
    fn turn<R: Registers>(
        &self,
        deepest: Stage,
        tile: &mut Window<R>,
        work: &mut Window<R>,
        column: usize,
    ) -> Lanes<R> {
        let [first, second] = &self.arms;
        let ([p1, v1, a1], [p2, v2, a2]) = (first.base(deepest, tile), second.base(deepest, tile));
        let d = p2 - p1;
        let d_squared = d.dot(d);
        let along = (d_squared + (first.squared - second.squared)) * 0.5;
        let square = (Lanes::splat(tile.on, self.range[1]) - d_squared) * (d_squared - self.range[0]);
        let product = square.sqrt() * self.half;
        let r1 = (d * along + d.turned() * product) * d_squared.inverse();
        let r2 = r1 - d;
        let inverse = product.inverse();
        let mut rates = [(Lanes::splat(tile.on, 0.0), Lanes::splat(tile.on, 0.0)); 2];
        if deepest >= Stage::Velocities {
            let quotient = (v2 - v1) * inverse;
            rates = [(quotient.dot(r2), rates[0].1), (quotient.dot(r1), rates[1].1)];
        }
        if deepest >= Stage::Accelerations {
            let [w1, w2] = rates.map(|(omega, _)| omega);
            let quotient = ((a2 - r2 * (w2 * w2)) - (a1 - r1 * (w1 * w1))) * inverse;
            rates = [(w1, quotient.dot(r2)), (w2, quotient.dot(r1))];
        }
        let places = [(r1, p1, v1, a1), (r2, p2, v2, a2)];
        for ((arm, (omega, alpha)), (r, p, v, a)) in self.arms.iter().zip(rates).zip(places) {
            let (link, span) = (arm.body.link, Plane::splat(tile.on, arm.inverse_span));
            let direction = Plane { x: span.dot(r), y: span.cross(r) };
            tile.put_vector(link + DIRECTION, direction);
            let is_at_origin = arm.outer == Vec2::zeros();
            let outer = direction.rotate(arm.outer);
            tile.put_vector(link + ORIGIN, if is_at_origin { p } else { p - outer });
            if deepest >= Stage::Velocities {
                tile.put(link + OMEGA, omega);
                tile.put_vector(link + VELOCITY, if is_at_origin { v } else { v - outer.turned() * omega });
            }
            if deepest >= Stage::Accelerations {
                tile.put(link + ALPHA, alpha);
                let square = omega * omega;
                let moved = a - outer.turned() * alpha + outer * square;
                tile.put_vector(link + ACCELERATION, if is_at_origin { a } else { moved });
            }
        }
        work.put_vector(column, r1);
        work.put_vector(column + 2, r2);
        work.put(column + 4, inverse);
        work.put_vector(column + 5, p1 + r1);
        product
    }

    /// Returns 0 where the pose and the motion to the next pose are clear of dead points, elsewhere NaN.
    /// The sine of the transmission angle is s = (r1 x r2) / (l1 l2).
    /// The rate of s is s' = (r1 . r2) (omega2 - omega1) / (l1 l2), and `pace` (s) is the time between two poses.
    /// The magnitude |s| must be larger than `least`, and |s'| times `pace` smaller than `share` times |s|.
    #[inline(always)]
    pub(super) fn doubt<R: Registers>(
        &self,
        pace: f64,
        [least, share]: [f64; 2],
        tile: &Window<R>,
        work: &Window<R>,
        column: usize,
    ) -> Lanes<R> {
        let (r1, r2) = (work.vector(column), work.vector(column + 2));
        let turn = tile.get(self.arms[1].body.link + OMEGA) - tile.get(self.arms[0].body.link + OMEGA);
        let product = r1.cross(r2).abs();
        let change = (r1.dot(r2) * turn).abs() * (pace / share);
        let (clear, unclear) = (Lanes::splat(tile.on, 0.0), Lanes::splat(tile.on, f64::NAN));
        let far = product.exceeds(Lanes::splat(tile.on, least * self.product)).of(clear, unclear);
        product.exceeds(change).of(far, unclear)
    }

    /// Computes the reactions in the three joints.
    #[inline(always)]
    fn hold<R: Registers>(&self, gravity: Vec2, tile: &mut Window<R>, work: &Window<R>, column: usize) {
        let [first, second] = &self.arms;
        let (r1, r2, inverse) = (work.vector(column), work.vector(column + 2), work.get(column + 4));
        let pole = work.vector(column + 5);
        let (force_a, moment_a) = first.body.resultant(gravity, pole, tile);
        let (force_b, moment_b) = second.body.resultant(gravity, pole, tile);
        let total = force_a + force_b;
        let reaction = (r1 * (moment_b + r2.cross(total)) + r2 * moment_a) * inverse;
        tile.put_vector(first.reaction.force, reaction * first.reaction.sign);
        tile.put_vector(second.reaction.force, (reaction + total) * -second.reaction.sign);
        tile.put_vector(self.inner.force, (reaction + force_a) * -self.inner.sign);
    }
}

impl Body {
    /// World position of a point of the link.
    #[inline(always)]
    pub(super) fn point<R: Registers>(&self, local: Vec2, tile: &Window<R>) -> Plane<R> {
        tile.vector(self.link + ORIGIN) + tile.vector(self.link + DIRECTION).rotate(local)
    }

    /// Returns the resultant of all known forces on the link and their moment about the world point `pole`.
    /// The operations and their order are the same as in the module `assur::forces`.
    #[inline(always)]
    pub(super) fn resultant<R: Registers>(
        &self,
        gravity: Vec2,
        pole: Plane<R>,
        tile: &Window<R>,
    ) -> (Plane<R>, Lanes<R>) {
        let (origin, direction) = (tile.vector(self.link + ORIGIN), tile.vector(self.link + DIRECTION));
        let (omega, alpha) = (tile.get(self.link + OMEGA), tile.get(self.link + ALPHA));
        let arm = direction.rotate(self.mass_centre);
        let acceleration = tile.vector(self.link + ACCELERATION) + arm.turned() * alpha - arm * (omega * omega);
        let mut force = (Plane::splat(tile.on, gravity) - acceleration) * self.mass;
        let mut moment = alpha * -self.inertia;
        if let Some(size) = self.resistance {
            let zero = Lanes::splat(tile.on, 0.0);
            let backwards = zero.exceeds(omega).of(zero + size, zero);
            force = force + Vec2::zeros();
            moment = moment + omega.exceeds(zero).of(zero - size, backwards);
        }
        moment = moment + (origin + arm - pole).cross(force);
        for action in &self.hanging {
            let hung = tile.vector(action.force) * action.sign;
            force = force + hung;
            let place = if action.place == Vec2::zeros() { origin } else { origin + direction.rotate(action.place) };
            moment = moment + (place - pole).cross(hung);
        }
        (force, moment)
    }
}
