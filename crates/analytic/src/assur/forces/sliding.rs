//! Joint reactions of the four dyads with prismatic joints.
//!
//! A revolute joint transmits a force. A prismatic joint transmits a moment, and a force across its axis.
//! F_a and M_a are the known force and moment on link a, F_b and M_b on link b; F = F_a + F_b and M = M_a + M_b.
//! The vector u goes from the inner joint to the outer joint of link a, the vector d from the outer joint of link a to
//! the outer joint of link b.
//! The axes of the prismatic joints are e and b (b is unrelated to link b).
//! R is the force on link a at its outer joint, except for RPR.
//! RRP: u x R = -M_a about the inner joint, e . (R + F) = 0 for the whole dyad.
//! RPR, with R on link b (the second link of the prismatic joint) at its outer joint: e . (R + F_b) = 0 for link b, and
//! d x R = -M about the outer joint of link a for the whole dyad.
//! RPP: b . (R + F_a) = 0 for the pinned link, e . (R + F) = 0 for the whole dyad.
//! PRP: the inner force I on link a satisfies e . (I + F_a) = 0 and b . (I - F_b) = 0.
//! The moments of the guides follow from the moments on their links.
//! These equations are derived here from the equilibrium of the links and of the whole dyad.
//! Background: I. I. Artobolevsky, Theory of Mechanisms and Machines, 4th ed., Nauka 1988.

use super::body::{Action, Body, Reactions, Settled};
use linkage::case::Case;
use linkage::math::{Motion, Vec2, cross, turned};
use linkage::mechanism::{Group, GroupKind, JointId, LinkId};

/// Force analysis of a dyad with prismatic joints. The links of the dyad have the same order as in the formulas.
#[derive(Clone, Debug)]
pub(super) struct Sliding {
    kind: GroupKind,
    bodies: [Body; 2],
    outer: [Action; 2],
    inner: [Action; 2],
    /// Axis of a prismatic joint: the guide for RRP and RPP, the inner joint for RPR, the first guide for PRP.
    /// The pair contains a link, and the axis in the frame of this link.
    axis: (LinkId, Vec2),
    /// Axis of PRP's second guide, or of RPP's inner pair.
    other: (LinkId, Vec2),
}

impl Sliding {
    pub(super) fn of(case: &Case, group: &Group, settled: &Settled) -> Self {
        let joints = case.mechanism.joints();
        let inner = &joints[group.inner[0]];
        let mut order = [0, 1];
        let swapped = match group.kind {
            GroupKind::Rrp | GroupKind::Rpp => joints[group.outer[0]].slides(),
            GroupKind::Rpr => inner.first.link == group.links[1],
            GroupKind::Rrr | GroupKind::Prp | GroupKind::Higher | GroupKind::Driven => false,
        };
        if swapped {
            order = [1, 0];
        }
        let links = order.map(|k| group.links[k]);
        let outer = order.map(|k| group.outer[k]);
        // The first link of a joint, and the axis in its frame.
        let axis = |joint: JointId| {
            let link = joints[joint].first.link;
            (link, joints[joint].axis_on(link).unwrap_or_else(Vec2::zeros))
        };
        let (axis, other) = match group.kind {
            GroupKind::Rrp | GroupKind::Rpp => (axis(outer[1]), axis(group.inner[0])),
            GroupKind::Prp => (axis(outer[0]), axis(outer[1])),
            GroupKind::Rrr | GroupKind::Rpr | GroupKind::Higher | GroupKind::Driven => {
                (axis(group.inner[0]), axis(group.inner[0]))
            }
        };
        Sliding {
            kind: group.kind,
            bodies: links.map(|link| Body::of(case, link, settled)),
            outer: [0, 1].map(|k| Action::of(case, outer[k], links[k])),
            inner: links.map(|link| Action::of(case, group.inner[0], link)),
            axis,
            other,
        }
    }

    #[inline]
    pub(super) fn solve(&self, case: &Case, motions: &[Motion], reactions: &mut Reactions) {
        match self.kind {
            GroupKind::Rrp => self.rrp(case, motions, reactions),
            GroupKind::Rpr => self.rpr(case, motions, reactions),
            GroupKind::Rpp => self.rpp(case, motions, reactions),
            GroupKind::Prp => self.prp(case, motions, reactions),
            GroupKind::Rrr | GroupKind::Higher | GroupKind::Driven => unreachable!("the dyad slides"),
        }
    }

    /// Returns the known forces and moments about `pole` on both links.
    #[inline]
    fn known(&self, case: &Case, motions: &[Motion], reactions: &Reactions, pole: Vec2) -> ([Vec2; 2], [f64; 2]) {
        let (force_a, moment_a) = self.bodies[0].resultant(case, motions, reactions, pole);
        let (force_b, moment_b) = self.bodies[1].resultant(case, motions, reactions, pole);
        ([force_a, force_b], [moment_a, moment_b])
    }

    fn axes(&self, motions: &[Motion]) -> [Vec2; 2] {
        [self.axis, self.other].map(|(link, axis)| motions[link].arm(axis))
    }

    fn rrp(&self, case: &Case, motions: &[Motion], reactions: &mut Reactions) {
        let pole = self.inner[0].place(motions);
        let u = self.outer[0].place(motions) - pole;
        let [axis, _] = self.axes(motions);
        let ([force_a, force_b], [moment_a, moment_b]) = self.known(case, motions, reactions, pole);
        let total = force_a + force_b;
        let along = -axis.dot(&total);
        let across = (-moment_a - along * cross(u, axis)) / axis.dot(&u);
        let reaction = axis * along + turned(axis) * across;
        self.outer[0].put(reaction, reactions);
        self.inner[0].put(-(reaction + force_a), reactions);
        self.outer[1].put_guided(-(reaction + total), moment_b, pole, motions, reactions);
    }

    fn rpr(&self, case: &Case, motions: &[Motion], reactions: &mut Reactions) {
        let pole = self.outer[0].place(motions);
        let d = self.outer[1].place(motions) - pole;
        let [axis, _] = self.axes(motions);
        let ([force_a, force_b], [moment_a, moment_b]) = self.known(case, motions, reactions, pole);
        let along = -axis.dot(&force_b);
        let across = (-moment_a - moment_b - along * cross(d, axis)) / axis.dot(&d);
        let reaction = axis * along + turned(axis) * across;
        self.outer[1].put(reaction, reactions);
        self.outer[0].put(-(reaction + force_a + force_b), reactions);
        let moment = moment_b + cross(d, reaction);
        self.inner[1].put_guided(-(reaction + force_b), moment, pole, motions, reactions);
    }

    fn rpp(&self, case: &Case, motions: &[Motion], reactions: &mut Reactions) {
        let pole = self.outer[0].place(motions);
        let [axis, inner] = self.axes(motions);
        let ([force_a, force_b], [moment_a, moment_b]) = self.known(case, motions, reactions, pole);
        let total = force_a + force_b;
        let reaction = with_components([axis, inner], [-axis.dot(&total), -inner.dot(&force_a)]);
        self.outer[0].put(reaction, reactions);
        self.inner[0].put_guided(-(reaction + force_a), moment_a, pole, motions, reactions);
        self.outer[1].put_guided(-(reaction + total), moment_a + moment_b, pole, motions, reactions);
    }

    fn prp(&self, case: &Case, motions: &[Motion], reactions: &mut Reactions) {
        let pole = self.inner[0].place(motions);
        let [axis, other] = self.axes(motions);
        let ([force_a, force_b], [moment_a, moment_b]) = self.known(case, motions, reactions, pole);
        let inner = with_components([axis, other], [-axis.dot(&force_a), other.dot(&force_b)]);
        self.inner[0].put(inner, reactions);
        self.outer[0].put_guided(-(inner + force_a), moment_a, pole, motions, reactions);
        self.outer[1].put_guided(inner - force_b, moment_b, pole, motions, reactions);
    }
}

/// Returns the vector R with the given products e . R and b . R.
fn with_components([e, b]: [Vec2; 2], [along_e, along_b]: [f64; 2]) -> Vec2 {
    (turned(e) * along_b - turned(b) * along_e) / cross(e, b)
}
