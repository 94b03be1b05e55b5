//! Published methods for the class III group of order 3: a base link on three leads, all joints revolute.
//!
//! The methods compute, with independent equations, quantities that the two solvers also compute.
//! Two methods give the motion: transfer functions by Cramer's rule ([`cramer`]), and the exchange of the driving link
//! ([`class_change`]). Two methods give the reactions: the singular Assur point ([`assur_point`]), and the solution of
//! all equations of equilibrium at once ([`linear_system`]).
//!
//! In these modules lead i goes from its foot A_i, the outer joint, to its head B_i, the joint with the base link.
//! Arrays of three are in the order of [`Triad::leads`]. Arrays of four contain the three leads and then the base link.

pub mod assur_point;
pub mod class_change;
pub mod cramer;
pub mod linear_system;

use crate::sentences;
use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::error::{Error, ErrorKind};
use linkage::math::{Motion, Vec2, cross};
use linkage::mechanism::{Group, JointId, JointSide, LinkId, Mechanism};
use linkage::solver::State;

/// One of the three leads, which connect the base link to the rest of the mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriadLead {
    /// The link.
    pub link: LinkId,
    /// Outer joint of the lead.
    pub outer: JointId,
    /// Joint of the lead with the base link.
    pub inner: JointId,
    /// The outer joint on the supporting link, whose motion is known before the motion of the group is computed.
    pub support: JointSide,
    /// The outer joint in the lead's frame (m).
    pub foot: Vec2,
    /// The inner joint in the lead's frame (m).
    pub head: Vec2,
    /// The inner joint in the base link's frame (m).
    pub on_base: Vec2,
}

/// A class III group of order 3 with revolute pairs only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triad {
    /// The link to which all three leads are attached.
    pub base: LinkId,
    /// The leads, in the order of the group's outer joints.
    pub leads: [TriadLead; 3],
}

impl Triad {
    /// Interprets a group as a base link on three leads.
    /// `None` for any other group, and also if a joint on one of the group's links is not revolute, because this joint
    /// would also transmit a moment.
    /// Joints that connect later groups to the group's links count too.
    #[must_use]
    pub fn of(mechanism: &Mechanism, group: &Group) -> Option<Self> {
        let touching = mechanism.joints().iter().filter(|joint| group.links.iter().any(|&l| joint.on(l).is_some()));
        let sizes = [group.class, group.links.len(), group.inner.len(), group.outer.len()];
        if sizes != [3, 4, 3, 3] || !touching.clone().all(|joint| joint.is_pin()) {
            return None;
        }
        let on = |joint: JointId, link: LinkId| mechanism.joints()[joint].on(link);
        let base =
            group.links.iter().copied().find(|&link| group.inner.iter().all(|&joint| on(joint, link).is_some()))?;
        let lead = |outer: JointId| {
            let link = group.links.iter().copied().find(|&link| link != base && on(outer, link).is_some())?;
            let inner = group.inner.iter().copied().find(|&joint| on(joint, link).is_some())?;
            Some(TriadLead {
                link,
                outer,
                inner,
                support: mechanism.joints()[outer].other(link),
                foot: on(outer, link)?,
                head: on(inner, link)?,
                on_base: on(inner, base)?,
            })
        };
        Some(Triad { base, leads: [lead(group.outer[0])?, lead(group.outer[1])?, lead(group.outer[2])?] })
    }

    /// All class III groups of order 3 with revolute pairs only, of one case.
    #[must_use]
    pub fn all(case: &Case) -> Vec<Self> {
        case.structure.groups.iter().filter_map(|group| Triad::of(&case.mechanism, group)).collect()
    }

    /// The group's links: leads, then base link.
    #[must_use]
    pub fn links(&self) -> [LinkId; 4] {
        [self.leads[0].link, self.leads[1].link, self.leads[2].link, self.base]
    }

    /// World positions of feet and heads (m).
    #[must_use]
    pub fn places(&self, motions: &[Motion]) -> Places {
        Places {
            feet: self.leads.map(|lead| motions[lead.support.link].point(lead.support.local)),
            heads: self.leads.map(|lead| motions[self.base].point(lead.on_base)),
        }
    }

    /// Resultant of the known forces on each link: all forces except the group's reactions.
    /// The known forces are gravity and inertia m (g - a) at the mass centre, the moment -J alpha, and loads.
    /// The known forces also include the reactions in the joints with later groups; these reactions are taken from the
    /// state.
    #[must_use]
    pub fn known(&self, case: &Case, state: &State) -> [KnownResultant; 4] {
        let (motions, forces) = (&state.motions, &state.forces);
        let mut loads = vec![Wrench::ZERO; motions.len()];
        case.loads_on(motions, &state.angles, &mut loads);
        let own = |joint: JointId| self.leads.iter().any(|lead| lead.outer == joint || lead.inner == joint);
        self.links().map(|link| {
            let (body, motion) = (&case.mechanism.links()[link], &motions[link]);
            let at = motion.point(body.mass_centre);
            let inertia = (case.gravity - motion.point_acceleration(body.mass_centre)) * body.mass;
            let Wrench { force, moment } = loads[link];
            let mut known = KnownResultant { force: inertia + force, moment: moment - body.inertia * motion.alpha, at };
            for (index, joint) in case.mechanism.joints().entries() {
                if let (Some(local), false) = (joint.on(link), own(index)) {
                    let force = if joint.second.link == link { forces[index] } else { -forces[index] };
                    known.force += force;
                    known.moment += cross(motion.point(local) - at, force);
                }
            }
            known
        })
    }

    /// Each joint of the group with its reaction (N): the force of the joint's first link on its second link. The feet
    /// come before the heads.
    #[must_use]
    pub fn joint_forces(&self, mechanism: &Mechanism, reactions: &Reactions) -> [(JointId, Vec2); 6] {
        let of = |joint: JointId, loaded: LinkId, force: Vec2| {
            (joint, if mechanism.joints()[joint].second.link == loaded { force } else { -force })
        };
        let foot = |k: usize| of(self.leads[k].outer, self.leads[k].link, reactions.feet[k]);
        let head = |k: usize| of(self.leads[k].inner, self.base, reactions.heads[k]);
        [foot(0), foot(1), foot(2), head(0), head(1), head(2)]
    }
}

/// Positions of the group's joints (m, world axes).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Places {
    /// Outer joints.
    pub feet: [Vec2; 3],
    /// Joints with the base link.
    pub heads: [Vec2; 3],
}

/// Resultant of the known forces on one link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownResultant {
    /// Force (N, world axes).
    pub force: Vec2,
    /// Moment about `at` (N m, counter-clockwise positive).
    pub moment: f64,
    /// World point that the moment refers to (m).
    pub at: Vec2,
}

impl KnownResultant {
    /// Moment about the world point `pole` (N m).
    #[must_use]
    pub fn about(&self, pole: Vec2) -> f64 {
        self.moment + cross(self.at - pole, self.force)
    }
}

/// Reactions in the six joints of the group (N, world axes).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reactions {
    /// Forces of the supports on the leads, at the feet.
    pub feet: [Vec2; 3],
    /// Forces of the leads on the base link, at the heads.
    pub heads: [Vec2; 3],
}

fn singular(method: &str) -> Error {
    Error::new(ErrorKind::Numeric, sentences::the_lines_of_the_three_leads(&method))
        .help(sentences::TAKE_A_CRANK_ANGLE_AT_WHICH_THE_LINES)
}
