//! Transmissions: gear pairs, racks, screws, belts and cams that couple the coordinates of two members of one carrier.
//!
//! A member turns about an axle of the carrier, or slides in a guide of the carrier.
//! The force between the members acts along a line of action. This line is fixed in the carrier, except for cams.
//! The line has the unit vector w. The force acts on each member at a point of the line, the member's foot.
//! The feet of the two members have the same speed along the line: w . (v2 - v1) = 0.
//! With the coordinates q1 and q2 of the members relative to the carrier, q2' = f'(q1) q1', so q2 - f(q1) is constant.
//! The law f is linear, except for cams.
//! The force F w acts on the second member at its foot, and the force -F w on the first member at its foot.
//! There are two lines of action, one for each sense of the transmitted moment: the two flanks of a tooth, or the two
//! strands of a belt. Teeth push and strands pull, so F >= 0 along the line that acts.
//! A gear pair with the pressure angle alpha acts like a crossed belt that pushes, on base circles of the radii
//! r cos(alpha): Niemann and Winter, Maschinenelemente, vol. 2, 2nd ed., Springer 2003, chapter 21.1.

use std::f64::consts::TAU;

use super::cam::{Cam, CamContact, CamLaw, Follower};
use super::contact::{Contact, LineOfAction};
use super::ids::{JointId, LinkId, PerJoint, PerLink};
use super::parts::{GROUND, Joint, Link};
use crate::error::{Error, ErrorKind, Result};
use crate::math::{Motion, Vec2, cross, turned};
use crate::sentences;

mod geometry;

pub use geometry::Member;
use geometry::{COINCIDE, axle, belt, gears, guide, rack, sense, sliding};

/// Kind of transmission.
#[derive(Clone, Debug, PartialEq)]
pub enum TransmissionKind {
    /// Two gears with the pressure angle (rad). The pitch radii follow from the distance of the axles.
    Gears {
        /// Numbers of teeth, negative for a ring gear. Only their ratio matters.
        teeth: [f64; 2],
        /// Pressure angle (rad), at least 0 and below a right angle.
        pressure_angle: f64,
    },
    /// A pinion, the first member, and a rack that slides in the carrier.
    /// The pitch radius is the distance of the pinion's axle from the line of the rack's guide.
    Rack {
        /// Pressure angle (rad), at least 0 and below a right angle.
        pressure_angle: f64,
    },
    /// A screw, the first member, and a nut that slides in the carrier.
    /// In the plane, screw and nut are modelled as a pinion of the radius lead / (2 pi) and a rack without pressure
    /// angle.
    /// The axial force acts at the radius lead / (2 pi) from the axle of the screw.
    Screw {
        /// Slide of the nut along the axis for one counter-clockwise turn of the screw (m), not zero.
        lead: f64,
    },
    /// A belt or chain over two wheels.
    Belt {
        /// Pitch radii (m).
        radii: [f64; 2],
        /// Whether the strands cross, so that the wheels turn in opposite senses.
        crossed: bool,
        /// Tension of the slack strand (N), not negative; 0 for a chain.
        slack: f64,
    },
    /// A cam, the first member, and its follower, which slides or swings.
    Cam {
        /// Lift of the follower as a function of the cam's angle relative to the carrier.
        law: CamLaw,
        /// The part of the follower that touches the cam.
        contact: CamContact,
    },
}

impl TransmissionKind {
    /// Name, as in scenario files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            TransmissionKind::Gears { .. } => "gears",
            TransmissionKind::Rack { .. } => "rack",
            TransmissionKind::Screw { .. } => "screw",
            TransmissionKind::Belt { .. } => "belt",
            TransmissionKind::Cam { .. } => "cam",
        }
    }
}

/// The given data of a transmission, from which [`Transmission::of`] finds the geometry.
#[derive(Clone, Debug, PartialEq)]
pub struct TransmissionDesign {
    /// Name, unique among the transmissions.
    pub name: String,
    /// Kind of transmission, with its dimensions.
    pub kind: TransmissionKind,
    /// First and second member.
    pub links: [LinkId; 2],
    /// The link that carries both axles, or the axle and the guide.
    pub carrier: LinkId,
    /// The joint whose coordinate at t = 0 fixes the phase.
    pub joint: JointId,
    /// Coordinate of `joint` at t = 0: the angle of its second link minus the angle of its first link (rad), or the
    /// slide (m).
    pub start: f64,
    /// Two efficiencies: for power that flows from the first member to the second (1e-6 to 1), then for the opposite
    /// direction (-1e6 to 1).
    /// If the second efficiency is not positive, the transmission is self-locking: the second member alone cannot move
    /// the first.
    pub efficiency: [f64; 2],
}

/// Largest ratio of supplied power to useful power, and largest magnitude of a negative second efficiency.
/// With a larger value, rounding errors of the reactions exceed all bounds.
const LARGEST_LOSS: f64 = 1e6;

/// A transmission between two members of a carrier.
#[derive(Clone, Debug, PartialEq)]
pub struct Transmission {
    /// The given data.
    pub design: TransmissionDesign,
    /// First and second member.
    pub members: [Member; 2],
    /// The coordinates of the members relative to the carrier, each as a sum of angles or slides with signs.
    pub coordinates: [Vec<(Coordinate, f64)>; 2],
    /// The contact between the members. A cam does not use this field, because the contact of a cam depends on the
    /// pose.
    fixed: Contact,
    /// A cam and its follower; `None` for other transmissions.
    pub cam: Option<Cam>,
    /// The losses; `None` if both efficiencies are 1.
    pub losses: Option<Losses>,
}

/// The losses of a transmission. The losses act as a moment between the carrier and the first member, against their
/// relative rotation.
/// If a transmission has losses, its force is the force on the second member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Losses {
    /// A joint between the carrier and a member. The rate of the joint's coordinate gives the sense of the motion.
    pub joint: JointId,
    /// Rate of the first member relative to the carrier, divided by the rate of this joint's coordinate (1, or 1/m).
    pub per: f64,
    /// Lever of the losses (m): their moment for a force of 1 N in the first line of action and a lost fraction of 1.
    /// The lever is positive if this force takes power from the first member while the joint's coordinate increases.
    pub lever: f64,
    /// Lost power divided by the power at the second member.
    /// The first number applies if power flows to the second member, the second number if power comes from the second
    /// member.
    pub lost: [f64; 2],
}

/// An angle or slide that a transmission couples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// Angle of a link (rad).
    Angle(LinkId),
    /// Slide of a prismatic joint (m).
    Slide(JointId),
}

impl Coordinate {
    /// The joint of a slide; `None` for an angle.
    #[must_use]
    pub fn joint(self) -> Option<JointId> {
        match self {
            Coordinate::Angle(_) => None,
            Coordinate::Slide(joint) => Some(joint),
        }
    }
}

impl Transmission {
    /// Finds the geometry of a transmission in a mechanism with these links and joints.
    /// `size` is the size of the mechanism (m).
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if members and carrier are not three links, if a member has no axle or guide on the
    /// carrier, if the numbers allow no contact, or if the efficiencies are out of range.
    pub fn of(links: &PerLink<Link>, joints: &PerJoint<Joint>, size: f64, design: TransmissionDesign) -> Result<Self> {
        let TransmissionDesign { links: [first, second], carrier, .. } = design;
        if first == second || design.links.contains(&carrier) {
            return Err(design.fault(sentences::A_TRANSMISSION_NEEDS_THREE_LINKS, sentences::NAME_TWO_MEMBERS));
        }
        let axle = |link: LinkId| {
            axle(joints, size, link, carrier).ok_or_else(|| {
                let name = |link: LinkId| links[link].name.as_str();
                let message = sentences::the_member_has_no_axle(&name(link), &name(carrier));
                design.fault(message, sentences::JOIN_THE_MEMBER_TO_THE_CARRIER)
            })
        };
        let [place, local] = axle(first)?;
        let one = Member { link: first, place, radius: 0.0, local };
        let mut cam = None;
        let second_axle = || axle(second).map(|[place, local]| Member { link: second, place, radius: 0.0, local });
        let slide = guide(joints, second, carrier);
        let sliding_line = || match slide {
            Some((_, line)) => Ok(line),
            None => Err(design.fault(sentences::THE_RACK_DOES_NOT_SLIDE, sentences::JOIN_THE_RACK)),
        };
        let ([one, other], lines) = match design.kind {
            TransmissionKind::Rack { pressure_angle } => {
                let line = sliding_line()?;
                rack(one, line, second, pressure_angle, line[0] + line[1] * line[1].dot(&(place - line[0])))
            }
            TransmissionKind::Screw { lead } => {
                let line = sliding_line()?;
                rack(one, line, second, 0.0, place - turned(line[1]) * (lead / TAU))
            }
            TransmissionKind::Gears { teeth, pressure_angle } => gears([one, second_axle()?], teeth, pressure_angle),
            TransmissionKind::Belt { radii, crossed, slack: _ } => belt([one, second_axle()?], radii, crossed),
            TransmissionKind::Cam { ref law, contact } => {
                let (other, follower) = match slide {
                    Some((joint, line)) => sliding(second, &joints[joint], line, contact.point()),
                    None if matches!(contact, CamContact::Flat(_)) => {
                        let message = sentences::THE_FLAT_FOLLOWER_DOES_NOT_SLIDE;
                        return Err(design.fault(message, sentences::JOIN_THE_FOLLOWER));
                    }
                    None => {
                        let own = second_axle()?;
                        (own, Follower::Swings { pivot: own.place, arm: contact.point() - own.local })
                    }
                };
                cam = Some(Cam { law: law.clone(), contact, follower, axle: [one.place, one.local] });
                ([one, other], [LineOfAction { direction: Vec2::new(1.0, 0.0), feet: [other.place; 2] }; 2])
            }
        };
        let members = [one, other];
        let is_sound =
            |line: &LineOfAction| line.direction.iter().chain(line.feet.iter().flatten()).all(|x| x.is_finite());
        let has_room = cam.is_some() || (one.place - other.place).norm() > COINCIDE * size;
        if !(has_room && lines.iter().all(is_sound)) {
            return Err(design.fault(sentences::THE_MEMBERS_CANNOT_TOUCH, sentences::MOVE_THE_AXLES_APART));
        }
        let is_moving = |(of, _): &(Coordinate, f64)| *of != Coordinate::Angle(GROUND);
        let against = |of| vec![(of, 1.0), (Coordinate::Angle(carrier), -1.0)].into_iter().filter(is_moving).collect();
        let (coupled, factor) = match slide {
            // A rack, nut or sliding follower.
            Some((joint, [_, axis, _])) if members[1].radius == 0.0 => {
                let sign = sense(&joints[joint], second);
                (vec![(Coordinate::Slide(joint), 1.0)], sign * axis.dot(&lines[0].direction))
            }
            Some(_) | None => {
                (against(Coordinate::Angle(second)), cross(lines[0].feet[1] - other.place, lines[0].direction))
            }
        };
        let coordinates = [against(Coordinate::Angle(first)), coupled];
        let fixed = Contact { lines, factor, turn: 0.0, drift: Vec2::zeros() };
        let mut found = Transmission { design, members, coordinates, fixed, cam, losses: None };
        found.losses = found.find_losses(joints)?;
        Ok(found)
    }

    fn find_losses(&self, joints: &PerJoint<Joint>) -> Result<Option<Losses>> {
        let [forward, back] = self.design.efficiency;
        if [forward, back] == [1.0; 2] {
            return Ok(None);
        }
        let fault = |message: &str, help| Err(self.design.fault(message, help));
        if !(1.0 / forward <= LARGEST_LOSS && forward <= 1.0 && (-LARGEST_LOSS..=1.0).contains(&back)) {
            return fault(&sentences::the_efficiencies_are(&forward, &back), sentences::GIVE_EFFICIENCIES);
        }
        let Some(ratio) = self.ratio() else {
            return fault(sentences::A_CAM_HAS_NO_EFFICIENCY, sentences::GIVE_FRICTION);
        };
        let links = self.design.links;
        let shown = [(links[0], 1.0), (links[1], 1.0 / ratio)].into_iter().find_map(|(link, per)| {
            let is_meant = |joint: &Joint| joint.on(link).is_some() && joint.on(self.design.carrier).is_some();
            let (id, joint) = joints.entries().find(|(_, joint)| is_meant(joint))?;
            // If the second member slides, the ratio already contains the sign of the slide.
            let sign = if joint.slides() { 1.0 } else { sense(joint, link) };
            Some((id, per * sign))
        });
        let Some((joint, per)) = shown else {
            return fault(sentences::NO_MEMBER_IS_JOINED_TO_THE_CARRIER, sentences::JOIN_A_MEMBER_TO_THE_CARRIER);
        };
        let lost = [1.0 / forward - 1.0, 1.0 - back];
        Ok(Some(Losses { joint, per, lever: self.lever() * per.signum(), lost }))
    }

    /// Lever arm of a force in the first line of action about the axle of the first member (m), with its sign.
    fn lever(&self) -> f64 {
        let line = &self.fixed.lines[0];
        cross(line.feet[0] - self.members[0].place, line.direction)
    }

    /// Name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.design.name
    }

    /// The members' links and the carrier.
    #[must_use]
    pub fn links(&self) -> [LinkId; 3] {
        [self.members[0].link, self.members[1].link, self.design.carrier]
    }

    /// The prismatic joint of a rack, nut or sliding follower.
    #[must_use]
    pub fn slide(&self) -> Option<JointId> {
        self.coordinates[1].iter().find_map(|(of, _)| of.joint())
    }

    /// Ratio of the members' rates relative to the carrier, q2' / q1' (in m for a rack or screw, otherwise without
    /// unit).
    /// `None` for a cam.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        self.cam.is_none().then(|| self.lever() / self.fixed.factor)
    }

    /// The law f: its value at the first member's coordinate (rad), and its first two derivatives.
    #[must_use]
    pub fn law(&self, q1: f64) -> [f64; 3] {
        match (&self.cam, self.ratio()) {
            (Some(cam), _) => cam.lift(q1),
            (None, ratio) => ratio.map_or([f64::NAN; 3], |ratio| [ratio * q1, ratio, 0.0]),
        }
    }

    /// The contact for these coordinates of the members (rad, or rad and m).
    pub fn contact(&self, members: [f64; 2]) -> Contact {
        self.cam.as_ref().map_or(self.fixed, |cam| cam.contact(members))
    }

    /// The contact in a pose.
    pub fn contact_in(&self, joints: &PerJoint<Joint>, motions: &[Motion]) -> Contact {
        self.cam.as_ref().map_or(self.fixed, |cam| cam.contact(self.coordinates_in(joints, motions)))
    }

    /// The coordinates of the members in a pose (rad, or rad and m). Angles are from -pi to pi.
    #[must_use]
    pub fn coordinates_in(&self, joints: &PerJoint<Joint>, motions: &[Motion]) -> [f64; 2] {
        let carrier = motions[self.design.carrier].direction;
        let against =
            |link: LinkId| cross(carrier, motions[link].direction).atan2(carrier.dot(&motions[link].direction));
        let q2 = match self.slide() {
            Some(joint) => joints[joint].slide(motions).expect("the member slides")[0],
            None => against(self.members[1].link),
        };
        [against(self.members[0].link), q2]
    }

    /// Time (s) between the pose and the nearest knot of the cam's law, at the present speed of the cam. A knot is an
    /// end of a piece of the law; the nearest knot can lie before or after the pose.
    /// The time is infinite for a transmission without a cam, and if the cam stands still.
    #[must_use]
    pub fn time_to_knot(&self, joints: &PerJoint<Joint>, motions: &[Motion]) -> f64 {
        let Some(cam) = &self.cam else { return f64::INFINITY };
        let spin = motions[self.members[0].link].omega - motions[self.design.carrier].omega;
        if spin == 0.0 { f64::INFINITY } else { cam.to_knot(self.coordinates_in(joints, motions)[0]) / spin.abs() }
    }

    /// The actions on the two members in a pose, if the force in the first line of action is 1 N. Each action consists
    /// of the member's link, the force on this link, and the point at which the force acts (m).
    #[must_use]
    pub fn unit_actions(&self, joints: &PerJoint<Joint>, motions: &[Motion]) -> [(LinkId, Vec2, Vec2); 2] {
        let (carrier, line) = (&motions[self.design.carrier], self.contact_in(joints, motions).lines[0]);
        let force = carrier.arm(line.direction);
        [(0, -force), (1, force)].map(|(k, force)| (self.members[k].link, force, carrier.point(line.feet[k])))
    }

    /// The force (N, not negative) in each line of action if the transmission exerts `force` (N).
    /// A positive `force` acts in the first line, a negative one in the second line.
    /// The tension of a slack strand is added in both lines.
    #[must_use]
    pub fn forces(&self, force: f64) -> [f64; 2] {
        let slack = match self.design.kind {
            TransmissionKind::Belt { slack, .. } => slack,
            TransmissionKind::Gears { .. }
            | TransmissionKind::Rack { .. }
            | TransmissionKind::Screw { .. }
            | TransmissionKind::Cam { .. } => 0.0,
        };
        // If `force` is NaN, one of the results must be NaN. `f64::max` would return 0.
        let [push, pull] = if force >= 0.0 { [force, 0.0] } else { [0.0, -force] };
        [push + slack, pull + slack]
    }

    /// Calls `put` once for each action of a transmission that exerts `force` (N). The arguments of `put` are the link,
    /// the force on the link (N) and the point at which the force acts (m).
    pub fn each_action(
        &self,
        joints: &PerJoint<Joint>,
        force: f64,
        motions: &[Motion],
        mut put: impl FnMut(LinkId, Vec2, Vec2),
    ) {
        let carrier = &motions[self.design.carrier];
        for (line, force) in self.contact_in(joints, motions).lines.iter().zip(self.forces(force)) {
            let force = carrier.arm(line.direction) * force;
            put(self.members[0].link, -force, carrier.point(line.feet[0]));
            put(self.members[1].link, force, carrier.point(line.feet[1]));
        }
    }
}

impl TransmissionDesign {
    /// This transmission with renumbered links and joints.
    #[must_use]
    pub fn renumbered(&self, link: impl Fn(LinkId) -> LinkId, joint: impl FnOnce(JointId) -> JointId) -> Self {
        let (links, carrier) = (self.links.map(&link), link(self.carrier));
        TransmissionDesign { links, carrier, joint: joint(self.joint), ..self.clone() }
    }

    /// This transmission with its ratio, or the lift of its cam, multiplied by `factor`.
    /// `None` for a rack, whose ratio follows from the distance of the pinion's axle from the guide.
    #[must_use]
    pub fn times_ratio(&self, factor: f64) -> Option<Self> {
        let kind = match self.kind {
            TransmissionKind::Gears { teeth: [first, second], pressure_angle } => {
                TransmissionKind::Gears { teeth: [first * factor, second], pressure_angle }
            }
            TransmissionKind::Belt { radii: [first, second], crossed, slack } => {
                TransmissionKind::Belt { radii: [first * factor, second], crossed, slack }
            }
            TransmissionKind::Cam { ref law, contact } => TransmissionKind::Cam { law: law.times(factor), contact },
            TransmissionKind::Screw { lead } => TransmissionKind::Screw { lead: lead * factor },
            TransmissionKind::Rack { .. } => return None,
        };
        Some(TransmissionDesign { kind, ..self.clone() })
    }

    /// This transmission with its pressure angle replaced by `pressure_angle` (rad); `None` for a screw, belt or cam.
    #[must_use]
    pub fn with_pressure_angle(&self, pressure_angle: f64) -> Option<Self> {
        let kind = match self.kind {
            TransmissionKind::Gears { teeth, .. } => TransmissionKind::Gears { teeth, pressure_angle },
            TransmissionKind::Rack { .. } => TransmissionKind::Rack { pressure_angle },
            TransmissionKind::Screw { .. } | TransmissionKind::Belt { .. } | TransmissionKind::Cam { .. } => {
                return None;
            }
        };
        Some(TransmissionDesign { kind, ..self.clone() })
    }

    /// Pressure angle (rad); `None` for a screw, belt or cam.
    #[must_use]
    pub fn pressure_angle(&self) -> Option<f64> {
        match self.kind {
            TransmissionKind::Gears { pressure_angle, .. } | TransmissionKind::Rack { pressure_angle } => {
                Some(pressure_angle)
            }
            TransmissionKind::Screw { .. } | TransmissionKind::Belt { .. } | TransmissionKind::Cam { .. } => None,
        }
    }

    fn fault(&self, message: impl Into<String>, help: &str) -> Error {
        Error::new(ErrorKind::Input, message).key(format!("transmissions.{}", self.name)).help(help)
    }
}

#[cfg(test)]
mod tests;
