//! Converts a group with given joints to a group of rigid bodies. A pose determines the shape of each body.
//! A given joint has a known coordinate, so its two links belong to one body.

use crate::math::{rotated, unit};
use crate::mechanism::assembly::{Configuration, StartGroup};
use crate::mechanism::{Group, JointId, JointKind, JointSide, LinkId, LinkPose, Mechanism, Pose};

/// A group whose bodies are rigid.
/// One link of each body, its lead, represents the body. Joints on other links of the body are moved to the lead.
pub(super) struct Fused {
    pub(super) mechanism: Mechanism,
    pub(super) group: Group,
    /// Each link of the group, with the lead of its body and with the link's pose in the frame of the lead.
    members: Vec<(LinkId, LinkId, LinkPose)>,
}

impl Fused {
    /// Fuses the bodies of `group`. In `pose`, the links of each body must have the correct relative pose.
    pub(super) fn of(mechanism: &Mechanism, group: &Group, pose: &Pose) -> Self {
        let members: Vec<(LinkId, LinkId, LinkPose)> = group
            .links
            .iter()
            .zip(group.leads(mechanism))
            .map(|(&link, lead)| (link, lead, relative(&pose.0[lead], &pose.0[link])))
            .collect();
        let is_free = |joint: &JointId| !group.given.contains(joint);
        let mut fused = Fused {
            mechanism: mechanism.clone(),
            group: Group {
                links: members.iter().filter(|(link, lead, _)| link == lead).map(|member| member.0).collect(),
                inner: group.inner.iter().copied().filter(is_free).collect(),
                outer: group.outer.iter().copied().filter(is_free).collect(),
                given: Vec::new(),
                ..group.clone()
            },
            members,
        };
        let mut joints = mechanism.joints().to_vec();
        for &index in group.inner.iter().chain(&group.outer) {
            let joint = &mut joints[index.index()];
            let turns =
                [joint.first.link, joint.second.link].map(|link| fused.member(link).map_or(0.0, |own| own.2.angle));
            if let JointKind::Prismatic { axes } = &mut joint.kind {
                for (axis, turn) in axes.iter_mut().zip(turns) {
                    *axis = rotated(unit(turn), *axis);
                }
            }
            (joint.first, joint.second) = (fused.side(joint.first), fused.side(joint.second));
        }
        fused.mechanism = Mechanism::unchecked(mechanism.links().to_vec(), joints);
        fused
    }

    fn member(&self, link: LinkId) -> Option<&(LinkId, LinkId, LinkPose)> {
        self.members.iter().find(|member| member.0 == link)
    }

    /// A point of a link as a point of the link's body.
    fn side(&self, side: JointSide) -> JointSide {
        self.member(side.link).map_or(side, |&(_, link, pose)| JointSide { link, local: pose.point(side.local) })
    }

    /// The requested start of the group. Each point with an approximate position becomes a point of a lead.
    pub(super) fn wanted(&self, wanted: &StartGroup) -> StartGroup {
        let mut own = wanted.clone();
        own.near.iter_mut().for_each(|(point, _)| point.side = self.side(point.side));
        own
    }

    /// Poses of all links of the group, given the poses of the leads in the order of the fused group.
    pub(super) fn expanded(&self, leads: &[LinkPose]) -> Vec<LinkPose> {
        let lead = |link: LinkId| leads[self.group.links.iter().position(|&own| own == link).expect("leads are links")];
        self.members.iter().map(|(_, own, pose)| composed(&lead(*own), pose)).collect()
    }

    /// A configuration with the poses of all links of the group.
    pub(super) fn configuration(&self, of_leads: Configuration) -> Configuration {
        Configuration { links: self.expanded(&of_leads.links), ..of_leads }
    }
}

/// The pose `own` in the frame of the pose `base`.
fn relative(base: &LinkPose, own: &LinkPose) -> LinkPose {
    LinkPose { origin: rotated(unit(-base.angle), own.origin - base.origin), angle: own.angle - base.angle }
}

/// The world pose of a link with the pose `own` in the frame of `base`.
fn composed(base: &LinkPose, own: &LinkPose) -> LinkPose {
    LinkPose { origin: base.point(own.origin), angle: base.angle + own.angle }
}
