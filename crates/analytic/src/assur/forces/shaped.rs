//! Joint reactions of the RRR dyad of bodies with given joints.
//!
//! The two bodies are in equilibrium like the links of an RRR dyad: see [`super::rrr`].
//! The links of a body then follow one by one, from the link farthest from the root: each is in equilibrium with its
//! given joint.

use super::body::{Action, Body, Reactions};
use super::driving::Driving;
use crate::assur::groups::Shaped;
use linkage::case::Case;
use linkage::math::{Motion, Vec2, cross};
use linkage::mechanism::{Group, GroupId, JointId};

/// Force analysis of an RRR dyad of bodies with given joints.
#[derive(Clone, Debug)]
pub(super) struct Formed {
    /// Index of the group in the plan.
    pub(super) step: GroupId,
    /// The links of each body, with the forces of later groups.
    bodies: [Vec<Body>; 2],
    outer: [Action; 2],
    /// The inner joint on the link of the first body.
    inner: Action,
    /// The links on given joints, from the farthest link to the root.
    hung: Vec<Driving>,
}

impl Formed {
    pub(super) fn of(case: &Case, step: GroupId, group: &Group, dyad: &Shaped, settled: &[bool]) -> Self {
        let shapes = dyad.shapes();
        let bodies = shapes.each_ref().map(|shape| {
            let links = std::iter::once(shape.root).chain(shape.hung.iter().map(|own| own.link));
            links.map(|link| Body::of(case, link, settled)).collect()
        });
        let inner: JointId =
            *group.inner.iter().find(|joint| !group.given.contains(joint)).expect("a dyad has an inner joint");
        let joint = &case.mechanism.joints()[inner];
        let first = &shapes[0];
        let mut links = std::iter::once(first.root).chain(first.hung.iter().map(|own| own.link));
        let link = links.find(|&link| joint.on(link).is_some()).expect("the inner joint is on both bodies");
        let mut settled = settled.to_vec();
        settled[inner] = true;
        let mut hung = Vec::new();
        for own in shapes.iter().flat_map(|shape| shape.hung.iter().rev()) {
            let joint = case.drives[own.index].joint;
            hung.push(Driving::of(case, own.link, joint, own.index, &settled));
            settled[joint] = true;
        }
        Formed {
            step,
            bodies,
            outer: [0, 1].map(|k| Action::of(case, group.outer[k], shapes[k].root)),
            inner: Action::of(case, inner, link),
            hung,
        }
    }

    #[inline]
    pub(super) fn solve(&self, case: &Case, dyad: &Shaped, motions: &[Motion], reactions: &mut Reactions) {
        let pole = dyad.dyad().inner();
        let ([r1, r2], inverse) = dyad.dyad().spans();
        let [(force_a, moment_a), (force_b, moment_b)] = self.bodies.each_ref().map(|bodies| {
            bodies.iter().fold((Vec2::zeros(), 0.0), |(force, moment), body| {
                let (own, about) = body.resultant(case, motions, reactions, pole);
                (force + own, moment + about)
            })
        });
        let total = force_a + force_b;
        let reaction = (r1 * (moment_b + cross(r2, total)) - r2 * -moment_a) * inverse;
        self.outer[0].put(reaction, reactions);
        self.outer[1].put(-(reaction + total), reactions);
        self.inner.put(-(reaction + force_a), reactions);
        self.hung.iter().for_each(|own| own.solve(case, motions, reactions));
    }
}
