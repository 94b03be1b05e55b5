//! Dry friction in the joints.
//!
//! Friction acts against the sliding of a joint.
//! Its size is the coefficient of friction mu times the sum of the normal forces of the joint's contacts.
//! A journal of the radius r has one contact, with the force R of the joint: the moment is mu r |R|.
//! A guide of the length l carries the force N and the moment M by contacts at its two ends.
//! The contact forces are N/2 + M/l and N/2 - M/l; the sum of the absolute values is the larger of |N| and 2 |M| / l.
//! See docs/numerics/friction.md.
//! J. L. Meriam, L. G. Kraige, Engineering Mechanics: Statics, 7th ed., Wiley 2012, sections 6/3 and 6/6.
//! The radius of the friction circle is mu r here. The forces of the two contacts follow from equilibrium.

use super::{Case, STANDSTILL, fastest};
use crate::drive::{Action, Load, Wrench};
use crate::math::{KeepNan, Motion, Vec2};
use crate::mechanism::{Joint, JointId};

/// The friction of a joint.
#[derive(Clone, Copy, Debug)]
pub struct Friction<'a> {
    case: &'a Case,
    /// Index of the friction in the loads of the case.
    pub load: usize,
    /// The joint.
    pub joint: JointId,
    coefficient: f64,
    /// Radius of the journal, or length of the guide (m).
    length: f64,
}

impl Case {
    /// The joints with friction, in the order of the loads.
    pub fn frictions(&self) -> impl Iterator<Item = Friction<'_>> {
        self.loads.iter().enumerate().filter_map(|(load, own)| {
            let &Load::Friction { joint, links: _, coefficient, length } = own else { return None };
            Some(Friction { case: self, load, joint, coefficient, length })
        })
    }

    /// Whether any joint has friction.
    #[must_use]
    pub fn has_friction(&self) -> bool {
        self.loads.iter().any(Load::is_friction)
    }

    /// Rate of a joint's coordinate (rad/s or m/s).
    /// The result is zero if the rate may be only a rounding error of the mechanism's speeds.
    #[must_use]
    pub fn joint_rate(&self, motions: &[Motion], joint: JointId) -> f64 {
        let joint = &self.mechanism.joints()[joint];
        let (rate, unit) = (joint.rates(motions)[0], if joint.slides() { self.mechanism.size() } else { 1.0 });
        // A rate that is NaN counts as zero.
        if rate.abs() > STANDSTILL * fastest(motions) * unit { rate } else { 0.0 }
    }
}

impl Case {
    /// Adds the friction of all joints to the loads on all links.
    /// `efforts` is the friction on the second link of each joint (N m or N), in the order of [`Case::frictions`].
    pub fn add_friction(&self, efforts: &[f64], motions: &[Motion], out: &mut [Wrench]) {
        for (friction, &effort) in self.frictions().zip(efforts) {
            for action in friction.act(effort, motions) {
                out[action.link].add(&action, &motions[action.link], &self.mechanism.links()[action.link]);
            }
        }
    }
}

/// Reactions of all joints on the second links: forces (N), and moments about the joints' points on these links (N m).
#[derive(Clone, Copy, Debug)]
pub struct JointReactions<'a> {
    /// One force per joint.
    pub forces: &'a [Vec2],
    /// One moment per joint.
    pub moments: &'a [f64],
}

impl Friction<'_> {
    fn of_joint(&self) -> &Joint {
        &self.case.mechanism.joints()[self.joint]
    }

    /// Sum of the contacts' normal forces (N), which is a norm of the reaction.
    /// The reaction has a force (N), and a moment about the joint's point on the second link (N m).
    #[must_use]
    pub fn normal(&self, force: Vec2, moment: f64) -> f64 {
        match self.of_joint().slides() && self.length > 0.0 {
            true => force.norm().larger(2.0 * moment.abs() / self.length),
            false => force.norm(),
        }
    }

    /// Friction divided by [`normal`](Friction::normal): mu r in a revolute joint (m), mu in a prismatic joint (1).
    #[must_use]
    pub fn lever(&self) -> f64 {
        if self.of_joint().slides() { self.coefficient } else { self.coefficient * self.length }
    }

    /// Sliding speed of the contact divided by the rate of the joint's coordinate: the radius of a journal (m), 1 for a
    /// guide.
    #[must_use]
    pub fn contact(&self) -> f64 {
        if self.of_joint().slides() { 1.0 } else { self.length }
    }

    /// Length of the guide (m). It is zero for a revolute joint, and if the moment of the guide causes no friction.
    #[must_use]
    pub fn guide(&self) -> f64 {
        if self.of_joint().slides() { self.length } else { 0.0 }
    }

    /// [`Case::joint_rate`] of the joint.
    #[must_use]
    pub fn rate(&self, motions: &[Motion]) -> f64 {
        self.case.joint_rate(motions, self.joint)
    }

    /// Friction on the second link (N m or N) for these reactions, positive if it increases the joint's coordinate.
    /// The friction is zero at standstill.
    #[must_use]
    pub fn effort(&self, motions: &[Motion], reactions: JointReactions) -> f64 {
        let (rate, joint) = (self.rate(motions), self.joint.index());
        let normal = self.normal(reactions.forces[joint], reactions.moments[joint]);
        if rate == 0.0 { 0.0 } else { -rate.signum() * self.lever() * normal }
    }

    /// Actions of the friction on the joint's first link, then on its second link.
    /// `effort` is the friction on the second link (N m or N), positive if it increases the joint's coordinate.
    #[must_use]
    pub fn act(&self, effort: f64, motions: &[Motion]) -> [Action; 2] {
        Action::pair(self.of_joint(), effort, motions)
    }
}
