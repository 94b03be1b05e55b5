//! Any higher group of revolute pairs, by Newton's method on its own vector contours.
//!
//! The group's links hang on the known ones in a tree of joints; every joint left over closes a contour. Unknown are the
//! links' angles only, as many as contour equations: the gap of a closing joint is the sum of the link vectors on either way to
//! it, and its derivative by a link's angle is that vector turned by 90 degrees. Velocities and accelerations follow from
//! the same Jacobian: J omega = -(velocity of the ends), J alpha = -(acceleration of the ends) + centripetal parts.

use crate::math::dense::Lu;
use crate::math::{Motion, Vec2, cross, rotated, turned};
use crate::mechanism::{Group, Mechanism, Side};

/// Newton from the last pose needs a few iterations; more mean that it has lost the branch.
const MAX_ITERATIONS: usize = 10;
/// Largest turn of a link from the last pose (rad) that is still a continuation; its sine is what is compared.
const MAX_TURN: f64 = 0.3;

/// Largest turn of the last iteration (rad): what is left is its square, times the condition of the pose.
const LAST_CHANGE: f64 = 1e-8;

/// `direction` turned by a small angle (rad), to the third order of it, and of unit length to rounding.
#[inline]
fn slightly_turned(direction: Vec2, angle: f64) -> Vec2 {
    let turn = Vec2::new(1.0 - 0.5 * angle * angle, angle);
    rotated(direction, turn).normalize()
}

/// A link of the group, hung on one that is known before it.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// The link.
    pub link: usize,
    /// The joint it hangs by.
    pub joint: usize,
    /// That joint in the link's own frame.
    pub own: Vec2,
    /// That joint on the link it hangs on.
    pub parent: Side,
    /// Position of the parent among the nodes; `None` for a link outside the group.
    pub parent_node: Option<usize>,
}

/// Part of the way to a closing joint: a vector of one link.
#[derive(Clone, Copy, Debug)]
struct Segment {
    node: usize,
    local: Vec2,
    sign: f64,
}

/// A joint that closes a contour.
#[derive(Clone, Debug)]
pub struct Closing {
    /// The joint.
    pub joint: usize,
    /// Nodes of the joint's first and second link.
    pub nodes: [usize; 2],
    /// Known points from which the two ways start: second with sign +1, first with -1.
    ends: [(Side, f64); 2],
    segments: Vec<Segment>,
}

/// Higher group, ready for solving.
#[derive(Clone, Debug)]
pub struct Chain {
    nodes: Vec<Node>,
    closings: Vec<Closing>,
    jacobian: Lu,
    unknown: Vec<f64>,
    branch: f64,
    /// Directions of the links at the last pose, to go back to.
    kept: Vec<Vec2>,
    /// Turns of the links in the last step and in the one before (rad), and the last step of the driving angle (rad).
    turned: Vec<[f64; 2]>,
    last_step: f64,
}

impl Chain {
    /// Prepares a group.
    #[must_use]
    pub fn of(mechanism: &Mechanism, group: &Group) -> Self {
        let joints = mechanism.joints();
        let mut nodes: Vec<Node> = Vec::new();
        let mut used = vec![false; joints.len()];
        // Breadth first: all outer joints, then inner ones from the links already hung.
        while nodes.len() < group.links.len() {
            let known = |link: usize| !group.links.contains(&link) || nodes.iter().any(|node| node.link == link);
            let next = group.outer.iter().chain(&group.inner).copied().find_map(|joint| {
                let (a, b) = (joints[joint].first.link, joints[joint].second.link);
                match (known(a), known(b)) {
                    (true, false) => Some((joint, b)),
                    (false, true) => Some((joint, a)),
                    _ => None,
                }
            });
            let (joint, link) = next.expect("a group hangs together");
            used[joint] = true;
            let parent = joints[joint].other(link);
            let own = joints[joint].on(link).expect("the joint is on the link");
            let parent_node = nodes.iter().position(|node| node.link == parent.link);
            nodes.push(Node { link, joint, own, parent, parent_node });
        }
        let left = group.inner.iter().chain(&group.outer).copied().filter(|&joint| !used[joint]);
        let closings: Vec<Closing> = left.map(|joint| closing(mechanism, &nodes, joint)).collect();
        let n = nodes.len();
        Chain {
            nodes,
            closings,
            jacobian: Lu::new(n),
            unknown: vec![0.0; n],
            branch: 0.0,
            kept: vec![Vec2::zeros(); n],
            turned: vec![[0.0; 2]; n],
            last_step: f64::NAN,
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

    /// Gaps into `unknown` and their derivatives by the links' angles into the Jacobian.
    fn assemble(&mut self, motions: &[Motion]) {
        self.jacobian.clear();
        for (index, closing) in self.closings.iter().enumerate() {
            let row = 2 * index;
            let mut gap = Vec2::zeros();
            for (side, sign) in closing.ends {
                gap += motions[side.link].point(side.local) * sign;
            }
            for segment in &closing.segments {
                let arm = motions[self.nodes[segment.node].link].arm(segment.local) * segment.sign;
                gap += arm;
                self.jacobian.add(row, segment.node, -arm.y);
                self.jacobian.add(row + 1, segment.node, arm.x);
            }
            self.unknown[row] = gap.x;
            self.unknown[row + 1] = gap.y;
        }
    }

    /// Positions from those of the last pose, from which the driving angle has moved by `step` (rad); `false`, with the
    /// links' directions as they were, if the branch cannot be followed there.
    pub(super) fn positions(&mut self, step: f64, motions: &mut [Motion]) -> bool {
        for (kept, node) in self.kept.iter_mut().zip(&self.nodes) {
            *kept = motions[node.link].direction;
        }
        self.predict(step, motions);
        let followed = self.follow(motions) && self.is_near(motions);
        if followed {
            self.remember(step, motions);
        } else {
            self.last_step = f64::NAN;
            for (kept, node) in self.kept.iter().zip(&self.nodes) {
                motions[node.link].direction = *kept;
            }
        }
        followed
    }

    /// Whether a step of the driving angle (rad) has the size of the last one.
    fn is_repeated(&self, step: f64) -> bool {
        (step - self.last_step).abs() <= 1e-6 * step.abs()
    }

    /// Turns the links as the last two steps let expect, if this one is of the same size: the error is of third order.
    fn predict(&self, step: f64, motions: &mut [Motion]) {
        if self.is_repeated(step) {
            for (node, [last, before]) in self.nodes.iter().zip(&self.turned) {
                let direction = &mut motions[node.link].direction;
                *direction = slightly_turned(*direction, 2.0 * last - before);
            }
        }
    }

    /// Keeps the turns of this step for the next prediction.
    fn remember(&mut self, step: f64, motions: &[Motion]) {
        // After a step of another size the turn before is unknown: taking the last one for it predicts linearly.
        let same = self.is_repeated(step);
        for ((turned, kept), node) in self.turned.iter_mut().zip(&self.kept).zip(&self.nodes) {
            let turn = cross(*kept, motions[node.link].direction);
            *turned = [turn, if same { turned[0] } else { turn }];
        }
        self.last_step = step;
    }

    /// Whether no link has turned farther than a continuation may.
    fn is_near(&self, motions: &[Motion]) -> bool {
        let mut turns = self.kept.iter().zip(&self.nodes).map(|(kept, node)| (kept, motions[node.link].direction));
        turns.all(|(kept, now)| kept.dot(&now) > 0.0 && cross(*kept, now).abs() <= MAX_TURN)
    }

    /// Newton's method to rounding; leaves the Jacobian factored at the pose it ends in.
    fn follow(&mut self, motions: &mut [Motion]) -> bool {
        for _ in 0..MAX_ITERATIONS {
            self.assemble(motions);
            if !self.jacobian.factor() {
                return false;
            }
            self.jacobian.solve(&mut self.unknown);
            let change = self.unknown.iter().fold(0.0f64, |max, turn| max.max(turn.abs()));
            if !(change <= MAX_TURN) {
                return false;
            }
            for (node, &turn) in self.nodes.iter().zip(&self.unknown) {
                let direction = &mut motions[node.link].direction;
                *direction = slightly_turned(*direction, -turn);
            }
            // Quadratic convergence: what is left is of the order of the square.
            if change < LAST_CHANGE {
                if change > f64::EPSILON {
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

    /// Origins of all links from their directions; `false` if the pose lies beyond a singular one.
    fn hang(&mut self, motions: &mut [Motion]) -> bool {
        for node in &self.nodes {
            let at = motions[node.parent.link].point(node.parent.local);
            let motion = &mut motions[node.link];
            motion.origin = at - motion.arm(node.own);
        }
        let sign = self.jacobian.determinant_sign();
        if self.branch == 0.0 {
            self.branch = sign;
        }
        sign == self.branch
    }

    pub(super) fn velocities(&mut self, motions: &mut [Motion]) {
        for (index, closing) in self.closings.iter().enumerate() {
            let mut rate = Vec2::zeros();
            for (side, sign) in closing.ends {
                rate -= motions[side.link].point_velocity(side.local) * sign;
            }
            self.unknown[2 * index] = rate.x;
            self.unknown[2 * index + 1] = rate.y;
        }
        self.jacobian.solve(&mut self.unknown);
        for (node, &omega) in self.nodes.iter().zip(&self.unknown) {
            let at = motions[node.parent.link].point_velocity(node.parent.local);
            let motion = &mut motions[node.link];
            motion.omega = omega;
            motion.velocity = at - turned(motion.arm(node.own)) * omega;
        }
    }

    pub(super) fn accelerations(&mut self, motions: &mut [Motion]) {
        for (index, closing) in self.closings.iter().enumerate() {
            let mut second = Vec2::zeros();
            for (side, sign) in closing.ends {
                second -= motions[side.link].point_acceleration(side.local) * sign;
            }
            for segment in &closing.segments {
                let motion = &motions[self.nodes[segment.node].link];
                second += motion.arm(segment.local) * (segment.sign * motion.omega * motion.omega);
            }
            self.unknown[2 * index] = second.x;
            self.unknown[2 * index + 1] = second.y;
        }
        self.jacobian.solve(&mut self.unknown);
        for (node, &alpha) in self.nodes.iter().zip(&self.unknown) {
            let at = motions[node.parent.link].point_acceleration(node.parent.local);
            let motion = &mut motions[node.link];
            let own = motion.arm(node.own);
            motion.alpha = alpha;
            motion.acceleration = at - turned(own) * alpha + own * (motion.omega * motion.omega);
        }
    }

    /// Multipliers of the closing joints (forces on their second links, x and y in turn, N) from the generalised forces
    /// on the links' angles (N m), in place: J^T lambda = -Q. The pose must be the last one solved.
    pub fn multipliers(&self, generalised: &mut [f64]) {
        generalised.iter_mut().for_each(|q| *q = -*q);
        self.jacobian.solve_transposed(generalised);
    }
}

/// The way to a closing joint over both of its links.
fn closing(mechanism: &Mechanism, nodes: &[Node], joint: usize) -> Closing {
    let found = &mechanism.joints()[joint];
    let mut segments = Vec::new();
    let mut way = |side: Side, sign: f64| {
        let node =
            nodes.iter().position(|node| node.link == side.link).expect("outer joints carry the links they are on");
        let (mut next, mut local, mut end) = (Some(node), side.local, side);
        while let Some(index) = next {
            let own = &nodes[index];
            segments.push(Segment { node: index, local: local - own.own, sign });
            (next, local, end) = (own.parent_node, own.parent.local, own.parent);
        }
        (node, (end, sign))
    };
    let (second, second_end) = way(found.second, 1.0);
    let (first, first_end) = way(found.first, -1.0);
    Closing { joint, nodes: [first, second], ends: [second_end, first_end], segments }
}
