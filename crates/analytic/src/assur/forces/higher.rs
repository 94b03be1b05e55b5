//! Joint reactions of any higher group.
//!
//! The closing joints are cut. The principle of virtual work for the unknowns of the contours gives the forces in the
//! closing joints (J^T lambda = -Q).
//! The forces in the remaining joints follow, from the outermost link inwards.

use super::body::{Action, Body, Reactions, Settled};
use crate::assur::groups::{Chain, SolutionPlan, Step};
use linkage::case::Case;
use linkage::math::{Motion, Vec2, cross};
use linkage::mechanism::GroupId;

/// Force analysis of a higher group.
#[derive(Clone, Debug)]
pub(super) struct Higher {
    /// Index of the group's [`Chain`] in the plan.
    step: GroupId,
    bodies: Vec<Body>,
    /// For each node: the action on the node's link, exerted by the joint between this link and its parent.
    hung: Vec<Action>,
    /// For each node: the known force on its link and on all links attached to it (N), and the moment of this force
    /// about the joint to the node's parent (N m).
    carried: Vec<(Vec2, f64)>,
    /// For each node: force and moment of the closing joints on its link and on all links attached to it.
    cut: Vec<(Vec2, f64)>,
    multipliers: Vec<f64>,
    /// The transfer of load from each node to its parent, in order from the outermost node inwards.
    inwards: Vec<Inwards>,
}

/// A node and its parent. A link on a pin transmits only a force to its parent.
/// A link on a guide turns with its parent, so it also transmits a moment to its parent.
#[derive(Clone, Copy, Debug)]
struct Inwards {
    child: usize,
    parent: usize,
    is_guided: bool,
}

impl Higher {
    pub(super) fn of(case: &Case, step: GroupId, chain: &Chain, settled: &Settled) -> Self {
        let nodes = chain.nodes();
        let inwards = nodes.iter().enumerate().rev().filter_map(|(child, node)| {
            let is_guided = node.is_guided();
            node.parent_node.map(|parent| Inwards { child, parent, is_guided })
        });
        Higher {
            step,
            inwards: inwards.collect(),
            bodies: nodes.iter().map(|node| Body::of(case, node.link, settled)).collect(),
            hung: nodes.iter().map(|node| Action::of(case, node.joint, node.link)).collect(),
            carried: vec![(Vec2::zeros(), 0.0); nodes.len()],
            cut: vec![(Vec2::zeros(), 0.0); nodes.len()],
            multipliers: vec![0.0; nodes.len()],
        }
    }

    pub(super) fn solve(&mut self, case: &Case, plan: &SolutionPlan, motions: &[Motion], reactions: &mut Reactions) {
        let Step::Chain(chain) = &plan.steps()[self.step] else { unreachable!("the step is a chain") };
        match chain.is_sliding() {
            true => self.solve_as::<true>(case, chain, motions, reactions),
            false => self.solve_as::<false>(case, chain, motions, reactions),
        }
    }

    /// Solves a group. `SLIDING` states whether the group has guides.
    fn solve_as<const SLIDING: bool>(
        &mut self,
        case: &Case,
        chain: &Chain,
        motions: &[Motion],
        reactions: &mut Reactions,
    ) {
        let nodes = chain.nodes();
        for (index, (carried, body)) in self.carried.iter_mut().zip(&self.bodies).enumerate() {
            *carried = body.resultant(case, motions, reactions, chain.pole(index));
        }
        if !chain.trains().is_empty() {
            self.transmit::<SLIDING>(case, chain, motions, reactions);
        }
        gather::<SLIDING>(&self.inwards, &mut self.carried, chain);
        generalise::<SLIDING>(&mut self.multipliers, &self.carried, chain, motions);
        chain.multipliers(&mut self.multipliers);
        for cut in &mut self.cut {
            *cut = (Vec2::zeros(), 0.0);
        }
        for (given, moment) in chain.given().iter().zip(&self.multipliers[2 * chain.closings().len()..]) {
            reactions.efforts[given.drive] = given.factor * moment;
            self.hung[given.node].put_moment(*moment, reactions);
            // A driving moment on a link acts on its parent in the opposite sense.
            if let (false, Some(parent)) = (given.is_slide, nodes[given.node].parent_node) {
                self.cut[given.node].1 += moment;
                self.cut[parent].1 -= moment;
            }
        }
        for (closing, force) in chain.closings().iter().zip(self.multipliers.chunks_exact(2)) {
            let force = Vec2::new(force[0], force[1]);
            reactions.forces[closing.joint] = force;
            for (node, sign) in closing.nodes.into_iter().zip([-1.0, 1.0]) {
                let Some(node) = node else { continue };
                let (total, moment) = &mut self.cut[node];
                *total += force * sign;
                // Only a group with guides needs moments, because a pin transmits no moment.
                if SLIDING {
                    *moment += cross(closing.place(motions) - chain.pole(node), force) * sign;
                }
            }
        }
        for link in &self.inwards {
            let (force, moment) = self.cut[link.child];
            let (total, about) = &mut self.cut[link.parent];
            *total += force;
            if SLIDING {
                let arm = chain.pole(link.child) - chain.pole(link.parent);
                *about += cross(arm, force) + if link.is_guided { moment } else { 0.0 };
            }
        }
        for (index, (action, (carried, cut))) in self.hung.iter().zip(self.carried.iter().zip(&self.cut)).enumerate() {
            let force = carried.0 + cut.0;
            if SLIDING && nodes[index].is_guided() {
                action.put_guided(-force, carried.1 + cut.1, chain.pole(index), motions, reactions);
            } else {
                action.put(-force, reactions);
            }
        }
    }

    /// Finds the forces of the transmissions and adds them to the forces on the nodes' links.
    /// The multiplier of a transmission's row gives the force of the transmission.
    /// The row contains only angles and slides, but the joint forces also depend on where this force acts.
    /// The force is therefore applied to the links as a known force.
    fn transmit<const SLIDING: bool>(
        &mut self,
        case: &Case,
        chain: &Chain,
        motions: &[Motion],
        reactions: &mut Reactions,
    ) {
        self.cut.copy_from_slice(&self.carried);
        gather::<SLIDING>(&self.inwards, &mut self.cut, chain);
        generalise::<SLIDING>(&mut self.multipliers, &self.cut, chain, motions);
        chain.multipliers(&mut self.multipliers);
        let first = 2 * chain.closings().len() + chain.given().len();
        for (train, multiplier) in chain.trains().iter().zip(&self.multipliers[first..]) {
            let force = train.force(*multiplier);
            reactions.transmitted[train.id] = force;
            let transmission = &case.mechanism.transmissions()[train.id];
            transmission.each_action(case.mechanism.joints(), force, motions, |link, own, place| {
                if let Some(node) = chain.nodes().iter().position(|node| node.link == link) {
                    let (total, moment) = &mut self.carried[node];
                    *total += own;
                    *moment += cross(place - chain.pole(node), own);
                }
            });
        }
    }
}

/// Adds the forces on every node's link to the forces on the link of the node's parent, from the outermost node
/// inwards.
fn gather<const SLIDING: bool>(inwards: &[Inwards], carried: &mut [(Vec2, f64)], chain: &Chain) {
    for link in inwards {
        let (force, moment) = carried[link.child];
        let (total, about) = &mut carried[link.parent];
        *total += force;
        let arm = chain.pole(link.child) - chain.pole(link.parent);
        *about += if SLIDING && link.is_guided { cross(arm, force) + moment } else { cross(arm, force) };
    }
}

/// Writes the generalised forces on the unknowns.
fn generalise<const SLIDING: bool>(
    generalised: &mut [f64],
    carried: &[(Vec2, f64)],
    chain: &Chain,
    motions: &[Motion],
) {
    for ((own, node), (force, moment)) in generalised.iter_mut().zip(chain.nodes()).zip(carried) {
        let axis = if SLIDING { node.axis(motions) } else { None };
        *own = axis.map_or(*moment, |axis| axis.dot(force) * chain.size());
    }
}
