//! Input and output of loads: the state on which a load depends, and the action of a load on its links.

use crate::math::{Motion, Vec2, angle, cross};
use crate::mechanism::{Joint, Link, LinkId, LinkPose, PerJoint};

/// The state on which loads depend. Slices have one entry per link.
#[derive(Clone, Copy, Debug)]
pub struct LoadState<'a> {
    /// Motions of all links. Accelerations only determine the sense of a motion that begins from rest.
    pub motions: &'a [Motion],
    /// Angles of all links (rad), unwrapped. Only torsion springs use the angles.
    pub angles: &'a [f64],
    /// All joints.
    /// Only loads that act on joints use this list.
    pub joints: &'a PerJoint<Joint>,
    /// Poses at t = 0.
    pub start: &'a [LinkPose],
    /// Crank angle (rad, in the scenario's convention). Only tables use the crank angle.
    pub crank: f64,
}

impl LoadState<'_> {
    /// Twist between two links (rad): see [`Load::TorsionSpring`](super::Load::TorsionSpring).
    #[must_use]
    pub fn twist(&self, [first, second]: [LinkId; 2]) -> f64 {
        let begun = self.start[second].angle - self.start[first].angle;
        self.angles[second] - self.angles[first] - begun + angle::wrapped(begun)
    }
}

/// Action of a load on one link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Action {
    /// The link.
    pub link: LinkId,
    /// Force (N, world axes).
    pub force: Vec2,
    /// World coordinates of the point at which the force acts (m).
    pub place: Vec2,
    /// Moment in addition to the moment of the force (N m), counter-clockwise positive.
    pub moment: f64,
}

impl Action {
    /// Returns the action of a pure moment (N m, counter-clockwise positive).
    #[must_use]
    pub fn of_moment(link: LinkId, moment: f64) -> Self {
        Action { link, force: Vec2::zeros(), place: Vec2::zeros(), moment }
    }

    /// Actions of a joint's moment or force on the joint's first and second link.
    /// `effort` acts on the second link: a moment (N m) in a revolute joint, or a force (N) along the axis of a
    /// prismatic joint.
    #[must_use]
    pub fn pair(joint: &Joint, effort: f64, motions: &[Motion]) -> [Action; 2] {
        let ends = [(joint.first.link, -effort), (joint.second.link, effort)];
        let Some(axis) = joint.axis_on(joint.first.link) else {
            return ends.map(|(link, moment)| Action::of_moment(link, moment));
        };
        let (axis, place) = (motions[joint.first.link].arm(axis), motions[joint.second.link].point(joint.second.local));
        ends.map(|(link, force)| Action { link, force: axis * force, place, moment: 0.0 })
    }

    /// Moment of the action's force about a world point, plus the action's moment (N m). Counter-clockwise positive.
    #[inline]
    #[must_use]
    pub fn about(&self, pole: Vec2) -> f64 {
        cross(self.place - pole, self.force) + self.moment
    }

    /// Power of the action on a link with this motion (W).
    #[inline]
    #[must_use]
    pub fn power(&self, motion: &Motion) -> f64 {
        self.force.dot(&motion.velocity_at(self.place)) + self.moment * motion.omega
    }
}

/// Resultant of all loads on a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force (N, world axes) at the link's mass centre.
    pub force: Vec2,
    /// Moment about the mass centre (N m), counter-clockwise positive.
    pub moment: f64,
}

impl Wrench {
    /// No load.
    pub const ZERO: Wrench = Wrench { force: Vec2::new(0.0, 0.0), moment: 0.0 };

    /// Adds an action on the link with this motion.
    #[inline]
    pub fn add(&mut self, action: &Action, motion: &Motion, link: &Link) {
        self.force += action.force;
        self.moment += action.about(motion.point(link.mass_centre));
    }
}
