//! Dry friction in the joints, and losses of transmissions.
//!
//! Friction acts against the sliding of a joint.
//! The magnitude of the friction is the coefficient of friction mu times the sum of the normal forces of the joint's
//! contacts.
//! A journal of the radius r has one contact, with the force R of the joint: the moment is mu r |R|.
//! A guide of the length l carries the force N and the moment M by contacts at its two ends.
//! The contact forces are N/2 + M/l and N/2 - M/l. The sum of their absolute values is the larger of |N| and 2 |M| / l.
//! A transmission with an efficiency loses a fraction of its power. The fraction depends on the sense of the power
//! flow.
//! The loss acts like friction: as a moment between carrier and first member that is proportional to the transmission's
//! force F.
//! See docs/numerics/friction.md.
//! J. L. Meriam, L. G. Kraige, Engineering Mechanics: Statics, 7th ed., Wiley 2012, sections 6/3 and 6/6.
//! In this source, mu r is the radius of a journal's friction circle. The forces of a guide's two contacts follow from
//! equilibrium.

use super::{Case, STANDSTILL, fastest};
use crate::drive::{Action, Load, Senses, Wrench};
use crate::math::{KeepNan, Motion, Vec2};
use crate::mechanism::{Joint, JointId, LinkId, Losses, Transmission, TransmissionId};

/// The friction of a joint, or the loss of a transmission.
#[derive(Clone, Copy, Debug)]
pub struct Friction<'a> {
    case: &'a Case,
    /// Index in [`Case::senses`] of the motion that determines the friction's sign.
    pub index: usize,
    /// The joint. For a transmission, the joint whose coordinate shows the sense of the motion.
    pub joint: JointId,
    /// The joint or transmission that has the friction, with its data.
    pub seat: FrictionSeat,
}

/// The joint or transmission that has the friction.
#[derive(Clone, Copy, Debug)]
pub enum FrictionSeat {
    /// The friction of a joint.
    Joint {
        /// Coefficient of friction.
        coefficient: f64,
        /// Radius of the journal, or length of the guide (m).
        length: f64,
    },
    /// The loss of a transmission.
    Mesh {
        /// The transmission.
        transmission: TransmissionId,
        /// The carrier and the first member.
        links: [LinkId; 2],
        /// The losses.
        losses: Losses,
    },
}

impl Case {
    /// The joints with friction, in the order of the loads, then the transmissions with losses.
    pub fn frictions(&self) -> impl Iterator<Item = Friction<'_>> {
        let in_joints = self.loads.iter().enumerate().filter_map(|(index, own)| {
            let &Load::Friction { joint, links: _, coefficient, length } = own else { return None };
            Some(Friction { case: self, index, joint, seat: FrictionSeat::Joint { coefficient, length } })
        });
        let in_meshes = self.mechanism.transmissions().entries().filter_map(|(transmission, own)| {
            let losses = own.losses?;
            let links = [own.design.carrier, own.design.links[0]];
            let seat = FrictionSeat::Mesh { transmission, links, losses };
            Some(Friction { case: self, index: self.loads.len() + transmission.index(), joint: losses.joint, seat })
        });
        in_joints.chain(in_meshes)
    }

    /// The motion whose sense determines the sign of a load or loss: for every load, then for every transmission.
    pub fn senses(&self) -> impl Iterator<Item = Senses> {
        let of_mesh = |own: &Transmission| own.losses.map_or(Senses::Nothing, |losses| Senses::Joint(losses.joint));
        self.loads.iter().map(|load| load.nature().senses).chain(self.mechanism.transmissions().iter().map(of_mesh))
    }

    /// Whether any joint has friction, or any transmission has losses.
    #[must_use]
    pub fn has_friction(&self) -> bool {
        self.frictions().next().is_some()
    }

    /// Rate of a joint's coordinate (rad/s or m/s).
    /// The result is zero for a joint that cannot move.
    /// The result is also zero if the rate is within the rounding error of the mechanism's speeds or the drives' top
    /// speeds.
    #[must_use]
    pub fn joint_rate(&self, motions: &[Motion], joint: JointId) -> f64 {
        if !self.can_move(joint) {
            return 0.0;
        }
        let joint = &self.mechanism.joints()[joint];
        let (rate, unit) = (joint.rates(motions)[0], if joint.slides() { self.mechanism.size() } else { 1.0 });
        // A rate that is NaN counts as zero.
        let least = (STANDSTILL * fastest(motions)).larger(self.standstill);
        if rate.abs() > least * unit { rate } else { 0.0 }
    }

    /// Adds all frictions to the loads on all links.
    /// `efforts` contains [`Friction::effort`] of each friction, in the order of [`Case::frictions`].
    pub fn add_friction(&self, efforts: &[f64], motions: &[Motion], out: &mut [Wrench]) {
        for (friction, &effort) in self.frictions().zip(efforts) {
            for action in friction.act(effort, motions) {
                out[action.link].add(&action, &motions[action.link], &self.mechanism.links()[action.link]);
            }
        }
    }
}

/// Forces of all transmissions (N), and reactions of all joints on the second links.
/// The reactions are forces (N), and moments about the joints' points on the second links (N m).
#[derive(Clone, Copy, Debug)]
pub struct JointReactions<'a> {
    /// One force per joint.
    pub forces: &'a [Vec2],
    /// One moment per joint.
    pub moments: &'a [f64],
    /// One force per transmission.
    pub transmitted: &'a [f64],
}

impl Friction<'_> {
    fn of_joint(&self) -> &Joint {
        &self.case.mechanism.joints()[self.joint]
    }

    /// Whether the friction is the loss of a transmission.
    #[must_use]
    pub fn is_mesh(&self) -> bool {
        matches!(self.seat, FrictionSeat::Mesh { .. })
    }

    /// Name of the joint or transmission.
    /// The flag is true if the friction is a force (N), and false if the friction is a moment (N m).
    #[must_use]
    pub fn name(&self) -> (&str, bool) {
        match self.seat {
            FrictionSeat::Joint { .. } => (&self.of_joint().name, self.of_joint().slides()),
            FrictionSeat::Mesh { transmission, .. } => {
                (self.case.mechanism.transmissions()[transmission].name(), false)
            }
        }
    }

    /// The reaction on which the friction depends: force (N) and moment (N m).
    /// For a transmission, the force is the vector (F, 0), and the moment is zero.
    #[inline]
    #[must_use]
    pub fn reaction(&self, all: JointReactions) -> (Vec2, f64) {
        match self.seat {
            FrictionSeat::Joint { .. } => (all.forces[self.joint.index()], all.moments[self.joint.index()]),
            FrictionSeat::Mesh { transmission, .. } => (Vec2::new(all.transmitted[transmission.index()], 0.0), 0.0),
        }
    }

    /// Sum of the normal forces of a joint's contacts (N). The sum of the normal forces is a norm of the reaction.
    /// For a transmission, the magnitude of the force times the lost fraction of the power.
    /// The sign of `sense` is the sign of [`rate`](Friction::rate).
    #[must_use]
    pub fn normal(&self, (force, moment): (Vec2, f64), sense: f64) -> f64 {
        match self.seat {
            FrictionSeat::Joint { length, .. } if self.of_joint().slides() && length > 0.0 => {
                force.norm().larger(2.0 * moment.abs() / length)
            }
            FrictionSeat::Joint { .. } => force.norm(),
            FrictionSeat::Mesh { losses, .. } => losses.normal(force.x, sense)[0],
        }
    }

    /// Upper bound of the change of [`normal`](Friction::normal) if the reaction changes by `change`.
    #[must_use]
    pub fn largest(&self, change: (Vec2, f64)) -> f64 {
        match self.seat {
            FrictionSeat::Joint { .. } => self.normal(change, 1.0),
            FrictionSeat::Mesh { losses: Losses { lost: [forward, back], .. }, .. } => {
                change.0.norm() * forward.larger(back)
            }
        }
    }

    /// Friction divided by [`normal`](Friction::normal).
    /// In a revolute joint this ratio is mu r (m), in a prismatic joint mu (1).
    /// For a transmission the ratio is the magnitude of [`Losses::lever`] times [`Losses::per`].
    #[must_use]
    pub fn lever(&self) -> f64 {
        match self.seat {
            FrictionSeat::Joint { coefficient, .. } if self.of_joint().slides() => coefficient,
            FrictionSeat::Joint { coefficient, length } => coefficient * length,
            FrictionSeat::Mesh { losses, .. } => (losses.lever * losses.per).abs(),
        }
    }

    /// Sliding speed of the contact divided by the rate of the joint's coordinate.
    /// The ratio is the radius of a journal (m), 1 for a guide, and 0 for a transmission.
    #[must_use]
    pub fn contact(&self) -> f64 {
        match self.seat {
            FrictionSeat::Joint { length, .. } if !self.of_joint().slides() => length,
            FrictionSeat::Joint { .. } => 1.0,
            FrictionSeat::Mesh { .. } => 0.0,
        }
    }

    /// Length of the guide (m).
    /// The length is zero for a revolute joint, and for a guide whose moment causes no friction.
    #[must_use]
    pub fn guide(&self) -> f64 {
        match self.seat {
            FrictionSeat::Joint { length, .. } if self.of_joint().slides() => length,
            FrictionSeat::Joint { .. } | FrictionSeat::Mesh { .. } => 0.0,
        }
    }

    /// [`Case::joint_rate`] of the joint.
    #[must_use]
    pub fn rate(&self, motions: &[Motion]) -> f64 {
        self.case.joint_rate(motions, self.joint)
    }

    /// Friction for these reactions (N m or N). Positive friction acts towards larger values of the joint's coordinate.
    /// For a joint, the result is the friction on the second link. Friction is zero at standstill.
    #[must_use]
    pub fn effort(&self, motions: &[Motion], reactions: JointReactions) -> f64 {
        let rate = self.rate(motions);
        let normal = self.normal(self.reaction(reactions), rate);
        if rate == 0.0 { 0.0 } else { -rate.signum() * self.lever() * normal }
    }

    /// Actions of the friction on the joint's first and second link.
    /// For a transmission, actions on the carrier and on the first member.
    /// `effort` is the result of [`Friction::effort`].
    #[must_use]
    pub fn act(&self, effort: f64, motions: &[Motion]) -> [Action; 2] {
        match self.seat {
            FrictionSeat::Joint { .. } => Action::pair(self.of_joint(), effort, motions),
            FrictionSeat::Mesh { links: [carrier, first], losses, .. } => {
                // The power of the moment equals `effort` times the rate of the joint's coordinate.
                let moment = effort / losses.per;
                [Action::of_moment(carrier, -moment), Action::of_moment(first, moment)]
            }
        }
    }
}

impl Losses {
    /// Returns two numbers: the magnitude of the transmission's force (N) times the lost fraction of the power, and the
    /// derivative of this product with respect to the force.
    /// The sign of `sense` is the sign of the rate of the joint's coordinate. At standstill both results are zero.
    #[must_use]
    pub fn normal(&self, force: f64, sense: f64) -> [f64; 2] {
        if sense == 0.0 {
            return [0.0; 2];
        }
        let way = if sense > 0.0 { self.lever.signum() } else { -self.lever.signum() };
        let lost = if force * way >= 0.0 { self.lost[0] } else { -self.lost[1] };
        [lost * way * force, lost * way]
    }
}
