//! Any higher group, by Newton's method on its vector contours.
//!
//! A tree of joints connects the group's links to the known links.
//! No loop consists of prismatic joints only, so the tree can contain all prismatic joints.
//! The tree also contains all joints with a given coordinate. Every remaining revolute joint closes a contour.
//! The unknown of a link is its angle if the joint to its parent is revolute, and its slide if this joint is prismatic.
//! Each contour gives two equations.
//! Each given coordinate q gives one equation: theta - theta(parent) = q, or slide = q.
//! If the link is the joint's first link, -q replaces q.
//! Each transmission gives one equation too (`train.rs`).
//! There are as many unknowns as equations.
//! The gap of a closing joint is the sum of the link and slide vectors along both paths to this joint.
//! The derivative of the gap with respect to an angle is the sum of the vectors that turn with this angle, rotated by
//! 90 degrees. The derivative of the gap with respect to a slide is the axis of this slide.
//! Velocities and accelerations of the unknowns follow from the same Jacobian.
//! For the velocities, the right-hand side of a contour is minus the velocity of its gap at constant unknowns.
//! For the accelerations, the right-hand side is minus the acceleration that the gap would have with all second
//! derivatives of the unknowns equal to zero. This acceleration contains the centripetal and Coriolis parts.
//! For a given coordinate, the right-hand side contains the rate or acceleration of the drive.

mod contour;
mod given;
mod predict;
mod rates;
mod train;

#[cfg(feature = "batch")]
pub(in crate::assur) use contour::Arrow;
pub use contour::{ClosingJoint, Node};
pub(in crate::assur) use contour::{Contours, Hangs};

pub(in crate::assur) use self::given::Given;
use self::predict::{Memory, copy};
pub(in crate::assur) use self::train::Train;
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, Motion, Vec2, cross, rotated, turned, unit};
use linkage::mechanism::{DrivingLink, GROUND, Group, JointSide, Mechanism};
use linkage::work::{Count, WorkTally};

/// Largest number of iterations. Newton's method from the last pose needs only a few iterations. More iterations mean
/// that the branch is lost.
const MAX_ITERATIONS: usize = 10;
/// Largest rotation of a link from the last pose (rad) that is accepted as a continuation of the branch.
/// The limit for a slide is this value times the mechanism's size.
const MAX_TURN: f64 = 0.3;

/// If no unknown changes by more than this (rad), the iteration is the last one.
/// The remaining error is the square of the change, times the condition number of the pose.
const LAST_CHANGE: f64 = 1e-8;

/// If the last iteration changes no unknown by more than this (rad), the Jacobian of this iteration is accurate for the
/// final pose within rounding error.
/// Predictions from five steps amplify the rounding error of an angle up to 31 times.
/// For steps of a tenth of a degree, predictions are accurate enough to meet this limit.
const SAME_POSE: f64 = 4e-14;
/// Largest correction of a predicted pose (rad). Near a dead point predictions are poor, and the corrected pose may be
/// on another branch.
const MAX_CORRECTION: f64 = 0.01;
/// A step is refused if the squared determinant, extrapolated from the last steps to the requested pose, falls below
/// this fraction of its present value.
const LEAST_LEFT: f64 = 0.25;
/// If the driving angles change by no more than this (rad), a jump to another branch is impossible, and the determinant
/// does not limit the step.
const SMALLEST_STEP: f64 = 1e-6;
/// A pose is singular if the ratio of its determinant to the largest determinant so far is below this value.
/// At a change point the determinant is linear in the driving angles.
/// Within [`SMALLEST_STEP`] of the change point, Newton's method cannot distinguish the branches.
/// Newton's method may then change to the branch on which the determinant keeps its sign.
/// Near a dead point the determinant is proportional to the square root of the driving angle's distance from the dead
/// point, and the sign of the determinant distinguishes the branches.
const SINGULAR: f64 = 1e-6;

/// Returns `direction` rotated by a small angle (rad).
/// The error is of the seventh order of the angle, and the length of the result is 1 within rounding error.
#[inline]
fn slightly_turned(direction: Vec2, angle: f64) -> Vec2 {
    let square = angle * angle;
    let sine = angle * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0)));
    let cosine = 1.0 - square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0)));
    let turned = rotated(direction, Vec2::new(cosine, sine));
    // Restores unit length with an approximate inverse root. The length before this correction differs from 1 by about
    // 1e-8 at most, and the remaining error is of the order of the square of this difference.
    turned * (1.5 - 0.5 * turned.norm_squared())
}

/// A joint in world coordinates: the vector from the origin of its link's frame to the joint, and the joint's motion.
#[derive(Clone, Copy, Debug)]
struct At {
    arm: Vec2,
    place: Vec2,
    velocity: Vec2,
    acceleration: Vec2,
}

/// Vectors of the tree in the world, at the last pose.
#[derive(Clone, Debug)]
struct World {
    arrows: Vec<Vec2>,
    /// Each vector times the square of its angular velocity (m/s^2).
    centripetal: Vec<Vec2>,
    roots: Vec<At>,
    /// The joints from the nodes to their parents.
    joints: Vec<At>,
}

/// A higher group, prepared for solving.
#[derive(Clone, Debug)]
pub struct Chain {
    contours: Contours,
    world: World,
    jacobian: Lu,
    unknown: Vec<f64>,
    branch: f64,
    /// Determinant at the last pose, its square, and the derivatives of the square with respect to the components of
    /// `step`.
    /// Every step corrects the derivatives along the direction of the step (Broyden's update).
    determinant: f64,
    square: f64,
    slopes: Vec<f64>,
    /// Driven coordinates at the last pose (rad, m), and `scales` times their changes from the last pose to the
    /// requested pose.
    at: Vec<f64>,
    step: Vec<f64>,
    /// Directions of the links at the last pose, restored if a step fails.
    kept: Vec<Vec2>,
    /// Slides at the present pose, slides at the last pose, and their rates (m, m, m/s); 0 for revolute joints.
    slides: Vec<f64>,
    kept_slides: Vec<f64>,
    speeds: Vec<f64>,
    /// Length by which slides are divided, so that all unknowns are of one order of magnitude (m).
    size: f64,
    is_sliding: bool,
    /// The joints with a given coordinate. Each of these joints has one row of the Jacobian, after the rows of the
    /// contours.
    given: Vec<Given>,
    /// The transmissions. Each transmission has one row of the Jacobian, after the rows of the given coordinates.
    trains: Vec<Train>,
    /// For every drive: the factor by which a change of its input is multiplied to give the step (1 or 1/m).
    scales: Vec<f64>,
    /// Largest magnitude of the determinant so far.
    largest: f64,
    memory: Memory,
    tally: Box<WorkTally>,
}

impl Chain {
    /// Prepares a group of a mechanism with these driving links.
    #[must_use]
    pub fn of(mechanism: &Mechanism, group: &Group, drivers: &[DrivingLink]) -> Self {
        let drives = drivers.len();
        let contours = Contours::of(mechanism, group);
        let size = mechanism.size();
        let given = Given::all(mechanism, &contours.nodes, drivers, size);
        let trains = group.trains.iter().map(|&id| Train::of(mechanism, id, &contours.nodes, size)).collect();
        let n = contours.nodes.len();
        let none = Vec2::zeros();
        let at = At { arm: none, place: none, velocity: none, acceleration: none };
        // Joints on the ground do not move, so their velocity and acceleration are zero.
        let root = |side: &JointSide| At { arm: side.local, place: side.local, ..at };
        let world = World {
            arrows: vec![none; contours.arrows.len()],
            centripetal: vec![none; contours.arrows.len()],
            roots: contours.roots.iter().map(root).collect(),
            joints: vec![at; n],
        };
        Chain {
            is_sliding: contours.nodes.iter().any(Node::is_guided),
            contours,
            world,
            jacobian: Lu::new(n),
            unknown: vec![0.0; n],
            branch: 0.0,
            determinant: f64::NAN,
            square: f64::NAN,
            slopes: vec![0.0; drives],
            at: vec![f64::NAN; drives],
            step: vec![0.0; drives],
            kept: vec![none; n],
            slides: vec![f64::NAN; n],
            kept_slides: vec![0.0; n],
            speeds: vec![0.0; n],
            size,
            scales: drivers.iter().map(|driver| 1.0 / driver.input.span(size)).collect(),
            given,
            trains,
            largest: 0.0,
            memory: Memory::of(n, drives),
            tally: Box::default(),
        }
    }

    /// The group's links, parents before children.
    #[inline]
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.contours.nodes
    }

    /// The joints that close the group's contours.
    #[inline]
    #[must_use]
    pub fn closings(&self) -> &[ClosingJoint] {
        &self.contours.closings
    }

    /// The tree and its contours.
    #[cfg(feature = "batch")]
    pub(in crate::assur) fn contours(&self) -> &Contours {
        &self.contours
    }

    /// Length by which slides are divided to form the unknowns (m).
    #[inline]
    #[must_use]
    pub fn size(&self) -> f64 {
        self.size
    }

    /// World position of the joint between a node and its parent at the last pose, as a point of the node's link.
    #[inline]
    pub(in crate::assur) fn pole(&self, node: usize) -> Vec2 {
        self.world.joints[node].place
    }

    /// Whether a link of the group has a prismatic joint.
    #[inline]
    pub(in crate::assur) fn is_sliding(&self) -> bool {
        self.is_sliding
    }

    /// Adds `way` (rad), a whole number of turns, to the first driving angle of the last pose. The links stay where
    /// they are.
    pub(super) fn skip(&mut self, way: f64) {
        self.at[0] += way;
        // Discard the remembered steps: rounding of the whole turns makes the next step differ from the last.
        self.memory.start_anew();
    }

    /// Computes the positions at these driving angles (rad), starting from the last pose.
    /// If the branch cannot be followed to these angles, returns `false` and leaves the links' directions unchanged.
    pub(super) fn positions(&mut self, angles: &[f64], motions: &mut [Motion]) -> bool {
        match self.is_sliding {
            true => self.positions_as::<true>(angles, motions),
            false => self.positions_as::<false>(angles, motions),
        }
    }

    /// Solves a group. `SLIDING` states whether the group has guides.
    fn positions_as<const SLIDING: bool>(&mut self, angles: &[f64], motions: &mut [Motion]) -> bool {
        if self.slides[0].is_nan() {
            self.read_slides(motions);
            self.trains.iter_mut().for_each(|train| train.start(&self.slides, motions));
        }
        if let ([step], [angle], [at], [scale]) = (&mut self.step[..], angles, &self.at[..], &self.scales[..]) {
            *step = (angle - at) * scale;
        } else {
            for (((step, angle), at), scale) in self.step.iter_mut().zip(angles).zip(&self.at).zip(&self.scales) {
                *step = (angle - at) * scale;
            }
        }
        if self.is_bold() {
            self.memory.forget();
            return false;
        }
        for (kept, node) in self.kept.iter_mut().zip(&self.contours.nodes) {
            *kept = motions[node.link].direction;
        }
        if SLIDING {
            self.kept_slides.copy_from_slice(&self.slides);
        }
        self.find_roots(motions);
        // If a prediction exists, it is applied before the first iteration.
        let allowed = if self.memory.predict(&self.step) {
            for (index, node) in self.contours.nodes.iter().enumerate() {
                let change = self.memory.change(index);
                advance::<SLIDING>(node, &mut self.slides[index], change, self.size, motions);
            }
            MAX_CORRECTION
        } else {
            MAX_TURN
        };
        let followed =
            self.follow::<SLIDING>(allowed, angles, motions) && self.memory.is_within(MAX_TURN) && !self.is_singular();
        if followed {
            self.memory.remember(&self.step);
            self.trains.iter_mut().for_each(Train::keep);
            copy(angles, &mut self.at);
            self.largest = self.largest.larger(self.determinant.abs());
            self.learn();
        } else {
            self.memory.forget();
            for (kept, node) in self.kept.iter().zip(&self.contours.nodes) {
                motions[node.link].direction = *kept;
            }
            if SLIDING {
                self.slides.copy_from_slice(&self.kept_slides);
            }
        }
        followed
    }

    /// Computes the positions at these driving angles (rad) near the expected poses `like`. The result may lie on the
    /// other side of a singular pose.
    /// Returns `false` if no pose is near enough.
    pub(super) fn positions_like(&mut self, like: &[Motion], angles: &[f64], motions: &mut [Motion]) -> bool {
        for node in &self.contours.nodes {
            motions[node.link].direction = like[node.link].direction;
        }
        self.read_slides(like);
        self.branch = 0.0;
        self.find_roots(motions);
        // This function is rarely called, so it uses the version with guides for every group.
        if !self.follow::<true>(MAX_CORRECTION, angles, motions) {
            return false;
        }
        self.at.copy_from_slice(angles);
        self.trains.iter_mut().for_each(Train::keep);
        self.memory.start_anew();
        self.slopes.fill(0.0);
        self.square = self.determinant.powi(2);
        true
    }

    /// Whether the pose is singular.
    fn is_singular(&self) -> bool {
        // The negated comparison makes a NaN determinant singular.
        !(self.determinant.abs() >= SINGULAR * self.largest)
    }

    /// Determinant of the Jacobian at the last pose. Along a branch, the determinant passes through zero at a change
    /// point.
    pub(crate) fn determinant(&self) -> f64 {
        self.determinant
    }

    /// Computes the slides from the poses of the links: from the start pose when the group is first placed, and from
    /// the expected poses in [`Chain::positions_like`].
    fn read_slides(&mut self, motions: &[Motion]) {
        for (slide, node) in self.slides.iter_mut().zip(&self.contours.nodes) {
            let from = motions[node.parent.link].point(node.parent.local);
            let to = motions[node.link].point(node.own);
            *slide = node.axis(motions).map_or(0.0, |axis| axis.dot(&(to - from)));
        }
    }

    /// Computes the positions of the joints on links outside the group.
    fn find_roots(&mut self, motions: &[Motion]) {
        let moving = |(_, side): &(&mut At, &JointSide)| side.link != GROUND;
        for (root, side) in self.world.roots.iter_mut().zip(&self.contours.roots).filter(moving) {
            let motion = &motions[side.link];
            root.arm = motion.arm(side.local);
            root.place = motion.origin + root.arm;
        }
    }

    /// Computes the vectors of the tree from the links' directions, and rotates every guided link with its parent.
    fn draw<const SLIDING: bool>(&mut self, motions: &mut [Motion]) {
        let Contours { nodes, arrows, .. } = &self.contours;
        if SLIDING {
            for (node, guided) in nodes.iter().filter_map(|node| node.guided.map(|guided| (node, guided))) {
                motions[node.link].direction = rotated(motions[node.parent.link].direction, guided.turn);
            }
        }
        for (vector, arrow) in self.world.arrows.iter_mut().zip(arrows) {
            *vector = match arrow.local {
                Some(local) => motions[arrow.carrier].arm(local),
                None => nodes[arrow.node].slide_axis(motions) * self.slides[arrow.node],
            };
        }
    }

    /// Writes the gaps to `unknown` and their derivatives to the Jacobian.
    fn assemble<const SLIDING: bool>(&mut self, angles: &[f64], motions: &mut [Motion]) {
        self.draw::<SLIDING>(motions);
        self.jacobian.clear();
        let Contours { nodes, closings, .. } = &self.contours;
        for (index, closing) in closings.iter().enumerate() {
            let row = 2 * index;
            let (above, below) = self.jacobian.pair_mut(row);
            let mut gap = Vec2::zeros();
            for (root, sign) in closing.ends {
                gap += self.world.roots[root].place * sign;
            }
            for stretch in &closing.ways {
                let vector = self.world.arrows[stretch.arrow] * stretch.sign;
                gap += vector;
                if let Some(column) = stretch.spin {
                    above[column] -= vector.y;
                    below[column] += vector.x;
                }
                if SLIDING && let Some(node) = stretch.slide {
                    let axis = nodes[node].slide_axis(motions) * (stretch.sign * self.size);
                    above[node] += axis.x;
                    below[node] += axis.y;
                }
            }
            self.unknown[row] = gap.x;
            self.unknown[row + 1] = gap.y;
        }
        if self.has_given() {
            self.assemble_given(angles, motions);
        }
    }

    /// Whether the group has equations besides those of its contours.
    #[inline]
    fn has_given(&self) -> bool {
        2 * self.contours.closings.len() < self.unknown.len()
    }

    /// Writes the equations of the given coordinates and of the transmissions.
    #[inline(never)]
    fn assemble_given(&mut self, angles: &[f64], motions: &[Motion]) {
        let first = 2 * self.contours.closings.len();
        for (row, given) in self.given.iter().enumerate() {
            let node = &self.contours.nodes[given.node];
            let coordinate = given.sign * angles[given.drive];
            self.jacobian.add(first + row, given.node, 1.0);
            self.unknown[first + row] = if given.is_slide {
                (self.slides[given.node] - coordinate) / self.size
            } else {
                if let Some(parent) = given.parent_spin {
                    self.jacobian.add(first + row, parent, -1.0);
                }
                let target = rotated(motions[node.parent.link].direction, unit(coordinate));
                let direction = motions[node.link].direction;
                cross(target, direction).atan2(target.dot(&direction))
            };
        }
        let first = first + self.given.len();
        for (row, train) in self.trains.iter_mut().enumerate() {
            self.unknown[first + row] = train.assemble(first + row, &self.slides, motions, &mut self.jacobian);
        }
    }

    /// Iterates Newton's method to rounding accuracy. After the last iteration, the factored Jacobian belongs to the
    /// final pose.
    fn follow<const SLIDING: bool>(&mut self, allowed: f64, angles: &[f64], motions: &mut [Motion]) -> bool {
        for _ in 0..MAX_ITERATIONS {
            self.assemble::<SLIDING>(angles, motions);
            self.tally.one(Count::Iterations);
            self.tally.one(Count::Factorisations);
            if !self.jacobian.factor() {
                return false;
            }
            self.jacobian.solve(&mut self.unknown);
            // NaN exceeds every bound.
            let within = |unknown: &[f64], bound: f64| unknown.iter().all(|change| change.abs() <= bound);
            if !within(&self.unknown, allowed) {
                return false;
            }
            self.memory.correct(&self.unknown);
            // After a small change this iteration is the last: Newton's method converges quadratically, so the
            // remaining error is of the order of the square of the change.
            let is_last = within(&self.unknown, LAST_CHANGE);
            for (index, (node, &change)) in self.contours.nodes.iter().zip(&self.unknown).enumerate() {
                if is_last && !(SLIDING && node.is_guided()) {
                    // A first-order rotation is enough: the square of the last change of an angle is below rounding
                    // error.
                    let direction = &mut motions[node.link].direction;
                    *direction -= turned(*direction) * change;
                } else {
                    advance::<SLIDING>(node, &mut self.slides[index], -change, self.size, motions);
                }
            }
            if is_last {
                if !within(&self.unknown, SAME_POSE) {
                    self.assemble::<SLIDING>(angles, motions);
                    self.tally.one(Count::Factorisations);
                    if !self.jacobian.factor() {
                        return false;
                    }
                } else if SLIDING {
                    self.draw::<SLIDING>(motions);
                } else {
                    // Each arrow is rotated by the same small angle as its link.
                    for (vector, arrow) in self.world.arrows.iter_mut().zip(&self.contours.arrows) {
                        *vector -= turned(*vector) * self.unknown[arrow.node];
                    }
                }
                return self.hang::<SLIDING>(motions);
            }
        }
        false
    }

    /// Computes the origins of all links from their directions. Returns `false` if the pose lies beyond a singular
    /// pose.
    fn hang<const SLIDING: bool>(&mut self, motions: &mut [Motion]) -> bool {
        let World { arrows, roots, joints, .. } = &mut self.world;
        for (index, node) in self.contours.nodes.iter().enumerate() {
            let mut place = match node.hangs {
                Hangs::Root(root) => roots[root].place,
                Hangs::Arrow(arrow) => joints[self.contours.arrows[arrow].node].place + arrows[arrow],
            };
            if SLIDING && let Some(axis) = node.axis(motions) {
                place += axis * self.slides[index];
            }
            let motion = &mut motions[node.link];
            if node.at_origin {
                // The joint is the frame's origin: `arm` is zero and needs no update.
                motion.origin = place;
            } else {
                let arm = motion.arm(node.own);
                motion.origin = place - arm;
                joints[index].arm = arm;
            }
            joints[index].place = place;
        }
        self.determinant = self.jacobian.determinant();
        // The product of many small pivots may underflow to zero. The sign of the determinant is then computed from the
        // pivots.
        let vanishes = self.determinant == 0.0;
        let sign = if vanishes { self.jacobian.determinant_sign() } else { self.determinant.signum() };
        if self.branch == 0.0 {
            self.branch = sign;
        }
        sign == self.branch
    }

    /// Stores the squared determinant of this pose and its change in this step.
    fn learn(&mut self) {
        let square = self.determinant.powi(2);
        if let ([step], [slope]) = (&self.step[..], &mut self.slopes[..]) {
            // Broyden's update for one driving link.
            if *step * *step > 0.0 && self.square.is_finite() {
                *slope += (square - self.square - *slope * step) / (step * step) * step;
            }
            self.square = square;
            return;
        }
        let length = self.step.iter().map(|step| step * step).sum::<f64>();
        if length > 0.0 && self.square.is_finite() {
            let rest = (square - self.square - self.foreseen()) / length;
            self.slopes.iter_mut().zip(&self.step).for_each(|(slope, step)| *slope += rest * step);
        }
        self.square = square;
    }

    /// Change of the squared determinant in this step, extrapolated from the last steps.
    #[inline(always)]
    fn foreseen(&self) -> f64 {
        if let ([step], [slope]) = (&self.step[..], &self.slopes[..]) {
            return slope * step;
        }
        self.slopes.iter().zip(&self.step).map(|(slope, step)| slope * step).sum()
    }

    /// Whether this step might lead over a dead point, near which the squared determinant is linear in the driving
    /// angles.
    /// Such a step would reduce the squared determinant to a small fraction, and must be shortened.
    /// Without shortening, the step might jump over crank angles without a pose and end on another branch.
    fn is_bold(&self) -> bool {
        let goes = self.step.iter().any(|step| step.abs() > SMALLEST_STEP);
        goes && self.square + self.foreseen() < LEAST_LEFT * self.square
    }

    /// The joints whose coordinates are given.
    #[inline]
    pub(in crate::assur) fn given(&self) -> &[Given] {
        &self.given
    }

    /// The transmissions.
    #[inline]
    pub(in crate::assur) fn trains(&self) -> &[Train] {
        &self.trains
    }

    /// Computes in place the multipliers of the closing joints, of the given coordinates and of the transmissions:
    /// J^T lambda = -Q.
    /// First come the forces on the second links of the closing joints (N), x and y alternating.
    /// Next are the driving moments on the nodes with given joints (N m; for a slide, the force along the axis
    /// times [`Chain::size`]).
    /// The multipliers of the transmissions come last (N m). `Train::force` computes the forces of the transmissions
    /// from these multipliers.
    /// The input is the generalised forces on the unknowns (N m; for a slide, the force along the axis times
    /// [`Chain::size`]).
    /// The pose must be the last one solved.
    pub fn multipliers(&self, generalised: &mut [f64]) {
        generalised.iter_mut().for_each(|q| *q = -*q);
        self.jacobian.solve_transposed(generalised);
    }
}

/// Changes one unknown: rotates the node's link by an angle (rad), or slides it by a fraction of `size`.
#[inline]
fn advance<const SLIDING: bool>(node: &Node, slide: &mut f64, change: f64, size: f64, motions: &mut [Motion]) {
    if SLIDING && node.is_guided() {
        *slide += change * size;
    } else {
        let direction = &mut motions[node.link].direction;
        *direction = slightly_turned(*direction, change);
    }
}
