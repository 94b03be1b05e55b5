//! The equations of driving links and RRR dyads for several poses at once.
//!
//! The motion is computed with the equations of [`crate::assur::groups::Rrr`], the forces with the equations of the
//! module `assur::forces`.
//! The sources of the equations are named in these two modules.
//! If the motion of the driving links is the same bit for bit, the results equal those of the two modules bit for bit.

use super::groups::{Arm, Driver, Dyad, Groups, OF_DYAD, POLE, Part};
use super::lanes::{Columns, Lanes, Plane, TILE, Tile, Window};
use super::loads::LoadColumns;
use super::poses::{ACCELERATION, ALPHA, LinkColumns, LinkMotion, OMEGA, ORIGIN, VELOCITY};
use crate::assur::groups::SINGULAR;
use linkage::case::STANDSTILL;
use linkage::math::Vec2;
use linkage::trajectory::Stage;
use pulp::Simd;

/// Without `CHAINS`, the equations of higher groups are not compiled, because they make the others slower.
const NO_CHAINS: &str = "cases with higher groups are solved with their equations";

/// Acceleration of the tip of the vector v on a rotating link, relative to the foot of v.
/// This acceleration is v rotated by 90 degrees, times alpha, minus omega^2 v.
#[inline(always)]
pub(super) fn swung<S: Simd>(v: Plane<S>, omega: Lanes<S>, alpha: Lanes<S>) -> Plane<S> {
    v.turned() * alpha - v * (omega * omega)
}

impl Groups {
    /// Computes the motion of all links up to the stage `deepest`.
    /// Directions and rates of the driving links must already be in their columns.
    /// Returns 0, or NaN if a group fails its check in any pose.
    /// With [`DyadCheck::BY_POSE`], the column [`Layout::reach`](super::poses::Layout::reach) becomes 0, or NaN for
    /// poses in which a group fails its check.
    ///
    /// Every step runs over all poses of the tile before the next step begins, so that the processor can work at
    /// several poses while it waits for a square root or a division.
    /// Cases with higher groups need `CHAINS`.
    #[inline(always)]
    pub(super) fn move_links<S: Simd, const CHAINS: bool, C: DyadCheck>(
        &self,
        deepest: Stage,
        check: C,
        tile: Tile<S>,
        work: Tile<S>,
    ) -> Lanes<S> {
        let mut reach =
            Reached { column: tile.columns.column(self.layout.reach()), all: Lanes::splat(tile.columns.on, 0.0) };
        if C::BY_POSE {
            for part in tile.parts() {
                reach.column.put(0, part, reach.all);
            }
        }
        for driver in &self.drivers {
            driver.turn(deepest, tile);
        }
        for (group, first) in &self.parts {
            match group {
                Part::Dyad(dyad) => {
                    let work = work.columns.adjacent::<OF_DYAD>(*first);
                    dyad.move_links(deepest, check, tile, work, &mut reach);
                }
                Part::Chain(chain) if CHAINS => {
                    for part in tile.parts() {
                        let found = chain.turn(deepest, tile.window(part), work.window(part), *first);
                        reach.add::<C>(part, found);
                    }
                }
                Part::Chain(_) => unreachable!("{NO_CHAINS}"),
            }
        }
        reach.all
    }

    /// Returns NaN for poses in which the angular velocity of a link with a moment of resistance may be a rounding
    /// error.
    /// Returns 0 for all other poses.
    #[inline(always)]
    pub(super) fn standstill<S: Simd>(&self, tile: Window<S>) -> Lanes<S> {
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
    /// links. Cases with higher groups need `CHAINS`.
    #[inline(always)]
    pub(super) fn load_joints<S: Simd, const CHAINS: bool>(&self, tile: Tile<S>, work: Tile<S>) {
        for (group, first) in self.parts.iter().rev() {
            match group {
                Part::Dyad(dyad) => dyad.hold(self.gravity, tile, work.columns, *first),
                Part::Chain(chain) if CHAINS => {
                    chain.load(self.gravity, tile, work.columns);
                    for part in tile.parts() {
                        chain.hold(tile.window(part), work.window(part), *first);
                    }
                }
                Part::Chain(_) => unreachable!("{NO_CHAINS}"),
            }
        }
        let load = LoadColumns::of(work.columns, 0);
        for (index, driver) in self.drivers.iter().enumerate() {
            driver.body.load_about(driver.reaction.place, self.gravity, tile, load);
            let reaction = tile.columns.adjacent::<2>(driver.reaction.force);
            let (torque, sign) = (tile.columns.column(self.layout.torque(index)), -driver.reaction.sign);
            for part in tile.parts() {
                let (force, moment) = load.get(part);
                reaction.put_vector(0, part, force.signed(sign));
                torque.put(0, part, -moment);
            }
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
    pub(super) fn fix(&self, tile: &mut [f64], omega: f64, alpha: f64) {
        let mut put = |column: usize, value: f64| tile[(self.body.link + column) * TILE..][..TILE].fill(value);
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
    fn turn<S: Simd>(&self, deepest: Stage, tile: Tile<S>) {
        if self.is_plain() {
            return;
        }
        let columns = tile.columns.link(self.body.link);
        for part in tile.parts() {
            let mut link = columns.get(part);
            let arm = link.direction.rotate(-self.reaction.place);
            link.origin = arm + self.ground;
            link.velocity = arm.turned() * link.omega;
            link.acceleration = swung(arm, link.omega, link.alpha);
            columns.put(deepest, part, &link);
        }
    }
}

/// The outer joint of a dyad, on the link outside the dyad.
trait OuterJoint<S: Simd>: Copy {
    /// Position, velocity and acceleration of the joint, in world axes. Quantities beyond the stage that is solved are
    /// meaningless.
    fn at(self, part: usize) -> [Plane<S>; 3];
}

/// A joint on the ground.
#[derive(Clone, Copy)]
struct OnGround<S: Simd>(Plane<S>);

/// A joint on a moving link, and its position on the link.
#[derive(Clone, Copy)]
struct OnLink<'a, S: Simd>(LinkColumns<'a, S>, Vec2);

impl<S: Simd> OuterJoint<S> for OnGround<S> {
    #[inline(always)]
    fn at(self, _: usize) -> [Plane<S>; 3] {
        let zero = Plane::splat(self.0.x.on, Vec2::zeros());
        [self.0, zero, zero]
    }
}

impl<S: Simd> OuterJoint<S> for OnLink<'_, S> {
    #[inline(always)]
    fn at(self, part: usize) -> [Plane<S>; 3] {
        let link = self.0.get(part);
        link.at(link.direction.rotate(self.1))
    }
}

impl Arm {
    /// Motion of the link, if its origin is at the outer joint. `span` is the vector from outer to inner joint, and
    /// `[p, v, a]` are position, velocity and acceleration of the outer joint, all in world axes.
    #[inline(always)]
    fn motion<S: Simd>(
        &self,
        span: Plane<S>,
        [p, v, a]: [Plane<S>; 3],
        [omega, alpha]: [Lanes<S>; 2],
    ) -> LinkMotion<S> {
        let own = Plane::splat(omega.on, self.inverse_span);
        let direction = Plane { x: own.dot(span), y: own.cross(span) };
        LinkMotion { origin: p, direction, velocity: v, acceleration: a, omega, alpha }
    }

    /// Changes the origin of the link from the outer joint to the origin of the link's frame.
    #[inline(always)]
    fn shift<S: Simd>(&self, deepest: Stage, tile: Tile<S>) {
        if self.reaction.place == Vec2::zeros() {
            return;
        }
        let columns = tile.columns.link(self.body.link);
        for part in tile.parts() {
            let mut link = columns.get(part);
            let outer = link.direction.rotate(self.reaction.place);
            link.origin = link.origin - outer;
            link.velocity = link.velocity - outer.turned() * link.omega;
            link.acceleration = link.acceleration - outer.turned() * link.alpha + outer * (link.omega * link.omega);
            columns.put(deepest, part, &link);
        }
    }
}

/// A dyad in its pose.
pub(super) struct DyadPose<S: Simd> {
    /// The vectors r1 and r2 from the outer joints to the inner joint, in world axes (m).
    spans: [Plane<S>; 2],
    /// r1 x r2 (m^2); NaN for poses that cannot be assembled.
    product: Lanes<S>,
    /// 1 / (r1 x r2) (1/m^2).
    inverse: Lanes<S>,
    /// World position of the inner joint (m).
    pole: Plane<S>,
}

impl<S: Simd> DyadPose<S> {
    #[inline(always)]
    fn put(&self, work: Columns<S>, part: usize) {
        work.put_vector(0, part, self.spans[0]);
        work.put_vector(2, part, self.spans[1]);
        work.put(4, part, self.product);
        work.put(5, part, self.inverse);
        work.put_vector(POLE, part, self.pole);
    }

    #[inline(always)]
    fn of(work: Columns<S>, part: usize) -> Self {
        DyadPose {
            spans: [work.vector(0, part), work.vector(2, part)],
            product: work.get(4, part),
            inverse: work.get(5, part),
            pole: work.vector(POLE, part),
        }
    }
}

/// A check of every dyad in every pose.
pub(super) trait DyadCheck: Copy {
    /// Whether the result for every pose is wanted, and not only whether all poses pass.
    const BY_POSE: bool;

    /// 0, or NaN for poses that fail the check. `omega` are the angular velocities of the dyad's links (rad/s).
    fn of<S: Simd>(self, dyad: &Dyad, pose: &DyadPose<S>, omega: [Lanes<S>; 2]) -> Lanes<S>;
}

/// The results of the checks in a tile.
struct Reached<'a, S: Simd> {
    column: Columns<'a, S>,
    /// 0, or NaN if a check has failed.
    all: Lanes<S>,
}

impl<S: Simd> Reached<'_, S> {
    #[inline(always)]
    fn add<C: DyadCheck>(&mut self, part: usize, found: Lanes<S>) {
        self.all = self.all + found;
        if C::BY_POSE {
            self.column.put(0, part, self.column.get(0, part) + found);
        }
    }
}

/// Only whether the dyad can be assembled, and is not singular.
#[derive(Clone, Copy)]
pub(super) struct Reach;

impl DyadCheck for Reach {
    const BY_POSE: bool = true;

    #[inline(always)]
    fn of<S: Simd>(self, dyad: &Dyad, pose: &DyadPose<S>, [w1, _]: [Lanes<S>; 2]) -> Lanes<S> {
        let (regular, singular) = (Lanes::splat(w1.on, 0.0), Lanes::splat(w1.on, f64::NAN));
        pose.product.abs().exceeds(Lanes::splat(w1.on, SINGULAR * dyad.product)).of(regular, singular)
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
    const BY_POSE: bool = false;

    /// 0 where the dyad is clear, elsewhere NaN.
    #[inline(always)]
    fn of<S: Simd>(self, dyad: &Dyad, pose: &DyadPose<S>, [w1, w2]: [Lanes<S>; 2]) -> Lanes<S> {
        let [r1, r2] = pose.spans;
        let product = pose.product.abs();
        let change = (r1.dot(r2) * (w2 - w1)).abs() * (self.pace / self.share);
        let (clear, unclear) = (Lanes::splat(w1.on, 0.0), Lanes::splat(w1.on, f64::NAN));
        let far = product.exceeds(Lanes::splat(w1.on, self.least * dyad.product)).of(clear, unclear);
        product.exceeds(change).of(far, unclear)
    }
}

impl Dyad {
    /// Computes the motion of both links, and adds the result of the check to `reach`.
    #[inline(always)]
    fn move_links<S: Simd>(
        &self,
        deepest: Stage,
        check: impl DyadCheck,
        tile: Tile<S>,
        work: Columns<S>,
        reach: &mut Reached<S>,
    ) {
        let [first, second] = &self.arms;
        // The equations are compiled for every combination, so that a joint at rest costs nothing.
        macro_rules! solve {
            ($first:expr, $second:expr) => {{
                let joints = ($first, $second);
                self.place(tile, joints, work);
                self.turn(deepest, check, tile, joints, work, reach);
            }};
        }
        let on_link = |link: usize, local: Vec2| OnLink(tile.columns.link(link), local);
        let on_ground = |place: Vec2| OnGround(Plane::splat(work.on, place));
        match (first.base, second.base) {
            ((Some(a), p), (Some(b), q)) => solve!(on_link(a, p), on_link(b, q)),
            ((Some(a), p), (None, q)) => solve!(on_link(a, p), on_ground(q)),
            ((None, p), (Some(b), q)) => solve!(on_ground(p), on_link(b, q)),
            ((None, p), (None, q)) => solve!(on_ground(p), on_ground(q)),
        }
        first.shift(deepest, tile);
        second.shift(deepest, tile);
    }

    /// Computes the positions of the joints, and writes them to the working memory of the dyad.
    /// The operations and their order are the same as in [`crate::assur::groups::Rrr`], so that the bits are the same.
    #[inline(always)]
    fn place<S: Simd>(&self, tile: Tile<S>, outer: (impl OuterJoint<S>, impl OuterJoint<S>), work: Columns<S>) {
        let [first, second] = &self.arms;
        for part in tile.parts() {
            let ([p1, ..], [p2, ..]) = (outer.0.at(part), outer.1.at(part));
            let d = p2 - p1;
            let d_squared = d.dot(d);
            let along = (d_squared + (first.squared - second.squared)) * 0.5;
            let square = (Lanes::splat(work.on, self.range[1]) - d_squared) * (d_squared - self.range[0]);
            let product = square.sqrt() * self.half;
            let r1 = (d * along + d.turned() * product) * d_squared.inverse();
            let pose = DyadPose { spans: [r1, r1 - d], product, inverse: product.inverse(), pole: p1 + r1 };
            pose.put(work, part);
        }
    }

    /// Computes the motion of both links from the positions of the joints. The origins of the links are at the outer
    /// joints. The operations and their order are the same as in [`crate::assur::groups::Rrr`].
    #[inline(always)]
    fn turn<S: Simd, C: DyadCheck>(
        &self,
        deepest: Stage,
        check: C,
        tile: Tile<S>,
        outer: (impl OuterJoint<S>, impl OuterJoint<S>),
        work: Columns<S>,
        reach: &mut Reached<S>,
    ) {
        let [first, second] = &self.arms;
        let (link1, link2) = (tile.columns.link(first.body.link), tile.columns.link(second.body.link));
        for part in tile.parts() {
            let (base1, base2) = (outer.0.at(part), outer.1.at(part));
            let ([_, v1, a1], [_, v2, a2]) = (base1, base2);
            let pose = DyadPose::of(work, part);
            let [r1, r2] = pose.spans;
            let [mut omega, mut alpha] = [[Lanes::splat(work.on, 0.0); 2]; 2];
            if deepest >= Stage::Velocities {
                let quotient = (v2 - v1) * pose.inverse;
                omega = [quotient.dot(r2), quotient.dot(r1)];
            }
            if deepest >= Stage::Accelerations {
                let [w1, w2] = omega;
                let quotient = ((a2 - r2 * (w2 * w2)) - (a1 - r1 * (w1 * w1))) * pose.inverse;
                alpha = [quotient.dot(r2), quotient.dot(r1)];
            }
            link1.put(deepest, part, &first.motion(r1, base1, [omega[0], alpha[0]]));
            link2.put(deepest, part, &second.motion(r2, base2, [omega[1], alpha[1]]));
            reach.add::<C>(part, check.of(self, &pose, omega));
        }
    }

    /// Computes the reactions in the three joints. `first` is the dyad's first column in the working memory.
    #[inline(always)]
    fn hold<S: Simd>(&self, gravity: Vec2, tile: Tile<S>, work: Columns<S>, first: usize) {
        let (dyad, [a, b]) = (work.adjacent::<OF_DYAD>(first), &self.arms);
        let [load_a, load_b] = [0, 1].map(|index| LoadColumns::of(work, index));
        a.body.load(gravity, tile, dyad.adjacent::<2>(POLE), load_a);
        b.body.load(gravity, tile, dyad.adjacent::<2>(POLE), load_b);
        let joints = [a.reaction.force, b.reaction.force, self.inner.force];
        let [outer1, outer2, inner] = joints.map(|force| tile.columns.adjacent::<2>(force));
        let signs = [a.reaction.sign, -b.reaction.sign, -self.inner.sign];
        for part in tile.parts() {
            let DyadPose { spans: [r1, r2], inverse, .. } = DyadPose::of(dyad, part);
            let ((force_a, moment_a), (force_b, moment_b)) = (load_a.get(part), load_b.get(part));
            let total = force_a + force_b;
            let reaction = (r1 * (moment_b + r2.cross(total)) + r2 * moment_a) * inverse;
            outer1.put_vector(0, part, reaction.signed(signs[0]));
            outer2.put_vector(0, part, (reaction + total).signed(signs[1]));
            inner.put_vector(0, part, (reaction + force_a).signed(signs[2]));
        }
    }
}
