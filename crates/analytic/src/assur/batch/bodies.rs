//! Constants of individual links and joints of a case.

use super::poses::Layout;
use linkage::case::Case;
use linkage::drive::Load;
use linkage::math::Vec2;
use linkage::mechanism::{JointId, JointSide, LinkId};

/// Action of a joint on one of its links: `sign` times the joint's reaction, applied at `place` in the link's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Action {
    /// Column of the reaction.
    pub(super) force: usize,
    pub(super) place: Vec2,
    pub(super) sign: f64,
}

/// A link with the actions on it.
#[derive(Clone, Debug)]
pub(super) struct Body {
    /// First column of the link.
    pub(super) link: usize,
    pub(super) mass: f64,
    pub(super) mass_centre: Vec2,
    pub(super) inertia: f64,
    /// Actions of the joints at which later groups are attached to the link.
    pub(super) hanging: Vec<Action>,
    /// Sum of the moments of resistance on the link (N m).
    pub(super) resistance: Option<f64>,
}

/// Reads the constants from a case.
pub(super) struct Reader<'a> {
    pub(super) case: &'a Case,
    pub(super) layout: Layout,
    /// For every joint: whether its reaction is known before the current group is solved.
    pub(super) settled: &'a [bool],
}

impl Reader<'_> {
    pub(super) fn place(&self, joint: JointId, link: LinkId) -> Vec2 {
        self.case.mechanism.joints()[joint].on(link).expect("the joint is on the link")
    }

    pub(super) fn base(&self, joint: JointId, link: LinkId) -> (Option<usize>, Vec2) {
        let JointSide { link, local } = self.case.mechanism.joints()[joint].other(link);
        (self.layout.link(link), local)
    }

    pub(super) fn action(&self, joint: JointId, link: LinkId) -> Action {
        let is_second = self.case.mechanism.joints()[joint].second.link == link;
        Action {
            force: self.layout.force(joint),
            place: self.place(joint, link),
            sign: if is_second { 1.0 } else { -1.0 },
        }
    }

    pub(super) fn body(&self, link: LinkId) -> Body {
        let joints = self.case.mechanism.joints();
        let hanging = joints.ids().filter(|&joint| self.settled[joint] && joints[joint].on(link).is_some());
        let body = &self.case.mechanism.links()[link];
        let resistances = self.case.loads.iter().filter_map(Load::resistance).filter(|(loaded, _)| *loaded == link);
        Body {
            link: self.layout.link(link).expect("the link moves"),
            mass: body.mass,
            mass_centre: body.mass_centre,
            inertia: body.inertia,
            hanging: hanging.map(|joint| self.action(joint, link)).collect(),
            resistance: resistances
                .filter(|_| self.case.can_turn(link))
                .map(|(_, moment)| moment)
                .reduce(|sum, moment| sum + moment),
        }
    }
}
