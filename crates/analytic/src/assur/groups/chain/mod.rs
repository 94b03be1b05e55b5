//! Any higher group, by Newton's method on its own vector contours.
//!
//! A tree of joints connects the group's links to the known ones. It contains all prismatic joints, which cannot
//! form a loop.
//! Every remaining revolute joint closes a contour.
//! The unknowns are one angle for every link with a revolute joint to its parent and one slide for every link with
//! a prismatic one.
//! There are as many unknowns as contour equations.
//! The gap of a closing joint is the sum of the link and slide vectors along both ways to it.
//! Its derivative by an angle is the sum of the vectors that turn with it, turned by 90 degrees; by a slide it is
//! the axis.
//! Velocities and accelerations follow from the same Jacobian: J q' = -(velocity of the ends),
//! J q'' = -(acceleration of the ends) + centripetal and Coriolis parts.

mod contour;

pub use contour::{Closing, Node};

use self::contour::{Segment, contours};
use linkage::math::dense::Lu;
use linkage::math::{KeepNan, Motion, Vec2, cross, rotated, turned};
use linkage::mechanism::{Group, Mechanism};

/// Newton's method from the last pose needs a few iterations. If it needs more, it has lost the branch.
const MAX_ITERATIONS: usize = 10;
/// Largest turn of a link from the last pose (rad) that is accepted as a continuation. Its sine is compared.
/// For a slide the limit is the same share of the mechanism's size.
const MAX_TURN: f64 = 0.3;

/// Largest turn of the last iteration (rad). The remaining error is its square, times the condition number of the
/// pose.
const LAST_CHANGE: f64 = 1e-8;

/// Change of the last iteration (rad) up to which the Jacobian is that of the pose itself, to rounding.
/// Predictions from five steps magnify the rounding of a turn up to 31 times.
/// In steps of a tenth of a degree they come this near to the solution.
const SAME_POSE: f64 = 4e-14;
/// Largest correction of a predicted pose (rad). Near a dead point predictions are poor, and the corrected pose
/// may be on another branch.
const MAX_CORRECTION: f64 = 0.01;
/// Share of the squared determinant that must be left after a step, as extrapolated from the last step.
const LEAST_LEFT: f64 = 0.25;
/// Steps of the driving angles (rad) below which a jump to another branch is no longer possible.
const SMALLEST_STEP: f64 = 1e-6;
/// Number of steps that a prediction uses.
const MEMORY: usize = 5;
/// Weights of the last steps, the newest first, for one to five known steps: binomial coefficients with
/// alternating signs.
const EXTRAPOLATION: [[f64; MEMORY]; MEMORY] = [
    [1.0, 0.0, 0.0, 0.0, 0.0],
    [2.0, -1.0, 0.0, 0.0, 0.0],
    [3.0, -3.0, 1.0, 0.0, 0.0],
    [4.0, -6.0, 4.0, -1.0, 0.0],
    [5.0, -10.0, 10.0, -5.0, 1.0],
];

/// `direction` turned by a small angle (rad), to the seventh order of the angle, and of unit length to rounding.
#[inline]
fn slightly_turned(direction: Vec2, angle: f64) -> Vec2 {
    let square = angle * angle;
    let sine = angle * (1.0 - square * (1.0 / 6.0 - square / 120.0));
    let cosine = 1.0 - square * (0.5 - square * (1.0 / 24.0 - square / 720.0));
    rotated(direction, Vec2::new(cosine, sine)).normalize()
}

/// Angle of a small sine (rad), to the seventh order of the sine.
#[inline]
fn small_arcsine(sine: f64) -> f64 {
    let square = sine * sine;
    sine * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0)))
}

/// Higher group, prepared for solving.
#[derive(Clone, Debug)]
pub struct Chain {
    nodes: Vec<Node>,
    closings: Vec<Closing>,
    jacobian: Lu,
    unknown: Vec<f64>,
    branch: f64,
    /// Square of the determinant at the last pose, and its derivatives by the driving angles (1/rad).
    /// Every step corrects the derivative along itself (Broyden's update).
    square: f64,
    slopes: Vec<f64>,
    /// Driving angles at the last pose, and their changes to the wanted one (rad).
    at: Vec<f64>,
    step: Vec<f64>,
    /// Directions of the links at the last pose, for a return to it.
    kept: Vec<Vec2>,
    /// Slides at this pose and at the last one, and their rates (m, m, m/s). 0 for revolute joints.
    slides: Vec<f64>,
    kept_slides: Vec<f64>,
    speeds: Vec<f64>,
    /// Length by which slides are divided, so that all unknowns are of one order of magnitude (m).
    size: f64,
    is_sliding: bool,
    /// Changes of the unknowns in the last steps, the newest first; how many of these steps were the same; and that
    /// step (rad of the driving angles).
    turned: Vec<[f64; MEMORY]>,
    equal_steps: usize,
    last_step: Vec<f64>,
}

impl Chain {
    /// Prepares a group of a mechanism with this number of driving links.
    #[must_use]
    pub fn of(mechanism: &Mechanism, group: &Group, drives: usize) -> Self {
        let (nodes, closings) = contours(mechanism, group);
        let n = nodes.len();
        let is_sliding = nodes.iter().any(|node| node.guided.is_some());
        Chain {
            nodes,
            closings,
            jacobian: Lu::new(n),
            unknown: vec![0.0; n],
            branch: 0.0,
            square: f64::NAN,
            slopes: vec![0.0; drives],
            at: vec![f64::NAN; drives],
            step: vec![0.0; drives],
            kept: vec![Vec2::zeros(); n],
            slides: vec![f64::NAN; n],
            kept_slides: vec![0.0; n],
            speeds: vec![0.0; n],
            size: mechanism.size(),
            is_sliding,
            turned: vec![[0.0; MEMORY]; n],
            equal_steps: 0,
            last_step: vec![f64::NAN; drives],
        }
    }

    /// The group's links, parents before children.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The joints that close its contours.
    #[must_use]
    pub fn closings(&self) -> &[Closing] {
        &self.closings
    }

    /// Length by which the unknowns divide slides (m).
    #[must_use]
    pub fn size(&self) -> f64 {
        self.size
    }

    /// A segment's vector, with its sign.
    #[inline]
    fn vector(&self, segment: &Segment, motions: &[Motion]) -> Vec2 {
        let node = &self.nodes[segment.node];
        match segment.local {
            Some(local) => motions[node.link].arm(local) * segment.sign,
            None => self.axis(segment, motions) * self.slides[segment.node],
        }
    }

    /// The axis of a slide segment, with its sign.
    #[inline]
    fn axis(&self, segment: &Segment, motions: &[Motion]) -> Vec2 {
        self.nodes[segment.node].axis(motions).expect("slides belong to prismatic joints") * segment.sign
    }

    /// The link that a segment's vector turns with, and the node whose unknown is its angle.
    #[inline]
    fn carrier(&self, segment: &Segment) -> (usize, Option<usize>) {
        let node = &self.nodes[segment.node];
        (if segment.local.is_some() { node.link } else { node.parent.link }, node.spin)
    }

    /// Turns every guided link with its parent.
    fn aim(&self, motions: &mut [Motion]) {
        if !self.is_sliding {
            return;
        }
        for node in &self.nodes {
            if let Some(guided) = node.guided {
                motions[node.link].direction = rotated(motions[node.parent.link].direction, guided.turn);
            }
        }
    }

    /// Writes the gaps to `unknown` and their derivatives to the Jacobian.
    fn assemble(&mut self, motions: &mut [Motion]) {
        self.aim(motions);
        self.jacobian.clear();
        for (index, closing) in self.closings.iter().enumerate() {
            let row = 2 * index;
            let mut gap = Vec2::zeros();
            for (side, sign) in closing.ends {
                gap += motions[side.link].point(side.local) * sign;
            }
            for segment in &closing.segments {
                let vector = self.vector(segment, motions);
                gap += vector;
                if let Some(column) = self.carrier(segment).1 {
                    self.jacobian.add(row, column, -vector.y);
                    self.jacobian.add(row + 1, column, vector.x);
                }
                if segment.local.is_none() {
                    let axis = self.axis(segment, motions) * self.size;
                    self.jacobian.add(row, segment.node, axis.x);
                    self.jacobian.add(row + 1, segment.node, axis.y);
                }
            }
            self.unknown[row] = gap.x;
            self.unknown[row + 1] = gap.y;
        }
    }

    /// Reads the slides of the start pose, which the links still have when the group is placed for the first time.
    fn read_slides(&mut self, motions: &[Motion]) {
        for (slide, node) in self.slides.iter_mut().zip(&self.nodes) {
            let from = motions[node.parent.link].point(node.parent.local);
            let to = motions[node.link].point(node.own);
            *slide = node.axis(motions).map_or(0.0, |axis| axis.dot(&(to - from)));
        }
    }

    /// Takes the last pose for that of a first driving angle farther on by `way` (rad), some whole turns.
    pub(super) fn skip(&mut self, way: f64) {
        self.at[0] += way;
        // Whole turns are rounded: the next step is not the same as the last.
        self.last_step.fill(f64::NAN);
        self.equal_steps = 0;
    }

    /// Positions at these driving angles (rad), from those of the last pose.
    /// Returns `false`, with the links' directions unchanged, if the branch cannot be followed there.
    pub(super) fn positions(&mut self, angles: &[f64], motions: &mut [Motion]) -> bool {
        if self.slides[0].is_nan() {
            self.read_slides(motions);
        }
        for ((step, angle), at) in self.step.iter_mut().zip(angles).zip(&self.at) {
            *step = angle - at;
        }
        if self.is_bold() {
            self.last_step.fill(f64::NAN);
            return false;
        }
        for (kept, node) in self.kept.iter_mut().zip(&self.nodes) {
            *kept = motions[node.link].direction;
        }
        self.kept_slides.copy_from_slice(&self.slides);
        let allowed = if self.predict(motions) { MAX_CORRECTION } else { MAX_TURN };
        let followed = self.follow(allowed, motions) && self.is_near(motions);
        if followed {
            self.remember(motions);
            self.at.copy_from_slice(angles);
            self.learn();
        } else {
            self.last_step.fill(f64::NAN);
            for (kept, node) in self.kept.iter().zip(&self.nodes) {
                motions[node.link].direction = *kept;
            }
            self.slides.copy_from_slice(&self.kept_slides);
        }
        followed
    }

    /// Positions at these driving angles (rad) near the expected poses `like`, on whatever side of a singular pose they
    /// are.
    /// Returns `false` if there are none so near.
    pub(super) fn positions_like(&mut self, like: &[Motion], angles: &[f64], motions: &mut [Motion]) -> bool {
        for node in &self.nodes {
            motions[node.link].direction = like[node.link].direction;
        }
        self.read_slides(like);
        self.branch = 0.0;
        if !self.follow(MAX_CORRECTION, motions) {
            return false;
        }
        self.at.copy_from_slice(angles);
        self.last_step.fill(f64::NAN);
        self.equal_steps = 0;
        self.slopes.fill(0.0);
        self.square = self.jacobian.determinant().powi(2);
        true
    }

    /// Determinant of the Jacobian at the last pose. Along a branch it goes through zero at a change point.
    pub(crate) fn determinant(&self) -> f64 {
        self.jacobian.determinant()
    }

    /// Stores the squared determinant of this pose, and how it has changed in this step.
    fn learn(&mut self) {
        let square = self.jacobian.determinant().powi(2);
        let length = self.step.iter().map(|step| step * step).sum::<f64>();
        if length > 0.0 && self.square.is_finite() {
            let rest = square - self.square - self.foreseen();
            self.slopes.iter_mut().zip(&self.step).for_each(|(slope, step)| *slope += rest * step / length);
        }
        self.square = square;
    }

    /// Change of the squared determinant over this step, as extrapolated from the last ones.
    fn foreseen(&self) -> f64 {
        self.slopes.iter().zip(&self.step).map(|(slope, step)| slope * step).sum()
    }

    /// Whether this step of the driving angles is the same as the last one.
    fn is_repeated(&self) -> bool {
        self.step.iter().zip(&self.last_step).all(|(step, last)| (step - last).abs() <= 1e-6 * step.abs())
    }

    /// Turns the links as extrapolated from the last steps, if this step is the same, and returns whether it is.
    /// The polynomial through the last steps is continued, so that its next difference is zero.
    fn predict(&mut self, motions: &mut [Motion]) -> bool {
        let repeated = self.is_repeated();
        if repeated {
            let weights = &EXTRAPOLATION[self.equal_steps.min(MEMORY) - 1];
            for (index, turned) in self.turned.iter().enumerate() {
                let change = turned.iter().zip(weights).map(|(turn, weight)| turn * weight).sum();
                advance(&self.nodes[index], &mut self.slides[index], change, self.size, motions);
            }
        }
        repeated
    }

    /// Stores the turns of this step for the next prediction.
    fn remember(&mut self, motions: &[Motion]) {
        self.equal_steps = if self.is_repeated() { self.equal_steps + 1 } else { 1 };
        for (index, node) in self.nodes.iter().enumerate() {
            let turn = match node.guided {
                None => small_arcsine(cross(self.kept[index], motions[node.link].direction)),
                Some(_) => (self.slides[index] - self.kept_slides[index]) / self.size,
            };
            let turned = &mut self.turned[index];
            turned.copy_within(..MEMORY - 1, 1);
            turned[0] = turn;
        }
        self.last_step.copy_from_slice(&self.step);
    }

    /// Whether no link has turned or slid farther than a continuation allows.
    fn is_near(&self, motions: &[Motion]) -> bool {
        let mut slides = self.slides.iter().zip(&self.kept_slides);
        if self.is_sliding && !slides.all(|(now, kept)| (now - kept).abs() <= MAX_TURN * self.size) {
            return false;
        }
        let mut turns = self.kept.iter().zip(&self.nodes).map(|(kept, node)| (kept, motions[node.link].direction));
        turns.all(|(kept, now)| kept.dot(&now) > 0.0 && cross(*kept, now).abs() <= MAX_TURN)
    }

    /// Newton's method to rounding. Leaves the factored Jacobian of the pose in which it ends.
    fn follow(&mut self, allowed: f64, motions: &mut [Motion]) -> bool {
        for _ in 0..MAX_ITERATIONS {
            self.assemble(motions);
            if !self.jacobian.factor() {
                return false;
            }
            self.jacobian.solve(&mut self.unknown);
            let change = self.unknown.iter().fold(0.0f64, |max, turn| max.larger(turn.abs()));
            if !(change <= allowed) {
                return false;
            }
            for (index, change) in self.unknown.iter().enumerate() {
                advance(&self.nodes[index], &mut self.slides[index], -change, self.size, motions);
            }
            // Quadratic convergence: the remaining error is of the order of the square.
            if change < LAST_CHANGE {
                if change > SAME_POSE {
                    self.assemble(motions);
                    if !self.jacobian.factor() {
                        return false;
                    }
                }
                return self.hang(motions);
            }
        }
        false
    }

    /// Origins of all links from their directions. Returns `false` if the pose lies beyond a singular one.
    fn hang(&mut self, motions: &mut [Motion]) -> bool {
        self.aim(motions);
        for (node, slide) in self.nodes.iter().zip(&self.slides) {
            let mut at = motions[node.parent.link].point(node.parent.local);
            if let Some(axis) = node.axis(motions) {
                at += axis * *slide;
            }
            let motion = &mut motions[node.link];
            motion.origin = at - motion.arm(node.own);
        }
        let sign = self.jacobian.determinant_sign();
        if self.branch == 0.0 {
            self.branch = sign;
        }
        sign == self.branch
    }

    /// Whether this step might lead over a dead point. Near one, the square of the determinant is linear in the
    /// driving angles.
    /// A step on which it would lose most of its value must be smaller, or it might end on the other side of a gap
    /// between two branches.
    fn is_bold(&self) -> bool {
        let goes = self.step.iter().any(|step| step.abs() > SMALLEST_STEP);
        goes && self.square + self.foreseen() < LEAST_LEFT * self.square
    }

    pub(super) fn velocities(&mut self, motions: &mut [Motion]) {
        for node in self.led() {
            motions[node.link].omega = motions[node.parent.link].omega;
        }
        for (index, closing) in self.closings.iter().enumerate() {
            let mut rate = Vec2::zeros();
            for (side, sign) in closing.ends {
                rate -= motions[side.link].point_velocity(side.local) * sign;
            }
            for segment in closing.segments.iter().filter(|_| self.is_sliding) {
                if let (carrier, None) = self.carrier(segment) {
                    rate -= turned(self.vector(segment, motions)) * motions[carrier].omega;
                }
            }
            self.unknown[2 * index] = rate.x;
            self.unknown[2 * index + 1] = rate.y;
        }
        self.jacobian.solve(&mut self.unknown);
        for (index, node) in self.nodes.iter().enumerate() {
            let parent = &motions[node.parent.link];
            let (at, omega) = match node.axis(motions) {
                None => (parent.point_velocity(node.parent.local), self.unknown[index]),
                Some(axis) => {
                    self.speeds[index] = self.unknown[index] * self.size;
                    let carried = parent.velocity_at(motions[node.link].point(node.own));
                    (carried + axis * self.speeds[index], parent.omega)
                }
            };
            let motion = &mut motions[node.link];
            motion.omega = omega;
            motion.velocity = at - turned(motion.arm(node.own)) * omega;
        }
    }

    pub(super) fn accelerations(&mut self, motions: &mut [Motion]) {
        for node in self.led() {
            motions[node.link].alpha = motions[node.parent.link].alpha;
        }
        for (index, closing) in self.closings.iter().enumerate() {
            let mut second = Vec2::zeros();
            for (side, sign) in closing.ends {
                second -= motions[side.link].point_acceleration(side.local) * sign;
            }
            for segment in &closing.segments {
                let (carrier, spin) = self.carrier(segment);
                let (motion, vector) = (&motions[carrier], self.vector(segment, motions));
                second += vector * (motion.omega * motion.omega);
                if spin.is_none() {
                    second -= turned(vector) * motion.alpha;
                }
                if segment.local.is_none() {
                    second -= self.coriolis(segment.node, turned(self.axis(segment, motions)), motions);
                }
            }
            self.unknown[2 * index] = second.x;
            self.unknown[2 * index + 1] = second.y;
        }
        self.jacobian.solve(&mut self.unknown);
        for (index, node) in self.nodes.iter().enumerate() {
            let parent = &motions[node.parent.link];
            let (at, alpha) = match node.axis(motions) {
                None => (parent.point_acceleration(node.parent.local), self.unknown[index]),
                Some(axis) => {
                    let carried = parent.acceleration_at(motions[node.link].point(node.own));
                    let relative = axis * (self.unknown[index] * self.size);
                    (carried + relative + self.coriolis(index, turned(axis), motions), parent.alpha)
                }
            };
            let motion = &mut motions[node.link];
            let own = motion.arm(node.own);
            motion.alpha = alpha;
            motion.acceleration = at - turned(own) * alpha + own * (motion.omega * motion.omega);
        }
    }

    /// The nodes whose rotation is led by links outside the group, parents first.
    /// Their angle is not an unknown of the group, so their rotation is known before the group is solved.
    fn led(&self) -> impl Iterator<Item = &Node> {
        self.nodes.iter().filter(|node| self.is_sliding && node.spin.is_none())
    }

    /// Coriolis acceleration of a sliding node along the normal of its axis.
    #[inline]
    fn coriolis(&self, node: usize, normal: Vec2, motions: &[Motion]) -> Vec2 {
        normal * (2.0 * self.speeds[node] * motions[self.nodes[node].parent.link].omega)
    }

    /// Multipliers of the closing joints (forces on their second links, x and y in turn, N), in place: J^T lambda
    /// = -Q.
    /// The input is the generalised forces on the unknowns (N m; for a slide, the force along the axis times
    /// [`Chain::size`]).
    /// The pose must be the last one solved.
    pub fn multipliers(&self, generalised: &mut [f64]) {
        generalised.iter_mut().for_each(|q| *q = -*q);
        self.jacobian.solve_transposed(generalised);
    }
}

/// Changes one unknown: turns the node's link by an angle (rad), or slides it by a share of `size`.
#[inline]
fn advance(node: &Node, slide: &mut f64, change: f64, size: f64, motions: &mut [Motion]) {
    if node.guided.is_some() {
        *slide += change * size;
    } else {
        let direction = &mut motions[node.link].direction;
        *direction = slightly_turned(*direction, change);
    }
}
