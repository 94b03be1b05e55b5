//! The equations of driving links and RRR dyads for several poses at once.
//!
//! The motion is computed with the equations of [`crate::assur::groups::Rrr`], the forces with the equations of the
//! module `assur::forces`.
//! The sources of the equations are named in these two modules.
//! The arm of a force is the vector from the link's pole in the link's frame, so that no world positions are needed.

use pulp::Simd;

use super::bodies::Body;
use super::groups::{Arm, Driver, Dyad, Groups, Part};
use super::lanes::{Lanes, Plane, Window};
use super::poses::{ACCELERATION, ALPHA, DIRECTION, OMEGA, ORIGIN, VELOCITY};
use linkage::math::Vec2;
use linkage::trajectory::Stage;

/// Acceleration of the tip of the vector v on a rotating link, relative to the foot of v.
/// This acceleration is v rotated by 90 degrees, times alpha, minus omega^2 v.
#[inline(always)]
pub(super) fn swung<S: Simd>(v: Plane<S>, omega: Lanes<S>, alpha: Lanes<S>) -> Plane<S> {
    v.turned() * alpha - v * (omega * omega)
}

impl Groups {
    /// Computes the motion of all links up to the stage `deepest`.
    /// Directions and rates of the driving links must already be in their columns.
    #[inline(always)]
    pub(super) fn move_links<S: Simd>(&self, deepest: Stage, tile: &mut Window<S>, work: &mut Window<S>) {
        for driver in &self.drivers {
            driver.turn(deepest, tile);
        }
        // `reach` becomes NaN as soon as one group cannot be assembled.
        let mut reach = Lanes::splat(tile.simd, 0.0);
        for (part, first) in &self.parts {
            let own = match part {
                Part::Dyad(dyad) => dyad.turn(deepest, tile, work, *first),
                Part::Chain(chain) => chain.turn(deepest, tile, work, *first),
            };
            reach = reach + own;
        }
        tile.put(self.layout.reach(), reach);
    }

    /// Computes the reactions from the last group to the first, then the reactions and balancing moments of the driving
    /// links.
    #[inline(always)]
    pub(super) fn load_joints<S: Simd>(&self, tile: &mut Window<S>, work: &mut Window<S>) {
        for (part, first) in self.parts.iter().rev() {
            match part {
                Part::Dyad(dyad) => dyad.hold(self.gravity, tile, work, *first),
                Part::Chain(chain) => chain.hold(self.gravity, tile, work, *first),
            }
        }
        for (index, driver) in self.drivers.iter().enumerate() {
            let (force, moment) = driver.body.resultant(self.gravity, tile);
            tile.put_vector(driver.reaction.force, force * -driver.reaction.sign);
            tile.put(self.layout.torque(index), -moment);
        }
    }
}

impl Driver {
    #[inline(always)]
    fn turn<S: Simd>(&self, deepest: Stage, tile: &mut Window<S>) {
        let link = self.body.link;
        let arm = tile.vector(link + DIRECTION).rotate(-self.pivot);
        tile.put_vector(link + ORIGIN, arm + self.ground);
        if deepest >= Stage::Velocities {
            tile.put_vector(link + VELOCITY, arm.turned() * tile.get(link + OMEGA));
        }
        if deepest >= Stage::Accelerations {
            let (omega, alpha) = (tile.get(link + OMEGA), tile.get(link + ALPHA));
            tile.put_vector(link + ACCELERATION, swung(arm, omega, alpha));
        }
    }
}

impl Arm {
    /// World vector from the base link's origin to the outer joint, and the first column of the base link (`None` for
    /// the ground).
    #[inline(always)]
    fn base<S: Simd>(&self, tile: &Window<S>) -> (Plane<S>, Option<usize>) {
        match self.base {
            (Some(base), local) => (tile.vector(base + DIRECTION).rotate(local), Some(base)),
            (None, local) => (Plane::splat(tile.simd, local), None),
        }
    }

    /// World position of the outer joint.
    #[inline(always)]
    fn place<S: Simd>(&self, tile: &Window<S>) -> Plane<S> {
        let (arm, base) = self.base(tile);
        base.map_or(arm, |base| tile.vector(base + ORIGIN) + arm)
    }

    /// Velocity of the outer joint.
    #[inline(always)]
    fn velocity<S: Simd>(&self, tile: &Window<S>) -> Plane<S> {
        match self.base(tile) {
            (arm, Some(base)) => tile.vector(base + VELOCITY) + arm.turned() * tile.get(base + OMEGA),
            (_, None) => Plane::splat(tile.simd, Vec2::zeros()),
        }
    }

    /// Acceleration of the outer joint.
    #[inline(always)]
    fn acceleration<S: Simd>(&self, tile: &Window<S>) -> Plane<S> {
        match self.base(tile) {
            (arm, Some(base)) => {
                tile.vector(base + ACCELERATION) + swung(arm, tile.get(base + OMEGA), tile.get(base + ALPHA))
            }
            (_, None) => Plane::splat(tile.simd, Vec2::zeros()),
        }
    }
}

impl Dyad {
    /// Computes the motion of both links. Returns NaN for poses that cannot be assembled.
    #[inline(always)]
    fn turn<S: Simd>(&self, deepest: Stage, tile: &mut Window<S>, work: &mut Window<S>, column: usize) -> Lanes<S> {
        let [first, second] = &self.arms;
        let [p1, p2] = [first.place(tile), second.place(tile)];
        let d = p2 - p1;
        let d_squared = d.dot(d);
        let along = (d_squared + (first.squared - second.squared)) * 0.5 / d_squared;
        let across = (Lanes::splat(tile.simd, first.squared) / d_squared - along * along).sqrt();
        let r1 = d * along + d.turned() * (across * self.side);
        let r2 = r1 - d;
        // Vectors from the outer joints to the origins of the links' frames.
        let mut arms = [r1, r2];
        for ((arm, pivot), back) in self.arms.iter().zip([p1, p2]).zip(&mut arms) {
            let (r, link, span) = (*back, arm.body.link, arm.span);
            let direction = r.rotate(Vec2::new(span.x, -span.y)) * arm.inverse_squared;
            *back = direction.rotate(-arm.outer);
            tile.put_vector(link + DIRECTION, direction);
            tile.put_vector(link + ORIGIN, pivot + *back);
        }
        if deepest >= Stage::Velocities {
            let inverse = r1.cross(r2).inverse();
            let [v1, v2] = [first.velocity(tile), second.velocity(tile)];
            let quotient = (v2 - v1) * inverse;
            let [w1, w2] = [quotient.dot(r2), quotient.dot(r1)];
            for (((arm, back), v), omega) in self.arms.iter().zip(arms).zip([v1, v2]).zip([w1, w2]) {
                tile.put(arm.body.link + OMEGA, omega);
                tile.put_vector(arm.body.link + VELOCITY, v + back.turned() * omega);
            }
            if deepest >= Stage::Accelerations {
                let [a1, a2] = [first.acceleration(tile), second.acceleration(tile)];
                let quotient = ((a2 - r2 * (w2 * w2)) - (a1 - r1 * (w1 * w1))) * inverse;
                let [e1, e2] = [quotient.dot(r2), quotient.dot(r1)];
                let rates = [(a1, w1, e1), (a2, w2, e2)];
                for ((arm, back), (a, omega, alpha)) in self.arms.iter().zip(arms).zip(rates) {
                    tile.put(arm.body.link + ALPHA, alpha);
                    tile.put_vector(arm.body.link + ACCELERATION, a + swung(back, omega, alpha));
                }
            }
            work.put_vector(column, r1);
            work.put_vector(column + 2, r2);
            work.put(column + 4, inverse);
        }
        across
    }

    /// Computes the reactions in the three joints.
    #[inline(always)]
    fn hold<S: Simd>(&self, gravity: Vec2, tile: &mut Window<S>, work: &Window<S>, column: usize) {
        let [first, second] = &self.arms;
        let (r1, r2, inverse) = (work.vector(column), work.vector(column + 2), work.get(column + 4));
        let (force_a, moment_a) = first.body.resultant(gravity, tile);
        let (force_b, moment_b) = second.body.resultant(gravity, tile);
        let total = force_a + force_b;
        let reaction = (r1 * (moment_b + r2.cross(total)) + r2 * moment_a) * inverse;
        tile.put_vector(first.reaction.force, reaction * first.reaction.sign);
        tile.put_vector(second.reaction.force, (reaction + total) * -second.reaction.sign);
        tile.put_vector(self.inner.force, (reaction + force_a) * -self.inner.sign);
    }
}

impl Body {
    /// Returns the resultant of all known forces on the link and their moment about the pole.
    #[inline(always)]
    pub(super) fn resultant<S: Simd>(&self, gravity: Vec2, tile: &Window<S>) -> (Plane<S>, Lanes<S>) {
        let direction = tile.vector(self.link + DIRECTION);
        let (omega, alpha) = (tile.get(self.link + OMEGA), tile.get(self.link + ALPHA));
        let centre = tile.vector(self.link + ACCELERATION) + swung(direction.rotate(self.mass_centre), omega, alpha);
        let mut force = -(centre + -gravity) * self.mass;
        let mut moment = direction.rotate(self.centre).cross(force) - alpha * self.inertia;
        for load in &self.loads {
            moment = moment + omega.map(|omega| load.moment_in(omega, 0.0));
        }
        for action in &self.hanging {
            let hung = tile.vector(action.force) * action.sign;
            force = force + hung;
            moment = moment + direction.rotate(action.arm).cross(hung);
        }
        (force, moment)
    }
}
