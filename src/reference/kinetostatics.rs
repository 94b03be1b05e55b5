//! Joint reactions group by group, last group first, and the balancing moment from the driving link's equilibrium.
//!
//! D'Alembert: every link carries m (g - a) at its mass centre, the moment -J alpha, its loads, and the forces of the
//! groups that hang on it. For an RRR dyad with outer joints A, B and inner joint C, the moments of each link about C
//! and the forces of both give (u x R = -M_a, w x R = M_b - w x F with u = A - C, w = B - C) the reaction at A;
//! Artobolevsky, "Theory of mechanisms and machines", kinetostatics of class II groups.

use crate::assur::{Chain, Plan, Step};
use crate::case::Case;
use crate::math::{Motion, Vec2, cross};
use crate::mechanism::Group;

/// A force that acts on a link at one of its joints: `sign` times the joint's force.
#[derive(Clone, Copy, Debug)]
struct Action {
    joint: usize,
    local: Vec2,
    sign: f64,
}

impl Action {
    fn of(case: &Case, joint: usize, link: usize) -> Self {
        let found = &case.mechanism.joints()[joint];
        let local = found.on(link).expect("the joint is on the link");
        Action { joint, local, sign: if found.second.link == link { 1.0 } else { -1.0 } }
    }
}

/// A link with the joints at which later groups hang on it.
#[derive(Clone, Debug)]
struct Body {
    link: usize,
    hanging: Vec<Action>,
}

impl Body {
    fn of(case: &Case, link: usize, settled: &[bool]) -> Self {
        let joints = case.mechanism.joints().iter().enumerate();
        let on_link = joints.filter(|(index, joint)| settled[*index] && joint.on(link).is_some());
        Body { link, hanging: on_link.map(|(index, _)| Action::of(case, index, link)).collect() }
    }

    /// Resultant of all known forces on the link and their moment about the world point `pole`.
    #[inline]
    fn resultant(&self, case: &Case, motions: &[Motion], forces: &[Vec2], pole: Vec2) -> (Vec2, f64) {
        let body = &case.mechanism.links()[self.link];
        let motion = &motions[self.link];
        let mut force = (case.gravity - motion.point_acceleration(body.mass_centre)) * body.mass;
        let mut moment = cross(motion.point(body.mass_centre) - pole, force) - body.inertia * motion.alpha
            + case.load_moment(self.link, motion.omega);
        for action in &self.hanging {
            let hung = forces[action.joint] * action.sign;
            force += hung;
            moment += cross(motion.point(action.local) - pole, hung);
        }
        (force, moment)
    }
}

/// A dyad, seen from its forces.
#[derive(Clone, Debug)]
struct Dyad {
    bodies: [Body; 2],
    outer: [Action; 2],
    inner: [Action; 2],
}

impl Dyad {
    fn of(case: &Case, group: &Group, settled: &[bool]) -> Self {
        let both = |joint: [usize; 2]| [0, 1].map(|k| Action::of(case, joint[k], group.links[k]));
        Dyad {
            bodies: [0, 1].map(|k| Body::of(case, group.links[k], settled)),
            outer: both([group.outer[0], group.outer[1]]),
            inner: both([group.inner[0], group.inner[0]]),
        }
    }

    #[inline]
    fn solve(&self, case: &Case, motions: &[Motion], forces: &mut [Vec2]) {
        let [a, b] = &self.bodies;
        let [outer_a, outer_b] = self.outer;
        let pole = motions[a.link].point(self.inner[0].local);
        let u = motions[a.link].point(outer_a.local) - pole;
        let w = motions[b.link].point(outer_b.local) - pole;
        let (force_a, moment_a) = a.resultant(case, motions, forces, pole);
        let (force_b, moment_b) = b.resultant(case, motions, forces, pole);
        let total = force_a + force_b;
        let reaction_a = (w * -moment_a - u * (moment_b - cross(w, total))) / cross(u, w);
        let reaction_b = -(reaction_a + total);
        forces[outer_a.joint] = reaction_a * outer_a.sign;
        forces[outer_b.joint] = reaction_b * outer_b.sign;
        forces[self.inner[0].joint] = (reaction_a + force_a) * -self.inner[0].sign;
    }
}

/// A higher group, seen from its forces.
///
/// Virtual work on the links' angles, with the closing joints cut, gives the forces there (J^T lambda = -Q); those of the
/// other joints follow from the outermost link inwards.
#[derive(Clone, Debug)]
struct Higher {
    /// Index of the group's [`Chain`] in the plan.
    step: usize,
    bodies: Vec<Body>,
    /// Of each node: its own hanging joint, as it acts on the node's link.
    hung: Vec<Action>,
    /// Known force on each node's link and on all that hangs on it (N).
    carried: Vec<Vec2>,
    multipliers: Vec<f64>,
}

impl Higher {
    fn of(case: &Case, step: usize, chain: &Chain, settled: &[bool]) -> Self {
        let nodes = chain.nodes();
        Higher {
            step,
            bodies: nodes.iter().map(|node| Body::of(case, node.link, settled)).collect(),
            hung: nodes.iter().map(|node| Action::of(case, node.joint, node.link)).collect(),
            carried: vec![Vec2::zeros(); nodes.len()],
            multipliers: vec![0.0; nodes.len()],
        }
    }

    fn solve(&mut self, case: &Case, plan: &Plan, motions: &[Motion], forces: &mut [Vec2]) {
        let Step::Chain(chain) = &plan.steps()[self.step] else { unreachable!("the step is a chain") };
        let nodes = chain.nodes();
        self.carried.fill(Vec2::zeros());
        self.multipliers.fill(0.0);
        for (index, node) in nodes.iter().enumerate().rev() {
            let pole = motions[node.link].point(node.own);
            let (force, moment) = self.bodies[index].resultant(case, motions, forces, pole);
            self.multipliers[index] += moment;
            self.carried[index] += force;
            if let Some(parent) = node.parent_node {
                let arm = pole - motions[node.parent.link].point(nodes[parent].own);
                self.multipliers[parent] += cross(arm, self.carried[index]);
                let carried = self.carried[index];
                self.carried[parent] += carried;
            }
        }
        chain.multipliers(&mut self.multipliers);
        for (index, closing) in chain.closings().iter().enumerate() {
            let force = Vec2::new(self.multipliers[2 * index], self.multipliers[2 * index + 1]);
            forces[closing.joint] = force;
            for (node, sign) in closing.nodes.into_iter().zip([-1.0, 1.0]) {
                let mut next = Some(node);
                while let Some(carrier) = next {
                    self.carried[carrier] += force * sign;
                    next = nodes[carrier].parent_node;
                }
            }
        }
        for (index, action) in self.hung.iter().enumerate() {
            forces[action.joint] = -self.carried[index] * action.sign;
        }
    }
}

/// One group, seen from its forces.
#[derive(Clone, Debug)]
enum Part {
    Dyad(Dyad),
    Higher(Higher),
}

/// The force analysis of a case, ready for pose after pose without allocation.
#[derive(Clone, Debug)]
pub(super) struct Kinetostatics {
    parts: Vec<Part>,
    driver: Body,
    pivot: Action,
}

impl Kinetostatics {
    /// Prepares the groups in reverse order, then the driving link.
    pub(super) fn of(case: &Case, plan: &Plan) -> Self {
        let mut settled = vec![false; case.mechanism.joints().len()];
        let mut parts = Vec::with_capacity(case.structure.groups.len());
        for (step, group) in case.structure.groups.iter().enumerate().rev() {
            parts.push(match &plan.steps()[step] {
                Step::Rrr(_) => Part::Dyad(Dyad::of(case, group, &settled)),
                Step::Chain(chain) => Part::Higher(Higher::of(case, step, chain, &settled)),
            });
            group.inner.iter().chain(&group.outer).for_each(|&joint| settled[joint] = true);
        }
        let driver = Body::of(case, case.drive.link, &settled);
        Kinetostatics { parts, driver, pivot: Action::of(case, case.drive.joint, case.drive.link) }
    }

    /// Fills in the force of the first link on the second in every joint (N) and returns the balancing moment on the
    /// driving link (N m), from its equilibrium about the pivot. The pose must be the last one that `plan` has solved.
    pub(super) fn solve(&mut self, case: &Case, plan: &Plan, motions: &[Motion], forces: &mut [Vec2]) -> f64 {
        for part in &mut self.parts {
            match part {
                Part::Dyad(dyad) => dyad.solve(case, motions, forces),
                Part::Higher(higher) => higher.solve(case, plan, motions, forces),
            }
        }
        let pole = motions[self.driver.link].point(self.pivot.local);
        let (force, moment) = self.driver.resultant(case, motions, forces, pole);
        forces[self.pivot.joint] = -force * self.pivot.sign;
        -moment
    }
}
