//! Constants of individual links and joints of a case.

use super::poses::Layout;
use linkage::case::Case;
use linkage::drive::Load;
use linkage::math::Vec2;
use linkage::mechanism::{Joint, JointId, LinkId, Mechanism};

/// Action of a joint on one of its links: the joint's reaction with the sign of `sign`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Action {
    /// Column of the reaction.
    pub(super) force: usize,
    /// Point of action, in the link's frame.
    pub(super) place: Vec2,
    /// Zero with a sign.
    pub(super) sign: f64,
    joint: JointId,
    /// Whether the link is the joint's second link.
    is_second: bool,
}

impl Action {
    /// Reads `place` from the mechanism, and returns the joint's position on its other link.
    pub(super) fn renumber(&mut self, mechanism: &Mechanism) -> Vec2 {
        let Joint { first, second, .. } = &mechanism.joints()[self.joint];
        let (own, other) = if self.is_second { (second, first) } else { (first, second) };
        self.place = own.local;
        other.local
    }
}

/// A link with the actions on it.
#[derive(Clone, Debug)]
pub(super) struct Body {
    /// First column of the link.
    pub(super) link: usize,
    of: LinkId,
    pub(super) mass: f64,
    pub(super) mass_centre: Vec2,
    pub(super) inertia: f64,
    /// Actions of the joints at which later groups are attached to the link.
    pub(super) hanging: Vec<Action>,
    /// Sum of the moments of resistance on the link (N m).
    pub(super) resistance: Option<f64>,
}

impl Body {
    /// Reads mass, mass centre and moment of inertia, and the places of the actions, from the mechanism.
    pub(super) fn renumber(&mut self, mechanism: &Mechanism) {
        let own = &mechanism.links()[self.of];
        (self.mass, self.mass_centre, self.inertia) = (own.mass, own.mass_centre, own.inertia);
        for action in &mut self.hanging {
            action.renumber(mechanism);
        }
    }
}

/// Reads the constants from a case.
pub(super) struct Reader<'a> {
    pub(super) case: &'a Case,
    pub(super) layout: Layout,
    /// For every joint: whether its reaction is known before the current group is solved.
    pub(super) settled: &'a [bool],
}

impl Reader<'_> {
    /// First column of the other link of a joint; `None` for the ground.
    pub(super) fn base(&self, joint: JointId, link: LinkId) -> Option<usize> {
        self.layout.link(self.case.mechanism.joints()[joint].other(link).link)
    }

    pub(super) fn action(&self, joint: JointId, link: LinkId) -> Action {
        let own = &self.case.mechanism.joints()[joint];
        let is_second = own.second.link == link;
        Action {
            force: self.layout.force(joint),
            place: own.on(link).expect("the joint is on the link"),
            sign: if is_second { 0.0 } else { -0.0 },
            joint,
            is_second,
        }
    }

    pub(super) fn body(&self, link: LinkId) -> Body {
        let joints = self.case.mechanism.joints();
        let hanging = joints.ids().filter(|&joint| self.settled[joint] && joints[joint].on(link).is_some());
        let body = &self.case.mechanism.links()[link];
        let resistances = self.case.loads.iter().filter_map(Load::resistance).filter(|(loaded, _)| *loaded == link);
        Body {
            link: self.layout.link(link).expect("the link moves"),
            of: link,
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
