//! Position of a body in its parent, and the coordinate of its joint.

use linkage::case::Case;
use linkage::math::{Vec2, rotated, unit};
use linkage::mechanism::{Branch, JointKind};
use linkage::solver::State;

/// The one degree of freedom of a body in its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Freedom {
    /// Hinge about z at a point of the body's frame (m).
    Hinge(Vec2),
    /// Slide along a unit vector of the body's frame.
    Slide(Vec2),
}

/// A link as a body in its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Body {
    /// Origin of the link's frame in that of its parent, in the start pose (m).
    pub offset: Vec2,
    /// Angle of the link minus that of its parent in the start pose (rad).
    pub turn: f64,
    /// The joint.
    pub freedom: Freedom,
    /// The joint's coordinate in the start pose: angle of the link minus that of its parent (rad), or slide (m).
    pub coordinate: f64,
    /// Its rate at the start (rad/s, m/s).
    pub rate: f64,
}

/// The body of a branch. Poses are those of the case at t = 0, rates those of `start`.
pub(super) fn body(case: &Case, start: &State, branch: &Branch) -> Body {
    let joint = &case.mechanism.joints()[branch.joint];
    let [parent, child] = [branch.parent, branch.link].map(|link| case.start.0[link]);
    let offset = rotated(unit(-parent.angle), child.origin - parent.origin);
    let turn = child.angle - parent.angle;
    let (freedom, coordinate, rate) = match joint.kind {
        JointKind::Revolute => {
            let place = joint.on(branch.link).expect("a branch's joint is on its link");
            let rate = start.motions[branch.link].omega - start.motions[branch.parent].omega;
            (Freedom::Hinge(place), turn, rate)
        }
        JointKind::Prismatic { .. } => {
            let axis = joint.axis_on(branch.link).expect("a branch's joint is on its link");
            // A slide is measured from the first link to the second.
            let sense = if branch.link == joint.second.link { 1.0 } else { -1.0 };
            let of = |state: &State| state.slide(joint).expect("the joint slides");
            (Freedom::Slide(axis * sense), of(&State::at_start(case))[0], of(start)[1])
        }
    };
    Body { offset, turn, freedom, coordinate, rate }
}
