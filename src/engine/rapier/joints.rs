//! Joints in Rapier's terms, for the tree and for the loops.

use rapier2d_f64::prelude::{GenericJoint, GenericJointBuilder, JointAxesMask, SpringCoefficients, Vector};

use super::tree::Branch;
use crate::math::{Vec2, rotated, unit};
use crate::mechanism::{Joint, Pose};

/// Joint frequency (Hz): rigid to rounding. The default, 1e6 Hz, adds 6 % to the closure gap at a step of 1e-5 s.
const JOINT_FREQUENCY: f64 = 1e12;

/// Rapier's vector.
pub(super) fn vector(of: Vec2) -> Vector {
    Vector::new(of.x, of.y)
}

/// A joint between the joint's places on `links` that holds the axes given.
pub(super) fn holding(axes: JointAxesMask, joint: &Joint, links: [usize; 2]) -> GenericJointBuilder {
    let [first, second] = links.map(|link| vector(joint.on(link).expect("the joint is on the link")));
    GenericJointBuilder::new(axes)
        .local_anchor1(first)
        .local_anchor2(second)
        .contacts_enabled(false)
        .softness(SpringCoefficients::new(JOINT_FREQUENCY, 1.0))
}

/// The joint between `links`, which Rapier calls first and second. Of a prismatic one, the x axis of either joint frame lies
/// along the axis.
pub(super) fn between(joint: &Joint, links: [usize; 2]) -> GenericJoint {
    match links.map(|link| joint.axis_on(link)) {
        [Some(first), Some(second)] => holding(JointAxesMask::LOCKED_PRISMATIC_AXES, joint, links)
            .local_axis1(vector(first))
            .local_axis2(vector(second))
            .build(),
        _ => holding(JointAxesMask::LOCKED_REVOLUTE_AXES, joint, links).build(),
    }
}

/// Coordinate of a branch's joint in a pose: angle of the child in its parent (rad), or way along the parent's axis from the place
/// on the parent to that on the child (m), whichever of the two is the joint's first link.
pub(super) fn coordinate(joint: &Joint, branch: &Branch, pose: &Pose) -> f64 {
    let [parent, child] = [branch.parent, branch.link].map(|link| pose.0[link]);
    match (joint.axis_on(branch.parent), joint.on(branch.parent), joint.on(branch.link)) {
        (Some(axis), Some(on_parent), Some(on_child)) => {
            rotated(unit(parent.angle), axis).dot(&(child.point(on_child) - parent.point(on_parent)))
        }
        _ => child.angle - parent.angle,
    }
}
