//! Joints whose coordinate is given, and the links that they move.

use crate::input::Input;
use crate::mechanism::{JointId, LinkId};

/// A joint whose coordinate is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrivenJoint {
    /// The joint.
    pub joint: JointId,
    /// What the joint's coordinate measures.
    pub input: Input,
}

impl From<JointId> for DrivenJoint {
    /// A driven joint whose coordinate is a crank angle.
    fn from(joint: JointId) -> Self {
        DrivenJoint { joint, input: Input::Angle }
    }
}

impl From<&DrivingLink> for DrivenJoint {
    fn from(driver: &DrivingLink) -> Self {
        DrivenJoint { joint: driver.joint, input: driver.input }
    }
}

/// A link that a drive moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrivingLink {
    /// The link. For a joint between two links of a group, the driving link is the joint's second link.
    pub link: LinkId,
    /// The driven joint.
    pub joint: JointId,
    /// What the joint's coordinate measures.
    pub input: Input,
    /// Whether the link belongs to a group. If not, the link stands on the ground or on an earlier driving link.
    pub in_group: bool,
}
