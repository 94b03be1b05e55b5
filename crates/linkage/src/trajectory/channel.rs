//! The only table of channels: the quantities that a trajectory can contain, their units, and the stages that they
//! need.

use crate::sentences;
use std::fmt;

use super::reading::{
    ChannelSubject, OfDrive, OfFrame, OfFriction, OfJoint, OfLink, OfPoint, OfSlider, OfTransmission, Reading,
};
use super::unit::Unit;

crate::words! {
    /// The last stage that a solver must compute to obtain a channel. Each stage needs all stages before it.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Stage: name {
        /// Positions and angles.
        Positions = "positions",
        /// Velocities and angular velocities.
        Velocities = "velocities",
        /// Accelerations and angular accelerations.
        Accelerations = "accelerations",
        /// Joint reactions.
        Reactions = "reactions",
        /// Balancing moments on the driving links.
        BalancingMoment = "balancing_moment",
    }
}

/// One row of the table of channels.
#[derive(Debug, PartialEq)]
pub struct ChannelKind {
    /// The subject of `reading`.
    pub subject: ChannelSubject,
    /// The quantity of the state that this row of the table contains.
    pub reading: Reading,
    /// Last part of the channel's name, unit included.
    pub suffix: &'static str,
    /// The quantity in plain words.
    pub quantity: &'static str,
    /// SI unit.
    pub unit: Unit,
    /// Whether values that differ by one revolution mean the same pose.
    pub periodic: bool,
    /// The stage that the channel needs.
    pub stage: Stage,
}

impl ChannelKind {
    /// Index of the row among the rows of its subject.
    pub(crate) fn row(&self) -> usize {
        let own = CHANNELS.iter().filter(|kind| kind.subject == self.subject);
        own.take_while(|kind| kind.suffix != self.suffix).count()
    }
}

const fn row(reading: Reading, suffix: &'static str, quantity: &'static str, unit: Unit, stage: Stage) -> ChannelKind {
    ChannelKind { subject: reading.subject(), reading, suffix, quantity, unit, periodic: false, stage }
}

/// All channels, in the order of columns. Vectors are in world axes.
/// Angles are counter-clockwise from world +x and count whole turns. Moments are counter-clockwise positive.
/// The force of a joint is the force of its first link on its second link.
/// The slide of a prismatic joint is the distance along its axis, from its point on the first link to its point on the
/// second link.
/// The moment of a prismatic joint acts from the first link on the second, about the joint's point on the second link.
/// The friction of a joint acts on its second link. The reaction of the joint does not include this friction.
/// The force of a transmission acts on its second member along its first line of action.
/// A negative force acts along its second line.
/// The force on the frame is the sum of all forces on it: of joints, drives, transmissions and loads. The moment on the
/// frame is about the origin.
/// The torque of a drive acts on the driving link. At a joint between moving links, the torque acts from the joint's
/// first link on its second link.
/// The force of a drive acts along the axis of its prismatic joint from the first link on the second link.
/// The force is positive if it increases the slide. The reaction of the joint does not include this force.
pub static CHANNELS: [ChannelKind; 31] = TABLE;

const TABLE: [ChannelKind; 31] = {
    use OfPoint::{AccelerationX, AccelerationY, VelocityX, VelocityY, X, Y};
    use Reading::{
        Drive, Frame, FurtherThrust, Guide, Joint, Journal, Link, Motor, Point, Slider, Thrust, Transmission,
    };
    use Stage::{Accelerations, BalancingMoment, Positions, Reactions, Velocities};
    use Unit::{Metre, MetrePerSecond, MetrePerSecondSquared, Newton, NewtonMetre};
    use Unit::{Radian, RadianPerSecond, RadianPerSecondSquared};
    const fn centre(of: OfPoint) -> Reading {
        Link(OfLink::Centre(of))
    }
    [
        ChannelKind { periodic: true, ..row(Link(OfLink::Angle), "angle_rad", "angle", Radian, Positions) },
        row(Link(OfLink::Omega), "omega_rad_s", "angular velocity", RadianPerSecond, Velocities),
        row(Link(OfLink::Alpha), "alpha_rad_s2", "angular acceleration", RadianPerSecondSquared, Accelerations),
        row(centre(X), "x_m", sentences::MASS_CENTRE_POSITION, Metre, Positions),
        row(centre(Y), "y_m", sentences::MASS_CENTRE_POSITION, Metre, Positions),
        row(centre(VelocityX), "vx_m_s", sentences::MASS_CENTRE_VELOCITY, MetrePerSecond, Velocities),
        row(centre(VelocityY), "vy_m_s", sentences::MASS_CENTRE_VELOCITY, MetrePerSecond, Velocities),
        row(
            centre(AccelerationX),
            "ax_m_s2",
            sentences::MASS_CENTRE_ACCELERATION,
            MetrePerSecondSquared,
            Accelerations,
        ),
        row(
            centre(AccelerationY),
            "ay_m_s2",
            sentences::MASS_CENTRE_ACCELERATION,
            MetrePerSecondSquared,
            Accelerations,
        ),
        row(Point(X), "x_m", "point position", Metre, Positions),
        row(Point(Y), "y_m", "point position", Metre, Positions),
        row(Point(VelocityX), "vx_m_s", "point velocity", MetrePerSecond, Velocities),
        row(Point(VelocityY), "vy_m_s", "point velocity", MetrePerSecond, Velocities),
        row(Point(AccelerationX), "ax_m_s2", "point acceleration", MetrePerSecondSquared, Accelerations),
        row(Point(AccelerationY), "ay_m_s2", "point acceleration", MetrePerSecondSquared, Accelerations),
        row(Joint(OfJoint::ForceX), "fx_N", "reaction", Newton, Reactions),
        row(Joint(OfJoint::ForceY), "fy_N", "reaction", Newton, Reactions),
        row(Slider(OfSlider::Slide), "slide_m", "slide", Metre, Positions),
        row(Slider(OfSlider::Speed), "slide_speed_m_s", "slide speed", MetrePerSecond, Velocities),
        row(
            Slider(OfSlider::Acceleration),
            "slide_acceleration_m_s2",
            "slide acceleration",
            MetrePerSecondSquared,
            Accelerations,
        ),
        row(Slider(OfSlider::Moment), "moment_N_m", "reaction moment", NewtonMetre, Reactions),
        row(Journal(OfFriction::Effort), "friction_N_m", "friction moment", NewtonMetre, Reactions),
        row(Guide(OfFriction::Effort), "friction_N", "friction force", Newton, Reactions),
        row(Transmission(OfTransmission::Force), "force_N", "force along the line of action", Newton, Reactions),
        row(Frame(OfFrame::ForceX), "fx_N", "shaking force", Newton, BalancingMoment),
        row(Frame(OfFrame::ForceY), "fy_N", "shaking force", Newton, BalancingMoment),
        row(Frame(OfFrame::Moment), "moment_N_m", "shaking moment", NewtonMetre, BalancingMoment),
        row(Drive(OfDrive::Effort), "torque_N_m", "balancing moment", NewtonMetre, BalancingMoment),
        row(Motor(OfDrive::Effort), "torque_N_m", "balancing moment", NewtonMetre, BalancingMoment),
        row(Thrust(OfDrive::Effort), "force_N", "driving force", Newton, BalancingMoment),
        row(FurtherThrust(OfDrive::Effort), "force_N", "driving force", Newton, BalancingMoment),
    ]
};

/// Number of rows of the table that belong to a subject.
const fn count(subject: ChannelSubject) -> usize {
    let (mut rows, mut index) = (0, 0);
    while index < TABLE.len() {
        rows += (TABLE[index].subject as usize == subject as usize) as usize;
        index += 1;
    }
    rows
}

/// The readings of one subject with their stages, in the order of columns.
/// `$any` is an arbitrary reading that initialises the array. All entries are then overwritten.
macro_rules! rows_of {
    ($subject:ident, $of:ty, $any:expr) => {{
        let mut rows: [($of, Stage); count(ChannelSubject::$subject)] =
            [($any, Stage::Positions); count(ChannelSubject::$subject)];
        let (mut found, mut index) = (0, 0);
        while index < TABLE.len() {
            if let Reading::$subject(of) = TABLE[index].reading {
                rows[found] = (of, TABLE[index].stage);
                found += 1;
            }
            index += 1;
        }
        rows
    }};
}

/// The rows of the table of channels, sorted by subjects. The rows are constants, so code that handles all rows of a
/// subject needs no look-up at run time.
pub(crate) mod rows {
    use super::{
        ChannelSubject, OfDrive, OfFrame, OfFriction, OfJoint, OfLink, OfPoint, OfSlider, OfTransmission, Reading,
        Stage, TABLE, count,
    };

    pub(crate) const LINK: [(OfLink, Stage); count(ChannelSubject::Link)] = rows_of!(Link, OfLink, OfLink::Angle);
    pub(crate) const POINT: [(OfPoint, Stage); count(ChannelSubject::Point)] = rows_of!(Point, OfPoint, OfPoint::X);
    pub(crate) const JOINT: [(OfJoint, Stage); count(ChannelSubject::Joint)] =
        rows_of!(Joint, OfJoint, OfJoint::ForceX);
    pub(crate) const SLIDER: [(OfSlider, Stage); count(ChannelSubject::Slider)] =
        rows_of!(Slider, OfSlider, OfSlider::Slide);
    pub(crate) const JOURNAL: [(OfFriction, Stage); count(ChannelSubject::Journal)] =
        rows_of!(Journal, OfFriction, OfFriction::Effort);
    pub(crate) const GUIDE: [(OfFriction, Stage); count(ChannelSubject::Guide)] =
        rows_of!(Guide, OfFriction, OfFriction::Effort);
    pub(crate) const TRANSMISSION: [(OfTransmission, Stage); count(ChannelSubject::Transmission)] =
        rows_of!(Transmission, OfTransmission, OfTransmission::Force);
    pub(crate) const FRAME: [(OfFrame, Stage); count(ChannelSubject::Frame)] =
        rows_of!(Frame, OfFrame, OfFrame::ForceX);
    pub(crate) const DRIVE: [(OfDrive, Stage); count(ChannelSubject::Drive)] =
        rows_of!(Drive, OfDrive, OfDrive::Effort);
    pub(crate) const MOTOR: [(OfDrive, Stage); count(ChannelSubject::Motor)] =
        rows_of!(Motor, OfDrive, OfDrive::Effort);
    pub(crate) const THRUST: [(OfDrive, Stage); count(ChannelSubject::Thrust)] =
        rows_of!(Thrust, OfDrive, OfDrive::Effort);
    pub(crate) const FURTHER_THRUST: [(OfDrive, Stage); count(ChannelSubject::FurtherThrust)] =
        rows_of!(FurtherThrust, OfDrive, OfDrive::Effort);
}

/// One channel of a trajectory: a row of [`CHANNELS`] for one subject, such as a link, a joint or the frame.
#[derive(Clone, Debug)]
pub struct Channel {
    /// Name of the subject; empty for the frame and the first drive. For any other drive, the name of its joint.
    pub of: String,
    /// Row of the table.
    pub kind: &'static ChannelKind,
}

impl PartialEq for Channel {
    fn eq(&self, other: &Self) -> bool {
        self.of == other.of && std::ptr::eq(self.kind, other.kind)
    }
}

impl Channel {
    /// Subject of the channel, as the start of its name: `link.crank`, `joint.A`, `drive`.
    #[must_use]
    pub fn subject(&self) -> String {
        let word = self.kind.subject.word();
        if self.of.is_empty() { word.into() } else { format!("{word}.{}", self.of) }
    }

    /// Rate of change of the channel, if the rate is also a channel: angular velocity of an angle, acceleration of a
    /// velocity.
    #[must_use]
    pub fn rate(&self) -> Option<Channel> {
        let reading = self.kind.reading.rate()?;
        let kind = CHANNELS.iter().find(|kind| kind.reading == reading)?;
        Some(Channel { of: self.of.clone(), kind })
    }

    /// Channel called `name`, for example `link.crank.angle_rad`, `joint.A.fx_N` or `drive.torque_N_m`.
    #[must_use]
    pub fn named(name: &str) -> Option<Channel> {
        CHANNELS.iter().find_map(|kind| {
            let rest = name.strip_prefix(kind.subject.word())?.strip_suffix(kind.suffix)?;
            let of = match kind.subject.is_whole() {
                true => (rest == ".").then_some("")?,
                false => rest.strip_prefix('.')?.strip_suffix('.')?,
            };
            Some(Channel { of: of.to_string(), kind })
        })
    }
}

impl Channel {
    /// The name without its unit, for tables with a column of units: `link.rocker.angle`.
    #[must_use]
    pub fn without_unit(&self) -> String {
        let name = self.to_string();
        let unit = format!("_{}", self.kind.unit.suffix());
        name.strip_suffix(&unit).map_or_else(|| name.clone(), String::from)
    }
}

impl fmt::Display for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.subject(), self.kind.suffix)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channel_names_parse_as_they_print() {
        for kind in &CHANNELS {
            let of = if kind.subject.is_whole() { "" } else { "A.b" };
            let channel = Channel { of: of.into(), kind };
            assert_eq!(Channel::named(&channel.to_string()), Some(channel));
        }
        assert_eq!(Channel::named("link.crank.speed"), None);
        assert_eq!(Channel::named("link.angle_rad"), None);
    }

    #[test]
    fn rates_are_channels_of_the_next_stage() {
        for kind in &CHANNELS {
            let rate = Channel { of: "A".into(), kind }.rate();
            assert_eq!(rate.is_some(), kind.stage < Stage::Accelerations, "{}", kind.suffix);
            let Some(rate) = rate else { continue };
            assert_eq!(rate.kind.stage as usize, kind.stage as usize + 1);
            assert_eq!(
                rate.kind.unit.symbol().trim_end_matches("^2"),
                kind.unit.symbol().to_string() + { if kind.stage == Stage::Positions { "/s" } else { "" } }
            );
        }
    }

    #[test]
    fn names_carry_their_unit() {
        for kind in &CHANNELS {
            let unit = kind.unit.symbol().replace("/s^2", "_s2").replace(['/', ' '], "_");
            assert_eq!(kind.unit.suffix(), unit);
            assert!(kind.suffix.ends_with(&format!("_{unit}")), "{} does not end with {unit}", kind.suffix);
        }
    }
}
