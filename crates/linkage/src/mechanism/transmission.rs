//! Transmissions: gear pairs, racks and belts that couple the coordinates of two members of one carrier.
//!
//! A member turns about an axle of the carrier, or slides in a guide of the carrier.
//! Both members touch along a line of action, which is fixed in the carrier.
//! The line has the unit vector w, and a foot on each member.
//! Along the line both members have the same speed:
//!
//!     w . (v2 - v1) = 0 at the feet.
//!
//! With the coordinates of the members this is c1 q1' + c2 q2' = 0, or with the angles of the links
//! c1 theta1' + c2 theta2' + c0 theta0' = 0, where 0 is the carrier. Integrated, it couples the coordinates themselves.
//! The force on the second member is f w at its foot, the force on the first member -f w at its foot.
//! There are two lines, one for each sense of the transmitted moment: the two flanks of a tooth, or the two strands of a
//! belt. Teeth push and strands pull, so f >= 0 with w chosen accordingly.
//! A gear pair with the pressure angle alpha is a crossed strand that pushes, between the base circles r cos(alpha):
//! Niemann and Winter, Maschinenelemente, vol. 2, 2nd ed., Springer 2003, chapter 21.1.

use super::ids::{JointId, LinkId, PerJoint, PerLink};
use super::parts::{GROUND, Joint, Link};
use crate::error::{Error, ErrorKind, Result};
use crate::math::{Motion, Vec2, cross, turned};
use crate::sentences;

/// Kind of transmission.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TransmissionKind {
    /// Two gears with the pressure angle (rad). The pitch radii follow from the distance of the axles.
    Gears {
        /// Numbers of teeth; a negative number is that of a ring gear. Only their ratio matters.
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
    /// A belt or chain over two wheels.
    Belt {
        /// Pitch radii (m).
        radii: [f64; 2],
        /// Whether the strands cross, so that the wheels turn in opposite senses.
        crossed: bool,
        /// Tension of the slack strand (N), not negative; 0 for a chain.
        slack: f64,
    },
}

impl TransmissionKind {
    /// Name, as in scenario files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            TransmissionKind::Gears { .. } => "gears",
            TransmissionKind::Rack { .. } => "rack",
            TransmissionKind::Belt { .. } => "belt",
        }
    }
}

/// Statement of a transmission, from which [`Transmission::of`] finds the geometry.
#[derive(Clone, Debug, PartialEq)]
pub struct TransmissionDesign {
    /// Name, unique among the transmissions.
    pub name: String,
    /// Kind, with its numbers.
    pub kind: TransmissionKind,
    /// First and second member.
    pub links: [LinkId; 2],
    /// The link that carries both axles, or the axle and the guide.
    pub carrier: LinkId,
    /// The joint whose coordinate at t = 0 fixes the phase.
    pub joint: JointId,
    /// That coordinate: the angle of the joint's second link minus that of its first link (rad), or the slide (m).
    pub start: f64,
}

/// A transmission between two members of a carrier.
#[derive(Clone, Debug, PartialEq)]
pub struct Transmission {
    /// The statement.
    pub design: TransmissionDesign,
    /// First and second member.
    pub members: [Member; 2],
    /// The lines of action. The first one carries positive forces.
    pub lines: [LineOfAction; 2],
    /// Speeds of the feet along the first line for unit rates of the members relative to the carrier (m, or 1 for a
    /// rack): that of the second minus that of the first.
    pub factors: [f64; 2],
    /// The coupled coordinates of moving links and their factors: the sum of factor times rate is 0.
    pub terms: Vec<(Coordinate, f64)>,
}

/// A coordinate of a mechanism that a transmission couples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// Angle of a link (rad).
    Angle(LinkId),
    /// Slide of a prismatic joint (m).
    Slide(JointId),
}

impl Coordinate {
    /// The joint of a slide.
    #[must_use]
    pub fn joint(self) -> Option<JointId> {
        match self {
            Coordinate::Angle(_) => None,
            Coordinate::Slide(joint) => Some(joint),
        }
    }
}

/// A member of a transmission.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// The link.
    pub link: LinkId,
    /// Axle of a wheel in the frame of the carrier (m); for a rack, the foot of the pinion's axle on the pitch line.
    pub place: Vec2,
    /// Pitch radius (m); 0 for a rack.
    pub radius: f64,
    /// The axle of a wheel in the frame of the link (m); for a rack, the joint's point on the link.
    pub local: Vec2,
}

/// A line along which a transmission exerts its force, in the frame of the carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineOfAction {
    /// Unit vector of a positive force on the second member.
    pub direction: Vec2,
    /// Points of the line at which the force acts on the first and on the second member.
    pub feet: [Vec2; 2],
}

/// Distance of two axles, as a fraction of the mechanism's size, below which they coincide.
const COINCIDE: f64 = 1e-9;

impl Transmission {
    /// Finds the geometry of a transmission between these links and joints; `size` is the size of the mechanism (m).
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if a member has no axle or guide on the carrier, or if the numbers allow no contact.
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
        let ([one, other], lines, slide) = match design.kind {
            TransmissionKind::Rack { pressure_angle } => {
                let (joint, guide) = guide(joints, second, carrier)
                    .ok_or_else(|| design.fault(sentences::THE_RACK_DOES_NOT_SLIDE, sentences::JOIN_THE_RACK))?;
                let (members, lines) = rack(one, guide, second, pressure_angle);
                (members, lines, Some(joint))
            }
            TransmissionKind::Gears { teeth, pressure_angle } => {
                let [place, local] = axle(second)?;
                let (members, lines) =
                    gears([one, Member { link: second, place, radius: 0.0, local }], teeth, pressure_angle);
                (members, lines, None)
            }
            TransmissionKind::Belt { radii, crossed, slack: _ } => {
                let [place, local] = axle(second)?;
                let (members, lines) = belt([one, Member { link: second, place, radius: 0.0, local }], radii, crossed);
                (members, lines, None)
            }
        };
        let members = [one, other];
        let is_sound =
            |line: &LineOfAction| line.direction.iter().chain(line.feet.iter().flatten()).all(|x| x.is_finite());
        let has_room = (one.place - other.place).norm() > COINCIDE * size;
        if !(has_room && lines.iter().all(is_sound)) {
            return Err(design.fault(sentences::THE_MEMBERS_CANNOT_TOUCH, sentences::MOVE_THE_AXLES_APART));
        }
        let lever = |member: usize| cross(lines[0].feet[member] - members[member].place, lines[0].direction);
        let (factors, coupled) = match slide {
            None => ([-lever(0), lever(1)], Coordinate::Angle(second)),
            Some(joint) => {
                let found = &joints[joint];
                let axis = found.axis_on(carrier).expect("the rack slides in the carrier");
                let sign = if found.second.link == second { 1.0 } else { -1.0 };
                ([-lever(0), sign * axis.dot(&lines[0].direction)], Coordinate::Slide(joint))
            }
        };
        let of_carrier = if slide.is_some() { -factors[0] } else { -factors[0] - factors[1] };
        let mut terms = vec![
            (Coordinate::Angle(first), factors[0]),
            (coupled, factors[1]),
            (Coordinate::Angle(carrier), of_carrier),
        ];
        terms.retain(|(of, _)| *of != Coordinate::Angle(GROUND));
        Ok(Transmission { design, members, lines, factors, terms })
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

    /// Ratio of the members' rates relative to the carrier, q2' / q1' (1, or m for a rack).
    #[must_use]
    pub fn ratio(&self) -> f64 {
        -self.factors[0] / self.factors[1]
    }

    /// The force (N) in each line of action if the transmission exerts `force` (N): positive in the first line, negative
    /// in the second, each with the tension of a slack strand.
    #[must_use]
    pub fn forces(&self, force: f64) -> [f64; 2] {
        let slack = match self.design.kind {
            TransmissionKind::Belt { slack, .. } => slack,
            TransmissionKind::Gears { .. } | TransmissionKind::Rack { .. } => 0.0,
        };
        // The maximum of 0 and NaN must be NaN.
        let [push, pull] = if force >= 0.0 { [force, 0.0] } else { [0.0, -force] };
        [push + slack, pull + slack]
    }

    /// Calls `put` with the link, the force (N) and the place (m) of every action of the transmission, if it exerts
    /// `force` (N).
    pub fn each_action(&self, force: f64, motions: &[Motion], mut put: impl FnMut(LinkId, Vec2, Vec2)) {
        let carrier = &motions[self.design.carrier];
        for (line, force) in self.lines.iter().zip(self.forces(force)) {
            let force = carrier.arm(line.direction) * force;
            put(self.members[0].link, -force, carrier.point(line.feet[0]));
            put(self.members[1].link, force, carrier.point(line.feet[1]));
        }
    }
}

impl TransmissionDesign {
    /// The same transmission of a mechanism whose links and joints have other numbers.
    #[must_use]
    pub fn renumbered(&self, link: impl Fn(LinkId) -> LinkId, joint: impl FnOnce(JointId) -> JointId) -> Self {
        let (links, carrier) = (self.links.map(&link), link(self.carrier));
        TransmissionDesign { links, carrier, joint: joint(self.joint), ..self.clone() }
    }

    /// The same transmission with its ratio multiplied by `factor`; `None` for a rack, whose ratio is a distance of the
    /// mechanism.
    #[must_use]
    pub fn times_ratio(&self, factor: f64) -> Option<Self> {
        let kind = match self.kind {
            TransmissionKind::Gears { teeth: [first, second], pressure_angle } => {
                TransmissionKind::Gears { teeth: [first * factor, second], pressure_angle }
            }
            TransmissionKind::Belt { radii: [first, second], crossed, slack } => {
                TransmissionKind::Belt { radii: [first * factor, second], crossed, slack }
            }
            TransmissionKind::Rack { .. } => return None,
        };
        Some(TransmissionDesign { kind, ..self.clone() })
    }

    /// The same transmission with another pressure angle (rad); `None` for a belt.
    #[must_use]
    pub fn with_pressure_angle(&self, pressure_angle: f64) -> Option<Self> {
        let kind = match self.kind {
            TransmissionKind::Gears { teeth, .. } => TransmissionKind::Gears { teeth, pressure_angle },
            TransmissionKind::Rack { .. } => TransmissionKind::Rack { pressure_angle },
            TransmissionKind::Belt { .. } => return None,
        };
        Some(TransmissionDesign { kind, ..self.clone() })
    }

    /// Pressure angle (rad); `None` for a belt.
    #[must_use]
    pub fn pressure_angle(&self) -> Option<f64> {
        match self.kind {
            TransmissionKind::Gears { pressure_angle, .. } | TransmissionKind::Rack { pressure_angle } => {
                Some(pressure_angle)
            }
            TransmissionKind::Belt { .. } => None,
        }
    }

    fn fault(&self, message: impl Into<String>, help: &str) -> Error {
        Error::new(ErrorKind::Input, message).key(format!("transmissions.{}", self.name)).help(help)
    }
}

/// Axle of a link in the frame of the carrier and in the frame of the link.
/// The link turns about a joint with the carrier, or with a third link at a joint of the third link with the carrier.
fn axle(joints: &PerJoint<Joint>, size: f64, link: LinkId, carrier: LinkId) -> Option<[Vec2; 2]> {
    let pins = |on: LinkId| joints.iter().filter(move |joint| joint.is_pin() && joint.on(on).is_some());
    let near = COINCIDE * size;
    pins(link).find_map(|pin| {
        let (own, other) = (pin.on(link)?, pin.other(link));
        if other.link == carrier {
            return Some([other.local, own]);
        }
        let coaxial = |next: &&Joint| {
            let on = next.other(carrier);
            on.link == other.link && (on.local - other.local).norm() <= near
        };
        Some([pins(carrier).find(coaxial)?.on(carrier)?, own])
    })
}

/// The prismatic joint of a rack with the carrier, and its line: a point and the axis in the frame of the carrier, and
/// the joint's point on the rack.
fn guide(joints: &PerJoint<Joint>, rack: LinkId, carrier: LinkId) -> Option<(JointId, [Vec2; 3])> {
    joints.entries().find_map(|(index, joint)| {
        let axis = joint.axis_on(carrier)?;
        Some((index, [joint.on(carrier)?, axis, joint.on(rack)?]))
    })
}

/// Gears: the lines of action touch the base circles and pass through the pitch point.
fn gears([mut one, mut other]: [Member; 2], teeth: [f64; 2], angle: f64) -> ([Member; 2], [LineOfAction; 2]) {
    let between = other.place - one.place;
    // Signed pitch radii from the axles to the pitch point, towards the other axle.
    let radii = teeth.map(|own| between.norm() * own / (teeth[0] + teeth[1]));
    let (along, across) = (between.normalize(), turned(between.normalize()));
    [one.radius, other.radius] = radii.map(f64::abs);
    let pitch = one.place + along * radii[0];
    // External teeth push the second member away from the first, the teeth of a ring pull the axles together.
    let apart = if radii[0] > 0.0 && radii[1] > 0.0 { 1.0 } else { -1.0 };
    let line = |side: f64| {
        let direction = across * (side * angle.cos()) + along * (apart * angle.sin());
        LineOfAction { direction, feet: [pitch; 2] }
    };
    ([one, other], [line(1.0), line(-1.0)])
}

/// Pinion and rack: the lines of action pass through the foot of the axle on the pitch line.
fn rack(mut one: Member, [at, axis, local]: [Vec2; 3], link: LinkId, angle: f64) -> ([Member; 2], [LineOfAction; 2]) {
    let foot = at + axis * axis.dot(&(one.place - at));
    one.radius = (foot - one.place).norm();
    let away = (foot - one.place).normalize();
    let line = |side: f64| {
        let direction = axis * (side * angle.cos()) + away * angle.sin();
        LineOfAction { direction, feet: [foot; 2] }
    };
    ([one, Member { link, place: foot, radius: 0.0, local }], [line(1.0), line(-1.0)])
}

/// Belt: the lines of action are the strands, from the second wheel to the first.
fn belt([mut one, mut other]: [Member; 2], radii: [f64; 2], crossed: bool) -> ([Member; 2], [LineOfAction; 2]) {
    [one.radius, other.radius] = radii;
    let between = other.place - one.place;
    let (distance, along) = (between.norm(), between.normalize());
    let of_second = if crossed { -radii[1] } else { radii[1] };
    // Normal of a strand, on the side of the first wheel on which the strand leaves it.
    let sine = (radii[0] - of_second) / distance;
    let line = |side: f64| {
        let normal = along * sine + turned(along) * (side * (1.0 - sine * sine).sqrt());
        let feet = [one.place + normal * radii[0], other.place + normal * of_second];
        LineOfAction { direction: (feet[0] - feet[1]).normalize(), feet }
    };
    ([one, other], [line(1.0), line(-1.0)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{link, mechanism};
    use approx::assert_relative_eq;

    /// Two wheels on a carrier that stands on the ground, 3 m apart.
    fn two_wheels(kind: TransmissionKind) -> Result<Transmission> {
        let links = vec![
            link("ground", &[("O", 0.0, 0.0)]),
            link("carrier", &[("O", 0.0, 0.0), ("P", 3.0, 0.0)]),
            link("first", &[("O", 0.0, 0.0)]),
            link("second", &[("P", 0.0, 0.0)]),
        ];
        let pins = [("H", "O", "ground", "carrier"), ("S", "O", "ground", "first"), ("P", "P", "carrier", "second")];
        let mechanism = mechanism(links, &pins).unwrap();
        let [carrier, first, second] = ["carrier", "first", "second"].map(|name| mechanism.link_named(name).unwrap());
        let links = [first, second];
        let design = TransmissionDesign { name: "t".into(), kind, links, carrier, joint: JointId(2), start: 0.0 };
        Transmission::of(mechanism.links(), mechanism.joints(), mechanism.size(), design)
    }

    fn gears(first: f64, second: f64) -> TransmissionKind {
        TransmissionKind::Gears { teeth: [first, second], pressure_angle: 0.3 }
    }

    fn belt(radii: [f64; 2], crossed: bool) -> TransmissionKind {
        TransmissionKind::Belt { radii, crossed, slack: 0.0 }
    }

    #[test]
    fn ratios_and_radii_follow_from_teeth_and_radii() {
        let cases = [
            (gears(20.0, 40.0), -0.5, [1.0, 2.0]),
            (gears(20.0, -50.0), 0.4, [2.0, 5.0]),
            (gears(-50.0, 20.0), 2.5, [5.0, 2.0]),
            (belt([0.5, 1.0], false), 0.5, [0.5, 1.0]),
            (belt([0.5, 1.0], true), -0.5, [0.5, 1.0]),
        ];
        for (kind, ratio, radii) in cases {
            let own = two_wheels(kind).unwrap();
            assert_relative_eq!(own.ratio(), ratio, epsilon = 1e-14);
            assert_relative_eq!(own.members[0].radius, radii[0], epsilon = 1e-14);
            assert_relative_eq!(own.members[1].radius, radii[1], epsilon = 1e-14);
            // Both lines have the same power, and the second one the opposite sense.
            let lever = |line: &LineOfAction| cross(line.feet[1] - own.members[1].place, line.direction);
            assert_relative_eq!(lever(&own.lines[0]), -lever(&own.lines[1]), epsilon = 1e-14);
            // A rotation of everything as one body moves no foot against the other.
            assert_relative_eq!(own.terms.iter().map(|(_, factor)| factor).sum::<f64>(), 0.0, epsilon = 1e-14);
        }
    }

    /// Teeth of external wheels push the axles apart, those of a ring pull them together, and so do strands.
    #[test]
    fn lines_of_action_push_or_pull_the_second_axle() {
        let along = |kind| two_wheels(kind).unwrap().lines.map(|line| line.direction.x);
        for (kind, away) in [(gears(20.0, 40.0), 1.0), (gears(20.0, -50.0), -1.0), (gears(-50.0, 20.0), -1.0)] {
            for own in along(kind) {
                assert_relative_eq!(own, away * 0.3f64.sin(), epsilon = 1e-14);
            }
        }
        for own in along(belt([0.5, 1.0], true)) {
            assert_relative_eq!(own, -(1.0 - 0.25f64).sqrt(), epsilon = 1e-14);
        }
        let own = two_wheels(belt([0.5, 1.0], false)).unwrap();
        assert_eq!((own.forces(3.0), own.forces(-3.0)), ([3.0, 0.0], [0.0, 3.0]));
        assert!(own.forces(f64::NAN).iter().any(|force| force.is_nan()));
    }

    #[test]
    fn wheels_that_cannot_touch_are_refused() {
        for kind in [gears(20.0, -20.0), belt([2.0, 1.5], true), belt([4.0, 0.5], false)] {
            let error = two_wheels(kind).unwrap_err();
            assert!(error.to_string().contains("cannot touch"), "{error}");
        }
    }
}
