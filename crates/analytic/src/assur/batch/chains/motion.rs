//! Motion of higher groups on pins, for several poses at once.
//!
//! Every pose starts from link directions interpolated between two anchors (see `batch::anchors`).
//! One Newton correction of these directions gives the pose; a second Jacobian is assembled at the corrected pose.

use super::{Chain, OF_START};
use crate::assur::batch::elimination::Factors;
use crate::assur::batch::equations::swung;
use crate::assur::batch::lanes::{Lanes, Plane, Window};
use crate::assur::batch::poses::{ACCELERATION, ALPHA, DIRECTION, OMEGA, ORIGIN, VELOCITY};
use crate::assur::groups::Hangs;
use linkage::math::Vec2;
use linkage::trajectory::Stage;
use pulp::Simd;

/// If the corrections of a group's interpolated directions sum up to at most this angle (rad), one correction is
/// enough: the square of the sum is below rounding error.
const LAST_CHANGE: f64 = 1e-8;

impl Chain {
    /// Computes the motion of all links. Returns NaN for poses that one Newton correction does not reach on the branch,
    /// and 0 for all other poses.
    #[inline(always)]
    pub(in crate::assur::batch) fn turn<S: Simd>(
        &self,
        deepest: Stage,
        tile: Window<S>,
        work: Window<S>,
        first: usize,
    ) -> Lanes<S> {
        match self.nodes.len() {
            4 => self.turn_by::<S, 4>(deepest, tile, work, first),
            _ => self.turn_by::<S, 6>(deepest, tile, work, first),
        }
    }

    #[inline(always)]
    fn turn_by<S: Simd, const N: usize>(
        &self,
        deepest: Stage,
        tile: Window<S>,
        work: Window<S>,
        first: usize,
    ) -> Lanes<S> {
        let one = Lanes::splat(tile.on, 1.0);
        for (index, node) in self.nodes.iter().enumerate() {
            tile.put_vector(node.body.link + DIRECTION, start(work, first + OF_START * index));
        }
        for (index, &(base, local)) in self.roots.iter().enumerate() {
            let (arm, place) = match base {
                Some(base) => {
                    let arm = tile.vector(base + DIRECTION).rotate(local);
                    (arm, tile.vector(base + ORIGIN) + arm)
                }
                None => (Plane::splat(tile.on, local), Plane::splat(tile.on, local)),
            };
            work.put_vector(self.root(first, index), arm);
            work.put_vector(self.root(first, index) + 2, place);
        }
        let (jacobian, gaps) = self.assembled::<S, N>(tile, work, first);
        let changes = Factors::of(jacobian, one).solve(gaps);
        let mut largest = Lanes::splat(tile.on, 0.0);
        for (node, change) in self.nodes.iter().zip(changes) {
            let direction = tile.vector(node.body.link + DIRECTION);
            tile.put_vector(node.body.link + DIRECTION, direction - direction.turned() * change);
            // The sum of all changes is tested, not the maximum, because a sum keeps NaN.
            largest = largest + change.abs();
        }
        let (jacobian, _) = self.assembled::<S, N>(tile, work, first);
        let factors = Factors::of(jacobian, one);
        self.put_links(tile, work, first);
        if deepest >= Stage::Velocities {
            self.put_velocities(&factors, tile, work, first);
        }
        if deepest >= Stage::Accelerations {
            self.put_accelerations(&factors, tile, work, first);
        }
        if deepest >= Stage::Reactions {
            factors.keep(work, self.first_factor(first));
        }
        let (zero, none) = (Lanes::splat(tile.on, 0.0), Lanes::splat(tile.on, f64::NAN));
        let is_near = Lanes::splat(tile.on, LAST_CHANGE).exceeds(largest);
        let is_kept = (factors.determinant * self.branch).exceeds(zero);
        is_near.of(is_kept.of(zero, none), none)
    }

    /// From the link directions, computes the arrows, the gaps of the contours and the Jacobian of these gaps.
    #[inline(always)]
    fn assembled<S: Simd, const N: usize>(
        &self,
        tile: Window<S>,
        work: Window<S>,
        first: usize,
    ) -> ([[Lanes<S>; N]; N], [Lanes<S>; N]) {
        for (index, arrow) in self.arrows.iter().enumerate() {
            work.put_vector(self.arrow(first, index), tile.vector(arrow.link + DIRECTION).rotate(arrow.local));
        }
        let zero = Lanes::splat(tile.on, 0.0);
        let (mut jacobian, mut gaps) = ([[zero; N]; N], [zero; N]);
        for (index, closing) in self.closings.iter().enumerate() {
            let mut gap = Plane { x: zero, y: zero };
            for (root, sign) in closing.ends {
                gap = gap + work.vector(self.root(first, root) + 2) * sign;
            }
            for &(arrow, sign) in &closing.ways {
                let (vector, column) = (work.vector(self.arrow(first, arrow)) * sign, self.arrows[arrow].node);
                gap = gap + vector;
                jacobian[2 * index][column] = jacobian[2 * index][column] - vector.y;
                jacobian[2 * index + 1][column] = jacobian[2 * index + 1][column] + vector.x;
            }
            (gaps[2 * index], gaps[2 * index + 1]) = (gap.x, gap.y);
        }
        (jacobian, gaps)
    }

    /// Computes the origins of all links.
    #[inline(always)]
    fn put_links<S: Simd>(&self, tile: Window<S>, work: Window<S>, first: usize) {
        for (index, node) in self.nodes.iter().enumerate() {
            let place = match node.hangs {
                Hangs::Root(root) => work.vector(self.root(first, root) + 2),
                Hangs::Arrow(arrow) => {
                    work.vector(self.joint(first, self.arrows[arrow].node) + 2) + work.vector(self.arrow(first, arrow))
                }
            };
            let arm = tile.vector(node.body.link + DIRECTION).rotate(node.own);
            work.put_vector(self.joint(first, index), arm);
            work.put_vector(self.joint(first, index) + 2, place);
            tile.put_vector(node.body.link + ORIGIN, place - arm);
        }
    }

    #[inline(always)]
    fn put_velocities<S: Simd, const N: usize>(
        &self,
        factors: &Factors<S, N>,
        tile: Window<S>,
        work: Window<S>,
        first: usize,
    ) {
        for (index, &(base, _)) in self.roots.iter().enumerate() {
            let column = self.root(first, index);
            let velocity = match base {
                Some(base) => tile.vector(base + VELOCITY) + work.vector(column).turned() * tile.get(base + OMEGA),
                None => Plane::splat(tile.on, Vec2::zeros()),
            };
            work.put_vector(column + 2, velocity);
        }
        let mut rates = [Lanes::splat(tile.on, 0.0); N];
        for (index, closing) in self.closings.iter().enumerate() {
            let mut rate = Plane::splat(tile.on, Vec2::zeros());
            for (root, sign) in closing.ends {
                rate = rate - work.vector(self.root(first, root) + 2) * sign;
            }
            (rates[2 * index], rates[2 * index + 1]) = (rate.x, rate.y);
        }
        let omegas = factors.solve(rates);
        for (index, (node, omega)) in self.nodes.iter().zip(omegas).enumerate() {
            let velocity = match node.hangs {
                Hangs::Root(root) => work.vector(self.root(first, root) + 2),
                Hangs::Arrow(arrow) => {
                    let from = &self.arrows[arrow];
                    let swing = work.vector(self.arrow(first, arrow)).turned() * tile.get(from.link + OMEGA);
                    work.vector(self.joint(first, from.node) + 2) + swing
                }
            };
            let column = self.joint(first, index);
            work.put_vector(column + 2, velocity);
            tile.put(node.body.link + OMEGA, omega);
            tile.put_vector(node.body.link + VELOCITY, velocity - work.vector(column).turned() * omega);
        }
    }

    #[inline(always)]
    fn put_accelerations<S: Simd, const N: usize>(
        &self,
        factors: &Factors<S, N>,
        tile: Window<S>,
        work: Window<S>,
        first: usize,
    ) {
        for (index, &(base, _)) in self.roots.iter().enumerate() {
            let column = self.root(first, index);
            let acceleration = match base {
                Some(base) => {
                    let swing = swung(work.vector(column), tile.get(base + OMEGA), tile.get(base + ALPHA));
                    tile.vector(base + ACCELERATION) + swing
                }
                None => Plane::splat(tile.on, Vec2::zeros()),
            };
            work.put_vector(column + 2, acceleration);
        }
        let mut rates = [Lanes::splat(tile.on, 0.0); N];
        for (index, closing) in self.closings.iter().enumerate() {
            let mut second = Plane::splat(tile.on, Vec2::zeros());
            for (root, sign) in closing.ends {
                second = second - work.vector(self.root(first, root) + 2) * sign;
            }
            for &(arrow, sign) in &closing.ways {
                let omega = tile.get(self.arrows[arrow].link + OMEGA);
                second = second + work.vector(self.arrow(first, arrow)) * sign * (omega * omega);
            }
            (rates[2 * index], rates[2 * index + 1]) = (second.x, second.y);
        }
        let alphas = factors.solve(rates);
        for (index, (node, alpha)) in self.nodes.iter().zip(alphas).enumerate() {
            let acceleration = match node.hangs {
                Hangs::Root(root) => work.vector(self.root(first, root) + 2),
                Hangs::Arrow(arrow) => {
                    let (from, vector) = (&self.arrows[arrow], work.vector(self.arrow(first, arrow)));
                    let swing = swung(vector, tile.get(from.link + OMEGA), tile.get(from.link + ALPHA));
                    work.vector(self.joint(first, from.node) + 2) + swing
                }
            };
            let column = self.joint(first, index);
            work.put_vector(column + 2, acceleration);
            let back = -work.vector(column);
            let omega = tile.get(node.body.link + OMEGA);
            tile.put(node.body.link + ALPHA, alpha);
            tile.put_vector(node.body.link + ACCELERATION, acceleration + swung(back, omega, alpha));
        }
    }
}

/// Start direction of a link: its direction at the anchor, rotated by the interpolating polynomial.
#[inline(always)]
fn start<S: Simd>(work: Window<S>, column: usize) -> Plane<S> {
    let way = work.get(column + 2);
    let mut angle = work.get(column + 7);
    for power in (3..7).rev() {
        angle = angle * way + work.get(column + power);
    }
    let angle = angle * way;
    let square = angle * angle;
    let (mut sine, mut cosine) = (Lanes::splat(work.on, 0.0), Lanes::splat(work.on, 0.0));
    for odd in [11.0, 9.0, 7.0, 5.0, 3.0] {
        sine = (sine + 1.0) * square * (-1.0 / (odd * (odd - 1.0)));
        cosine = (cosine + 1.0) * square * (-1.0 / ((odd + 1.0) * odd));
    }
    cosine = (cosine + 1.0) * square * -0.5;
    work.vector(column).onwards(Plane { x: cosine + 1.0, y: (sine + 1.0) * angle })
}
