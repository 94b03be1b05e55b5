//! The equations of driving links and RRR dyads for several poses at once.
//!
//! The motion is computed with the equations of [`crate::assur::groups::Rrr`], the forces with the equations of the
//! module `assur::forces`.
//! The sources of the equations are named in these two modules.
//! If the motion of the driving links is the same bit for bit, the results equal those of the two modules bit for bit.

use super::bodies::Body;
use super::groups::{Arm, Driver, Dyad, Groups, Part};
use super::lanes::{Lanes, Plane, TILE, TileColumn, Window};
use super::poses::{ACCELERATION, ALPHA, DIRECTION, LinkMotion, OMEGA, ORIGIN, VELOCITY};
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
    /// Returns the sum of `check` over the dyads; NaN as soon as one group cannot be assembled.
    #[inline(always)]
    pub(super) fn move_links<R: Registers>(
        &self,
        deepest: Stage,
        check: impl DyadCheck,
        tile: &mut Window<R>,
        work: &mut Window<R>,
    ) -> Lanes<R> {
        for driver in &self.drivers {
            driver.turn(deepest, tile);
        }
        let mut found = Lanes::splat(tile.on, 0.0);
        for (part, first) in &self.parts {
            let own = match part {
                Part::Dyad(dyad) => check.of(dyad, &dyad.turn(deepest, tile, work, *first)),
                Part::Chain(chain) if !R::IS_PAIR => chain.turn(deepest, tile, work, *first),
                Part::Chain(_) => unreachable!("{NO_CHAINS}"),
            };
            found = found + own;
        }
        found
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
    /// Whether the link's origin is at the joint on the ground.
    fn is_plain(&self) -> bool {
        self.reaction.place == Vec2::zeros()
    }

    /// Writes the columns that are the same in all rows of a tile: the rates of the link and, if its origin is at
    /// rest, the motion of the origin.
    pub(super) fn fix(&self, tile: &mut [TileColumn], omega: f64, alpha: f64) {
        let mut put = |column: usize, value: f64| tile[self.body.link + column] = TileColumn([value; TILE]);
        put(OMEGA, omega);
        put(ALPHA, alpha);
        if self.is_plain() {
            put(ORIGIN, self.ground.x);
            put(ORIGIN + 1, self.ground.y);
            (0..2).for_each(|axis| put(VELOCITY + axis, 0.0));
            (0..2).for_each(|axis| put(ACCELERATION + axis, 0.0));
        }
    }

    /// Computes the motion of the origin, if it is not at rest.
    #[inline(always)]
    fn turn<R: Registers>(&self, deepest: Stage, tile: &mut Window<R>) {
        if self.is_plain() {
            return;
        }
        let mut link = tile.link(self.body.link);
        let arm = link.direction.rotate(-self.reaction.place);
        link.origin = arm + self.ground;
        link.velocity = arm.turned() * link.omega;
        link.acceleration = swung(arm, link.omega, link.alpha);
        tile.put_link(self.body.link, deepest, &link);
    }

    /// World position of the joint on the ground.
    #[inline(always)]
    fn pole<R: Registers>(&self, tile: &Window<R>) -> Plane<R> {
        match self.is_plain() {
            true => tile.vector(self.body.link + ORIGIN),
            false => self.body.point(self.reaction.place, tile),
        }
    }
}

impl Arm {
    /// Position, velocity and acceleration of the outer joint, in world axes. Quantities beyond the stage that is
    /// solved are meaningless.
    #[inline(always)]
    fn base<R: Registers>(&self, tile: &Window<R>) -> [Plane<R>; 3] {
        let zero = Plane::splat(tile.on, Vec2::zeros());
        let (Some(base), local) = self.base else { return [Plane::splat(tile.on, self.base.1), zero, zero] };
        let link = tile.link(base);
        link.at(link.direction.rotate(local))
    }

    /// Writes the motion of the link. `span` is the vector from outer to inner joint, and `[p, v, a]` are position,
    /// velocity and acceleration of the outer joint, all in world axes.
    #[inline(always)]
    fn put<R: Registers>(
        &self,
        deepest: Stage,
        tile: &mut Window<R>,
        span: Plane<R>,
        [p, v, a]: [Plane<R>; 3],
        [omega, alpha]: [Lanes<R>; 2],
    ) {
        let own = Plane::splat(tile.on, self.inverse_span);
        let direction = Plane { x: own.dot(span), y: own.cross(span) };
        let mut link = LinkMotion { origin: p, direction, velocity: v, acceleration: a, omega, alpha };
        if self.reaction.place != Vec2::zeros() {
            let outer = direction.rotate(self.reaction.place);
            link.origin = p - outer;
            link.velocity = v - outer.turned() * omega;
            link.acceleration = a - outer.turned() * alpha + outer * (omega * omega);
        }
        tile.put_link(self.body.link, deepest, &link);
    }
}

/// A dyad in its pose.
pub(super) struct DyadPose<R: Registers> {
    /// The vectors r1 and r2 from the outer joints to the inner joint, in world axes (m).
    spans: [Plane<R>; 2],
    /// r1 x r2 (m^2); NaN for poses that cannot be assembled.
    product: Lanes<R>,
    /// Angular velocities of the links (rad/s).
    omega: [Lanes<R>; 2],
}

/// A check of every dyad in every pose.
pub(super) trait DyadCheck: Copy {
    /// NaN for poses that cannot be assembled.
    fn of<R: Registers>(self, dyad: &Dyad, pose: &DyadPose<R>) -> Lanes<R>;
}

/// Only whether the dyad can be assembled.
#[derive(Clone, Copy)]
pub(super) struct Reach;

impl DyadCheck for Reach {
    #[inline(always)]
    fn of<R: Registers>(self, _: &Dyad, pose: &DyadPose<R>) -> Lanes<R> {
        pose.product
    }
}

/// Whether the pose and the motion to the next pose are clear of dead points.
/// The sine of the transmission angle is s = (r1 x r2) / (l1 l2).
/// The rate of s is s' = (r1 . r2) (omega2 - omega1) / (l1 l2).
#[derive(Clone, Copy)]
pub(super) struct Clearance {
    /// Time between two poses (s).
    pub(super) pace: f64,
    /// |s| must be larger than this.
    pub(super) least: f64,
    /// |s'| times `pace` must be smaller than this share of |s|.
    pub(super) share: f64,
}

impl DyadCheck for Clearance {
    /// 0 where the dyad is clear, elsewhere NaN.
    #[inline(always)]
    fn of<R: Registers>(self, dyad: &Dyad, pose: &DyadPose<R>) -> Lanes<R> {
        let ([r1, r2], [w1, w2]) = (pose.spans, pose.omega);
        let product = pose.product.abs();
        let change = (r1.dot(r2) * (w2 - w1)).abs() * (self.pace / self.share);
        let (clear, unclear) = (Lanes::splat(w1.on, 0.0), Lanes::splat(w1.on, f64::NAN));
        let far = product.exceeds(Lanes::splat(w1.on, self.least * dyad.product)).of(clear, unclear);
        product.exceeds(change).of(far, unclear)
    }
}

impl Dyad {
    /// Computes the motion of both links.
    /// The operations and their order are the same as in [`crate::assur::groups::Rrr`], so that the bits are the same.
    #[inline(always)]
    fn turn<R: Registers>(
        &self,
        deepest: Stage,
        tile: &mut Window<R>,
        work: &mut Window<R>,
        column: usize,
    ) -> DyadPose<R> {
        let [first, second] = &self.arms;
        let (base1, base2) = (first.base(tile), second.base(tile));
        let ([p1, v1, a1], [p2, v2, a2]) = (base1, base2);
        let d = p2 - p1;
        let d_squared = d.dot(d);
        let along = (d_squared + (first.squared - second.squared)) * 0.5;
        let square = (Lanes::splat(tile.on, self.range[1]) - d_squared) * (d_squared - self.range[0]);
        let product = square.sqrt() * self.half;
        let r1 = (d * along + d.turned() * product) * d_squared.inverse();
        let r2 = r1 - d;
        let inverse = product.inverse();
        let [mut omega, mut alpha] = [[Lanes::splat(tile.on, 0.0); 2]; 2];
        if deepest >= Stage::Velocities {
            let quotient = (v2 - v1) * inverse;
            omega = [quotient.dot(r2), quotient.dot(r1)];
        }
        if deepest >= Stage::Accelerations {
            let [w1, w2] = omega;
            let quotient = ((a2 - r2 * (w2 * w2)) - (a1 - r1 * (w1 * w1))) * inverse;
            alpha = [quotient.dot(r2), quotient.dot(r1)];
        }
        first.put(deepest, tile, r1, base1, [omega[0], alpha[0]]);
        second.put(deepest, tile, r2, base2, [omega[1], alpha[1]]);
        let pole = p1 + r1;
        work.put_vector(column, r1);
        work.put_vector(column + 2, r2);
        work.put(column + 4, inverse);
        work.put_vector(column + 5, pole);
        DyadPose { spans: [r1, r2], product, omega }
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
        let link = tile.link(self.link);
        let LinkMotion { origin, direction, omega, alpha, .. } = link;
        let arm = direction.rotate(self.mass_centre);
        let [_, _, acceleration] = link.at(arm);
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
