//! Equilibrium of a link on a driven joint: the joint's reaction and the driving moment or force.

use super::body::{Action, Body, Reactions, Settled};
use linkage::case::Case;
use linkage::input::Input;
use linkage::math::{Motion, Vec2, cross};
use linkage::mechanism::{JointId, LinkId};

/// A link and its driven joint.
#[derive(Clone, Debug)]
pub(super) struct Driving {
    body: Body,
    joint: DrivenPivot,
}

/// The driven joint of a link.
#[derive(Clone, Debug)]
pub(super) struct DrivenPivot {
    pivot: Action,
    /// Number of the drive.
    index: usize,
    input: Input,
    /// The axis of a prismatic joint, in the frame of the joint's first link.
    axis: (LinkId, Vec2),
}

impl Driving {
    /// The link `link`, which the drive with the number `index` moves by the joint `joint`.
    pub(super) fn of(case: &Case, link: LinkId, joint: JointId, index: usize, settled: &Settled) -> Self {
        Driving { body: Body::of(case, link, settled), joint: DrivenPivot::of(case, link, joint, index) }
    }

    /// Stores the reaction and the driving moment or force for which the link is in equilibrium.
    #[inline]
    pub(super) fn solve(&self, case: &Case, motions: &[Motion], reactions: &mut Reactions) {
        let pole = self.joint.pivot.place(motions);
        let (force, moment) = self.body.resultant(case, motions, reactions, pole);
        // A crank is the usual case, and its pivot is the pole: the general lever arms and signs are not needed.
        if self.joint.input == Input::Angle {
            self.joint.pivot.put(-force, reactions);
            reactions.efforts[self.joint.index] = -moment;
        } else {
            self.joint.balance(force, moment, pole, motions, reactions);
        }
    }
}

impl DrivenPivot {
    /// The driven joint by which the drive with the number `index` moves `link`.
    pub(super) fn of(case: &Case, link: LinkId, joint: JointId, index: usize) -> Self {
        let first = case.mechanism.joints()[joint].first.link;
        let axis = case.mechanism.joints()[joint].axis_on(first).unwrap_or_default();
        DrivenPivot {
            pivot: Action::of(case, joint, link),
            index,
            input: case.drives[index].input,
            axis: (first, axis),
        }
    }

    /// Stores the reaction and the driving moment or force that balance a force on the link (N) and its moment about
    /// the world point `pole` (N m).
    /// The reaction includes the driving force, and at a joint between moving links the driving moment.
    #[inline]
    pub(super) fn balance(&self, force: Vec2, moment: f64, pole: Vec2, motions: &[Motion], reactions: &mut Reactions) {
        if self.input == Input::Slide {
            let axis = motions[self.axis.0].arm(self.axis.1);
            self.pivot.put_guided(-force, moment, pole, motions, reactions);
            reactions.efforts[self.index] = -axis.dot(&force) * self.pivot.sign();
            return;
        }
        let moment = moment + cross(pole - self.pivot.place(motions), force);
        self.pivot.put(-force, reactions);
        reactions.efforts[self.index] = -moment;
        if self.input == Input::Turn {
            self.pivot.put_moment(-moment, reactions);
            reactions.efforts[self.index] *= self.pivot.sign();
        }
    }
}
