//! Equilibrium of a link on a driven joint: the joint's reaction and the driving moment or force.

use super::body::{Action, Body, Reactions};
use linkage::case::Case;
use linkage::input::Input;
use linkage::math::{Motion, Vec2};
use linkage::mechanism::{JointId, LinkId};

/// A link and its driven joint.
#[derive(Clone, Debug)]
pub(super) struct Driving {
    body: Body,
    pivot: Action,
    /// Number of the drive.
    index: usize,
    input: Input,
    /// The axis of a prismatic joint, in the frame of the joint's first link.
    axis: (LinkId, Vec2),
}

impl Driving {
    /// The link `link` on the driven joint of the drive with the number `index`.
    pub(super) fn of(case: &Case, link: LinkId, joint: JointId, index: usize, settled: &[bool]) -> Self {
        let first = case.mechanism.joints()[joint].first.link;
        let axis = case.mechanism.joints()[joint].axis_on(first).unwrap_or_default();
        Driving {
            body: Body::of(case, link, settled),
            pivot: Action::of(case, joint, link),
            index,
            input: case.drives[index].input,
            axis: (first, axis),
        }
    }

    /// Stores the reaction and the driving moment or force for which the link is in equilibrium.
    /// The reaction includes the driving force, and at a joint between moving links the driving moment.
    #[inline]
    pub(super) fn solve(&self, case: &Case, motions: &[Motion], reactions: &mut Reactions) {
        let pole = self.pivot.place(motions);
        let (force, moment) = self.body.resultant(case, motions, reactions, pole);
        match self.input {
            Input::Angle => {
                self.pivot.put(-force, reactions);
                reactions.efforts[self.index] = -moment;
            }
            Input::Turn => {
                self.pivot.put(-force, reactions);
                self.pivot.put_moment(-moment, reactions);
                reactions.efforts[self.index] = -moment * self.pivot.sign();
            }
            Input::Slide => {
                let axis = motions[self.axis.0].arm(self.axis.1);
                self.pivot.put_guided(-force, moment, pole, motions, reactions);
                reactions.efforts[self.index] = -axis.dot(&force) * self.pivot.sign();
            }
        }
    }
}
