//! Joint reactions of an RRR dyad whose two bodies change their shape. Such a body consists, for example, of cylinder
//! and rod.
//! The links of a body are connected by given joints, whose coordinates are functions of time.
//!
//! The two bodies are in equilibrium like the links of an RRR dyad: see [`super::rrr`].
//! The forces on the links of a body are then computed one by one, beginning with the link farthest from the root.
//! Each link is in equilibrium under its loads and the reaction of its given joint.
//! All moments are about the inner joint, at which the force of the other body acts.

use super::body::{Action, Body, Reactions, Settled};
use super::driving::DrivenPivot;
use crate::assur::groups::Shaped;
use linkage::case::Case;
use linkage::math::{Motion, Vec2, cross};
use linkage::mechanism::{Group, GroupId, JointId, LinkId};

/// A link of a body.
#[derive(Clone, Debug)]
struct Member {
    body: Body,
    /// Number of the link's parent in the body, and the given joint to it; `None` for the root.
    parent: Option<(usize, DrivenPivot)>,
    /// Known force on the link and on the links that it carries (N), and the moment of this force about the inner joint
    /// (N m).
    carried: (Vec2, f64),
}

/// Force analysis of an RRR dyad whose bodies change their shape.
#[derive(Clone, Debug)]
pub(super) struct Formed {
    /// Index of the group in the plan.
    pub(super) step: GroupId,
    /// The links of each body, parents before children, and the number of the link with the inner joint.
    bodies: [(Vec<Member>, usize); 2],
    outer: [Action; 2],
    /// Action of the inner joint on its link of the first body.
    inner: Action,
}

impl Formed {
    pub(super) fn of(case: &Case, step: GroupId, group: &Group, dyad: &Shaped, settled: &Settled) -> Self {
        let is_free = |joint: &&JointId| !group.given.contains(joint);
        let inner = *group.inner.iter().find(is_free).expect("a dyad has an inner joint");
        let joint = &case.mechanism.joints()[inner];
        let shapes = dyad.shapes();
        let links = |k: usize| -> Vec<LinkId> {
            std::iter::once(shapes[k].root).chain(shapes[k].hung.iter().map(|own| own.link)).collect()
        };
        let bodies = [0, 1].map(|k: usize| {
            let all = links(k);
            let number = |link: LinkId| all.iter().position(|&own| own == link).expect("the link is in the body");
            let members = all.iter().enumerate().map(|(at, &link)| {
                let parent = at.checked_sub(1).map(|at| {
                    let drive = shapes[k].hung[at].index;
                    let joint = case.drives[drive].joint;
                    let parent = number(case.mechanism.joints()[joint].other(link).link);
                    (parent, DrivenPivot::of(case, link, joint, drive))
                });
                Member { body: Body::of(case, link, settled), parent, carried: (Vec2::zeros(), 0.0) }
            });
            let ends = all.iter().position(|&link| joint.on(link).is_some());
            (members.collect(), ends.expect("the inner joint is on both bodies"))
        });
        let at = bodies[0].1;
        Formed {
            step,
            outer: [0, 1].map(|k| Action::of(case, group.outer[k], shapes[k].root)),
            inner: Action::of(case, inner, links(0)[at]),
            bodies,
        }
    }

    #[inline]
    pub(super) fn solve(&mut self, case: &Case, dyad: &Shaped, motions: &[Motion], reactions: &mut Reactions) {
        let pole = dyad.dyad().inner();
        let ([r1, r2], inverse) = dyad.dyad().spans();
        let known = self.bodies.each_mut().map(|(members, _)| {
            let mut sum = (Vec2::zeros(), 0.0);
            for member in members {
                member.carried = member.body.resultant(case, motions, reactions, pole);
                sum = (sum.0 + member.carried.0, sum.1 + member.carried.1);
            }
            sum
        });
        let [(force_a, moment_a), (force_b, moment_b)] = known;
        let total = force_a + force_b;
        let reaction = (r1 * (moment_b + cross(r2, total)) - r2 * -moment_a) * inverse;
        self.outer[0].put(reaction, reactions);
        self.outer[1].put(-(reaction + total), reactions);
        let inner = -(reaction + force_a);
        self.inner.put(inner, reactions);
        for ((members, end), force) in self.bodies.iter_mut().zip([inner, -inner]) {
            members[*end].carried.0 += force;
            for at in (1..members.len()).rev() {
                let (before, rest) = members.split_at_mut(at);
                let (force, moment) = rest[0].carried;
                let Some((parent, joint)) = &rest[0].parent else { continue };
                joint.balance(force, moment, pole, motions, reactions);
                let carried = &mut before[*parent].carried;
                *carried = (carried.0 + force, carried.1 + moment);
            }
        }
    }
}
