//! Joint reactions of the RRR dyad.
//!
//! F and M are the known force on a link and its moment about the inner joint.
//! The vectors r1 and r2 go from the outer joints to the inner joint; R is the force at the first outer joint.
//! Then r1 x R = M_1 and r2 x (R + F_1 + F_2) = -M_2.
//! These equations are derived here from the equilibrium of moments about the inner joint.
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.

use super::body::{Action, Body, Reactions, Settled};
use crate::assur::groups::Rrr;
use linkage::case::Case;
use linkage::math::{Motion, cross};
use linkage::mechanism::{Group, GroupId};

/// Force analysis of an RRR dyad.
#[derive(Clone, Debug)]
pub(super) struct Pinned {
    /// Index of the group in the plan.
    pub(super) step: GroupId,
    bodies: [Body; 2],
    outer: [Action; 2],
    inner: Action,
}

impl Pinned {
    pub(super) fn of(case: &Case, step: GroupId, group: &Group, settled: &Settled) -> Self {
        Pinned {
            step,
            bodies: [0, 1].map(|k| Body::of(case, group.links[k], settled)),
            outer: [0, 1].map(|k| Action::of(case, group.outer[k], group.links[k])),
            inner: Action::of(case, group.inner[0], group.links[0]),
        }
    }

    #[inline]
    pub(super) fn solve(&self, case: &Case, dyad: &Rrr, motions: &[Motion], reactions: &mut Reactions) {
        let pole = dyad.inner();
        let ([r1, r2], inverse) = dyad.spans();
        let (force_a, moment_a) = self.bodies[0].resultant(case, motions, reactions, pole);
        let (force_b, moment_b) = self.bodies[1].resultant(case, motions, reactions, pole);
        let total = force_a + force_b;
        let reaction = (r1 * (moment_b + cross(r2, total)) - r2 * -moment_a) * inverse;
        self.outer[0].put(reaction, reactions);
        self.outer[1].put(-(reaction + total), reactions);
        self.inner.put(-(reaction + force_a), reactions);
    }
}
