//! The surroundings of a change point, and polynomials through poses on both sides of it.
//!
//! At the distance x from the change point, the rounding error of a pose grows as 1 / x.
//! The rounding error of the second transfer functions grows as 1 / x^3.
//! The error of the polynomials grows with the distance of the nodes from the change point.
//! On each side of the change point, ten nodes lie at the Chebyshev points of x^2. The nodes' distances from the change
//! point are from a tenth of the half width to the full half width.
//! These positions of the nodes are nearly the best compromise between rounding error and polynomial error.
//! Let r be the distance from the change point to the next singular pose (real or complex).
//! Second transfer functions then have errors of about 5e-13 for r = 2 rad, 1e-12 for 1 rad, 4e-12 for 0.6 rad and
//! 3e-11 for 0.3 rad.
//! The half widths in these cases are from 0.5 to 0.15 rad.
//! For each of several half widths, nodes are left out and the change of the result is measured.
//! The half width with the smallest change is used.

use std::f64::consts::PI;

use super::search::{Start, clearance, walk};
use crate::assur::groups::{Misfit, OutOfReach, SolutionPlan};
use linkage::math::{KeepNan, Motion, Vec2};
use linkage::mechanism::{GroupId, LinkId};

/// Nodes on each side.
const SIDE: usize = 10;
/// Distance of the innermost node, divided by the half width.
const CORE: f64 = 0.1;
/// Half widths that are tried (rad).
const WIDTHS: [f64; 11] = [0.5, 0.4, 0.3, 0.2, 0.15, 0.1, 0.07, 0.05, 0.03, 0.02, 0.012];
/// If the mechanism cannot be followed through a window, the next half width is at most this fraction of the failing
/// half width.
/// The failing window contains another singular pose, towards which reactions may grow without bound.
const CLEAR: f64 = 0.5;
/// A change point is passed only if [`Window::error`] is below this value.
const WORST: f64 = 1e-6;
/// Two computed change points count as one change point if their distance is at most this fraction of the distance
/// between the innermost nodes.
/// Such a distance can result from rounding or curvature.
const APART: f64 = 0.2;
/// Number of secant steps that improve the position of the change point.
const POLISHING: usize = 4;
/// The polynomials amplify the rounding error of the poses by the sum of the magnitudes of the weights, about four.
/// The constant `WEIGHTS` is the cube root of this sum.
const WEIGHTS: f64 = 1.6;
/// The rounding error of accelerations is the unit roundoff, times the cube of the condition number, times this factor.
const ULPS: f64 = 16.0;

/// A pose near a change point. The driving link has unit speed and no acceleration.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Distance from the change point (rad).
    pub(super) offset: f64,
    pub(super) plan: SolutionPlan,
    pub(super) motions: Vec<Motion>,
}

/// The surroundings of a change point.
#[derive(Clone, Debug)]
pub(in crate::assur) struct Window {
    /// Angle of the driving link at the change point (rad).
    pub(super) at: f64,
    /// Half width (rad).
    pub(super) reach: f64,
    pub(super) nodes: Vec<Node>,
    /// Condition number that determines the rounding error in the window.
    pub(in crate::assur) condition: f64,
}

/// Weights of the values at nodes with these distances, for interpolation at `x`.
pub(super) fn weights(offsets: &[f64], x: f64) -> Vec<f64> {
    let of = |(j, own): (usize, &f64)| {
        let others = offsets.iter().enumerate().filter(|&(k, _)| k != j);
        others.map(|(_, other)| (x - other) / (own - other)).product()
    };
    offsets.iter().enumerate().map(of).collect()
}

impl Window {
    /// The surroundings of the change point of `group` at the angle `at` (rad).
    /// The nodes are reached from the nearby pose `start`.
    pub(super) fn around(at: f64, group: GroupId, start: &Start, share: f64) -> Result<Self, OutOfReach> {
        let mut best: Option<(f64, Window)> = None;
        let (mut failed, mut allowed) = (None, f64::INFINITY);
        for reach in WIDTHS {
            if share * reach > allowed {
                continue;
            }
            match Window::of_width(at, share * reach, group, start) {
                Ok(window) => {
                    let error = window.error();
                    if best.as_ref().is_none_or(|(least, _)| error < *least) {
                        best = Some((error, window));
                    }
                }
                Err(why) => {
                    failed = Some(why);
                    allowed = allowed.smaller(CLEAR * share * reach);
                }
            }
        }
        match best {
            Some((error, mut window)) if error < WORST => {
                let sine = |node: &mut Node| match node.plan.determinant(group) {
                    Some(determinant) => determinant.abs(),
                    None => clearance(&mut node.plan, &mut node.motions.clone(), group).map_or(1.0, |own| own.sine),
                };
                let sines: Vec<f64> = window.nodes.iter_mut().map(sine).collect();
                let (least, most) =
                    sines.iter().fold((f64::INFINITY, 0.0f64), |(a, b), &sine| (a.smaller(sine), b.larger(sine)));
                // The larger of two condition numbers is stored.
                // The first number is about 1 / sine at the innermost pose.
                // The second number is computed from the error of the transfer functions.
                window.condition =
                    (WEIGHTS * most / least / window.reach).larger((error / (ULPS * f64::EPSILON)).cbrt());
                Ok(window)
            }
            _ => Err(failed.unwrap_or(OutOfReach { group, why: Misfit::Passed { crank: at } })),
        }
    }

    fn of_width(at: f64, reach: f64, group: GroupId, start: &Start) -> Result<Self, OutOfReach> {
        let towards = (at - start.angle).signum();
        let distance = |k: usize| {
            let place = (PI * (2 * k + 1) as f64 / (2 * SIDE) as f64).cos();
            reach * (0.5 * (1.0 + CORE * CORE) + 0.5 * (1.0 - CORE * CORE) * place).sqrt()
        };
        let (mut plan, mut motions) = (start.plan.clone(), start.motions.to_vec());
        let mut nodes: Vec<Node> = Vec::with_capacity(2 * SIDE);
        let mut sines = Vec::with_capacity(2 * SIDE);
        let put = |offset: f64, plan: &mut SolutionPlan, motions: &[Motion]| {
            let mut own = motions.to_vec();
            let sine = clearance(plan, &mut own, group).map_or(f64::NAN, |clearance| clearance.sine);
            let sine = plan.determinant(group).unwrap_or(sine);
            plan.accelerations([&[1.0], &[0.0]], &mut own);
            (Node { offset, plan: plan.clone(), motions: own }, sine)
        };
        let mut from = start.angle;
        for k in 0..SIDE {
            let offset = -towards * distance(k);
            walk(&mut plan, &mut motions, [from, at + offset])?;
            from = at + offset;
            let (node, sine) = put(offset, &mut plan, &motions);
            nodes.push(node);
            sines.push(sine);
        }
        let offsets: Vec<f64> = nodes.iter().map(|node| node.offset).collect();
        for k in (0..SIDE).rev() {
            let offset = towards * distance(k);
            if k == SIDE - 1 {
                let mut expected = motions.clone();
                interpolate(&nodes, &weights(&offsets, offset), &mut expected);
                plan.positions_like(&expected, &[at + offset], &mut motions)?;
            } else {
                walk(&mut plan, &mut motions, [from, at + offset])?;
            }
            from = at + offset;
            let (node, sine) = put(offset, &mut plan, &motions);
            // The sine of a dyad is never negative.
            // Beyond the change point, the sine is stored with a minus sign, so that `polish` finds a zero.
            // The determinant of a higher group changes its sign itself and is stored as it is.
            sines.push(if node.plan.determinant(group).is_some() { sine } else { -sine });
            nodes.push(node);
        }
        let mut window = Window { at, reach, nodes, condition: f64::INFINITY };
        window.polish(&sines);
        if let Some(group) = window.other_inside() {
            return Err(OutOfReach { group, why: Misfit::Passed { crank: at } });
        }
        Ok(window)
    }

    /// A group with another change point between the innermost nodes; `None` if there is no such group.
    /// Reactions have poles at both change points, but the position of only one of them is known.
    fn other_inside(&mut self) -> Option<GroupId> {
        let near = |side: f64| {
            let own = self.nodes.iter().enumerate().filter(move |(_, node)| node.offset * side > 0.0);
            own.min_by(|(_, a), (_, b)| a.offset.abs().total_cmp(&b.offset.abs())).map_or(0, |(index, _)| index)
        };
        let inner = [near(-1.0), near(1.0)];
        let [low, high] = inner.map(|index| self.nodes[index].offset);
        let is_apart = |place: f64| place > low && place < high && place.abs() > APART * (high - low);
        self.nodes[0].plan.steps().ids().find(|&group| {
            let [a, b] = inner.map(|index| self.nodes[index].plan.determinant(group));
            if let (Some(a), Some(b)) = (a, b) {
                return a * b < 0.0 && is_apart(low + (high - low) * a / (a - b));
            }
            // The change point of a dyad is extrapolated from both sides.
            // If both extrapolations lead away from the middle of the window, the dyad has another change point.
            let places = inner.map(|index| {
                let node = &mut self.nodes[index];
                let own = clearance(&mut node.plan, &mut node.motions.clone(), group);
                own.map_or(f64::NAN, |own| node.offset - own.sine / own.rate)
            });
            places.iter().all(|place| is_apart(*place))
        })
    }

    /// Improves the position of the change point, where the signed sine is zero.
    fn polish(&mut self, sines: &[f64]) {
        let offsets = self.offsets();
        let sine = |x: f64| weights(&offsets, x).iter().zip(sines).map(|(weight, sine)| weight * sine).sum::<f64>();
        let nearest = offsets.iter().fold(f64::INFINITY, |least, offset| least.smaller(offset.abs()));
        let (mut last, mut x) = (nearest, 0.0);
        for _ in 0..POLISHING {
            let (a, b) = (sine(last), sine(x));
            if a == b {
                break;
            }
            (last, x) = (x, x - b * (x - last) / (b - a));
        }
        if x.abs() < 0.3 * nearest {
            self.at += x;
            self.nodes.iter_mut().for_each(|node| node.offset -= x);
        }
    }

    pub(super) fn offsets(&self) -> Vec<f64> {
        self.nodes.iter().map(|node| node.offset).collect()
    }

    /// The outermost node on the same side as an angle, and the next node inwards.
    pub(super) fn ends(&self, angle: f64) -> [&Node; 2] {
        let side = angle - self.at;
        let mut all: Vec<&Node> = self.nodes.iter().filter(|node| node.offset * side > 0.0).collect();
        if all.is_empty() {
            all = self.nodes.iter().collect();
        }
        all.sort_by(|a, b| b.offset.abs().total_cmp(&a.offset.abs()));
        [all[0], all[1]]
    }

    /// Determinants of the higher groups at a node.
    pub(super) fn determinants(&self, node: &Node) -> Vec<Option<f64>> {
        node.plan.steps().ids().map(|group| node.plan.determinant(group)).collect()
    }

    /// Relative error of the first and second transfer functions of the links' angles at the change point.
    /// The error is divided by the largest of these transfer functions, but at least by 1.
    /// The error is the change of the result when the outermost or the innermost pair of nodes is left out, whichever
    /// is larger.
    /// Leaving out the outermost pair shows the error of the polynomials; leaving out the innermost pair shows the
    /// rounding error.
    fn error(&self) -> f64 {
        let second = |kept: &dyn Fn(f64) -> bool| -> Vec<f64> {
            let nodes: Vec<&Node> = self.nodes.iter().filter(|node| kept(node.offset.abs())).collect();
            let offsets: Vec<f64> = nodes.iter().map(|node| node.offset).collect();
            let weights = weights(&offsets, 0.0);
            let sum = |of: &dyn Fn(&Motion) -> f64, link: LinkId| {
                nodes.iter().zip(&weights).map(|(node, weight)| weight * of(&node.motions[link])).sum::<f64>()
            };
            let links = (0..self.nodes[0].motions.len()).map(LinkId);
            let of = |link| [sum(&|motion| motion.alpha, link), sum(&|motion| motion.omega, link)];
            links.flat_map(of).collect()
        };
        let distances = self.nodes.iter().map(|node| node.offset.abs());
        let (least, most) = distances.fold((f64::INFINITY, 0.0f64), |(a, b), x| (a.smaller(x), b.larger(x)));
        let all = second(&|_| true);
        let scale = all.iter().fold(1.0f64, |most, value| most.larger(value.abs()));
        let change =
            |some: Vec<f64>| all.iter().zip(some).fold(0.0f64, |most, (a, b)| most.larger((a - b).abs())) / scale;
        let band = 0.01 * self.reach;
        change(second(&|x| x < most - band)).larger(change(second(&|x| x > least + band)))
    }

    /// Computes the positions of all links for an angle of the driving link.
    pub(super) fn positions(&self, angle: f64, motions: &mut [Motion]) {
        interpolate(&self.nodes, &weights(&self.offsets(), angle - self.at), motions);
    }

    /// Computes the velocities and accelerations of all links for an angle, angular velocity (rad/s) and angular
    /// acceleration (rad/s^2) of the driving link.
    /// The values of the driving link itself are exact.
    pub(in crate::assur) fn rates(
        &self,
        angle: f64,
        [omega, alpha]: [f64; 2],
        plan: &SolutionPlan,
        motions: &mut [Motion],
    ) {
        let weights = weights(&self.offsets(), angle - self.at);
        for (link, motion) in motions.iter_mut().enumerate() {
            let mut own = Motion { direction: motion.direction, origin: motion.origin, ..Motion::REST };
            for (node, weight) in self.nodes.iter().zip(&weights) {
                let unit = at_speed(&node.motions[link], [omega, alpha]);
                own.velocity += unit.velocity * *weight;
                own.omega += unit.omega * weight;
                own.acceleration += unit.acceleration * *weight;
                own.alpha += unit.alpha * weight;
            }
            *motion = own;
        }
        plan.drive_velocities(&[omega], motions);
        plan.drive_accelerations([&[omega], &[alpha]], motions);
    }
}

/// Computes the motion of a link for the given speed and acceleration of the driving link.
/// `unit` is the link's motion if the driving link has unit speed and no acceleration.
pub(super) fn at_speed(unit: &Motion, [omega, alpha]: [f64; 2]) -> Motion {
    Motion {
        velocity: unit.velocity * omega,
        omega: unit.omega * omega,
        acceleration: unit.acceleration * (omega * omega) + unit.velocity * alpha,
        alpha: unit.alpha * omega * omega + unit.omega * alpha,
        ..*unit
    }
}

fn interpolate(nodes: &[Node], weights: &[f64], motions: &mut [Motion]) {
    for (link, motion) in motions.iter_mut().enumerate() {
        let (mut direction, mut origin) = (Vec2::zeros(), Vec2::zeros());
        for (node, weight) in nodes.iter().zip(weights) {
            direction += node.motions[link].direction * *weight;
            origin += node.motions[link].origin * *weight;
        }
        (motion.direction, motion.origin) = (direction.normalize(), origin);
    }
}
