//! A link, the loads on it, and the action of a joint on it.

use linkage::case::Case;
use linkage::drive::{Drive, Load, Wrench};
use linkage::input::Input;
use linkage::math::{Motion, Vec2, cross};
use linkage::mechanism::{
    Group, JointId, JointSide, LinkId, Mechanism, PerJoint, PerTransmission, Transmission, TransmissionId,
};

/// Reactions that the first link of every joint exerts on the second. The reactions are filled in from the last group
/// to the first.
#[derive(Debug)]
pub(super) struct Reactions<'a> {
    /// Forces (N).
    pub(super) forces: &'a mut [Vec2],
    /// Moments about the joint's position on the second link (N m); in revolute joints only driving moments.
    pub(super) moments: &'a mut [f64],
    /// Forces of the transmissions (N).
    pub(super) transmitted: &'a mut [f64],
    /// Moment (N m) or force (N) of every drive.
    pub(super) efforts: &'a mut [f64],
    /// Loads on every link; empty if the case has no loads.
    pub(super) loads: &'a [Wrench],
}

/// The joints and transmissions whose forces are known before a group is solved: the joints and transmissions of all
/// groups after it.
#[derive(Debug)]
pub(super) struct Settled {
    joints: PerJoint<bool>,
    transmissions: PerTransmission<bool>,
}

impl Settled {
    /// No force is known yet.
    pub(super) fn nothing(mechanism: &Mechanism) -> Self {
        Settled {
            joints: vec![false; mechanism.joints().len()].into(),
            transmissions: vec![false; mechanism.transmissions().len()].into(),
        }
    }

    pub(super) fn add(&mut self, joint: JointId) {
        self.joints[joint] = true;
    }

    /// Adds the joints and transmissions of a group.
    pub(super) fn add_group(&mut self, group: &Group) {
        group.inner.iter().chain(&group.outer).for_each(|&joint| self.add(joint));
        group.trains.iter().for_each(|&transmission| self.transmissions[transmission] = true);
    }
}

/// Action of a joint on one of its links: `sign` times its reaction, at the reaction's reference point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Action {
    pub(super) joint: JointId,
    side: JointSide,
    sign: f64,
    /// Whether the joint also transmits a moment: a prismatic joint, or a driven joint between moving links.
    has_moment: bool,
    /// Whether the joint is the origin of the link's frame.
    at_origin: bool,
}

impl Action {
    pub(super) fn of(case: &Case, joint: JointId, link: LinkId) -> Self {
        let found = &case.mechanism.joints()[joint];
        let side = found.acts_at(link);
        let sign = if found.second.link == link { 1.0 } else { -1.0 };
        let is_turned = |drive: &Drive| drive.joint == joint && drive.input == Input::Turn;
        let has_moment = found.slides() || case.drives.iter().any(is_turned);
        Action { joint, side, sign, has_moment, at_origin: side.local == Vec2::zeros() }
    }

    /// World position at which the joint acts.
    #[inline]
    pub(super) fn place(&self, motions: &[Motion]) -> Vec2 {
        let motion = &motions[self.side.link];
        if self.at_origin { motion.origin } else { motion.point(self.side.local) }
    }

    /// Stores the joint's reaction, given the force on the link.
    #[inline]
    pub(super) fn put(&self, force: Vec2, reactions: &mut Reactions) {
        reactions.forces[self.joint] = force * self.sign;
    }

    /// Stores the driving moment of a driven revolute joint between moving links, given the moment on the link (N m).
    #[inline]
    pub(super) fn put_moment(&self, moment: f64, reactions: &mut Reactions) {
        reactions.moments[self.joint] = moment * self.sign;
    }

    /// Factor by which the joint's reaction is multiplied to give the action on the link: +1 for the joint's second
    /// link, -1 for the first.
    #[inline]
    pub(super) fn sign(&self) -> f64 {
        self.sign
    }

    /// Stores a prismatic joint's reaction, given the force on the link and a moment about `pole`.
    /// `force` is the force of this joint on the link.
    /// `moment` is the sum of the moments of all actions on the link except this joint's reaction, which balances it.
    #[inline]
    pub(super) fn put_guided(
        &self,
        force: Vec2,
        moment: f64,
        pole: Vec2,
        motions: &[Motion],
        reactions: &mut Reactions,
    ) {
        reactions.forces[self.joint] = force * self.sign;
        reactions.moments[self.joint] = (-moment - cross(self.place(motions) - pole, force)) * self.sign;
    }
}

/// A link with the joints at which later groups are attached to it.
/// The struct contains a copy of the masses: a look-up in the mechanism's list of links would make the force analysis a
/// tenth slower.
#[derive(Clone, Debug)]
pub(super) struct Body {
    link: LinkId,
    mass: f64,
    inertia: f64,
    centre: Vec2,
    /// Whether loads may act on the link.
    is_loaded: bool,
    hanging: Vec<Action>,
    /// Transmissions with this link as a member.
    coupled: Vec<TransmissionId>,
}

impl Body {
    pub(super) fn of(case: &Case, link: LinkId, settled: &Settled) -> Self {
        let is_loaded = |load: &Load| load.resistance().is_none_or(|(loaded, _)| loaded == link);
        let on_link = case.mechanism.joints_on(link).iter().filter(|&&index| settled.joints[index]);
        let coupled = case.mechanism.transmissions().entries();
        let coupled = coupled.filter(|(id, own)| settled.transmissions[*id] && own.design.links.contains(&link));
        let hanging = on_link.map(|&index| Action::of(case, index, link)).collect();
        let body = &case.mechanism.links()[link];
        let loses = |own: &Transmission| own.losses.is_some() && own.links().contains(&link);
        Body {
            link,
            mass: body.mass,
            inertia: body.inertia,
            centre: body.mass_centre,
            is_loaded: case.loads.iter().any(is_loaded) || case.mechanism.transmissions().iter().any(loses),
            hanging,
            coupled: coupled.map(|(id, _)| id).collect(),
        }
    }

    /// Returns the resultant of all known forces on the link (N) and their moment about the world point `pole` (N m).
    #[inline(always)]
    pub(super) fn resultant(&self, case: &Case, motions: &[Motion], reactions: &Reactions, pole: Vec2) -> (Vec2, f64) {
        let motion = &motions[self.link];
        let centre = motion.arm(self.centre);
        let mut force = (case.gravity - motion.acceleration_beyond(centre)) * self.mass;
        let mut moment = -self.inertia * motion.alpha;
        if self.is_loaded {
            let load = &reactions.loads[self.link];
            force += load.force;
            moment += load.moment;
        }
        moment += cross(motion.origin + centre - pole, force);
        for action in &self.hanging {
            let hung = reactions.forces[action.joint] * action.sign;
            force += hung;
            let mut about = cross(action.place(motions) - pole, hung);
            if action.has_moment {
                about += reactions.moments[action.joint] * action.sign;
            }
            moment += about;
        }
        if !self.coupled.is_empty() {
            let (own, about) = self.transmitted(case, motions, reactions, pole);
            force += own;
            moment += about;
        }
        (force, moment)
    }

    /// Force of the known transmissions on the link (N) and its moment about the world point `pole` (N m).
    #[cold]
    #[inline(never)]
    fn transmitted(&self, case: &Case, motions: &[Motion], reactions: &Reactions, pole: Vec2) -> (Vec2, f64) {
        let (mut force, mut moment) = (Vec2::zeros(), 0.0);
        for &id in &self.coupled {
            let (transmission, transmitted) = (&case.mechanism.transmissions()[id], reactions.transmitted[id]);
            transmission.each_action(case.mechanism.joints(), transmitted, motions, |link, own, place| {
                if link == self.link {
                    force += own;
                    moment += cross(place - pole, own);
                }
            });
        }
        (force, moment)
    }
}
