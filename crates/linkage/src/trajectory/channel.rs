//! The one table of channels: what a trajectory can hold, in which unit, and what must be computed for it.

use std::fmt;

/// What a channel belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Subject {
    /// A link; positions are those of its mass centre.
    Link,
    /// A named point.
    Point,
    /// A joint.
    Joint,
    /// A prismatic joint: what it has besides the rows of any joint.
    Slider,
    /// The frame, on which all joints with the ground and the drive act.
    Frame,
    /// The drive.
    Drive,
    /// A further drive, called by its joint.
    Motor,
}

impl Subject {
    /// Whether there is one of it in a mechanism, so that it needs no name.
    #[must_use]
    pub fn is_whole(self) -> bool {
        matches!(self, Subject::Frame | Subject::Drive)
    }

    /// Word that channel names start with.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Subject::Link => "link",
            Subject::Point => "point",
            Subject::Joint | Subject::Slider => "joint",
            Subject::Frame => "frame",
            Subject::Drive | Subject::Motor => "drive",
        }
    }
}

/// How far a solver must go for a channel; each stage needs the ones before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Positions and angles.
    Positions,
    /// Velocities and angular velocities.
    Velocities,
    /// Accelerations and angular accelerations.
    Accelerations,
    /// Joint reactions.
    Reactions,
    /// Balancing moment on the driving link.
    BalancingMoment,
}

impl Stage {
    /// All stages, in order.
    pub const ALL: [Stage; 5] =
        [Stage::Positions, Stage::Velocities, Stage::Accelerations, Stage::Reactions, Stage::BalancingMoment];

    /// Name of the stage in scenario files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Stage::Positions => "positions",
            Stage::Velocities => "velocities",
            Stage::Accelerations => "accelerations",
            Stage::Reactions => "reactions",
            Stage::BalancingMoment => "balancing_moment",
        }
    }
}

/// One row of the table of channels.
#[derive(Debug, PartialEq)]
pub struct ChannelKind {
    /// What it belongs to.
    pub subject: Subject,
    /// Last part of the channel's name, unit included.
    pub suffix: &'static str,
    /// Plain words for people.
    pub quantity: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Whether values one turn apart are the same pose.
    pub periodic: bool,
    /// What must be computed for it.
    pub stage: Stage,
}

const fn row(
    subject: Subject,
    suffix: &'static str,
    quantity: &'static str,
    unit: &'static str,
    stage: Stage,
) -> ChannelKind {
    ChannelKind { subject, suffix, quantity, unit, periodic: false, stage }
}

/// Every channel there is, in the order of columns. All vectors are in world axes; angles count counter-clockwise
/// from world +x and keep their turns; a joint's force is that of its first link on its second; a prismatic joint's slide is the
/// way along its axis from the place on its first link to that on its second, its moment that of the first link on the
/// second about the place on the second; what acts on the frame is the sum over its joints and the drive, its
/// moment about the origin; the drive's torque acts on the driving link. Moments are counter-clockwise positive.
pub static CHANNELS: [ChannelKind; 26] = {
    use Stage::{Accelerations, BalancingMoment, Positions, Reactions, Velocities};
    use Subject::{Drive, Frame, Joint, Link, Motor, Point, Slider};
    [
        ChannelKind { periodic: true, ..row(Link, "angle_rad", "angle", "rad", Positions) },
        row(Link, "omega_rad_s", "angular velocity", "rad/s", Velocities),
        row(Link, "alpha_rad_s2", "angular acceleration", "rad/s^2", Accelerations),
        row(Link, "x_m", "mass centre position", "m", Positions),
        row(Link, "y_m", "mass centre position", "m", Positions),
        row(Link, "vx_m_s", "mass centre velocity", "m/s", Velocities),
        row(Link, "vy_m_s", "mass centre velocity", "m/s", Velocities),
        row(Link, "ax_m_s2", "mass centre acceleration", "m/s^2", Accelerations),
        row(Link, "ay_m_s2", "mass centre acceleration", "m/s^2", Accelerations),
        row(Point, "x_m", "point position", "m", Positions),
        row(Point, "y_m", "point position", "m", Positions),
        row(Point, "vx_m_s", "point velocity", "m/s", Velocities),
        row(Point, "vy_m_s", "point velocity", "m/s", Velocities),
        row(Point, "ax_m_s2", "point acceleration", "m/s^2", Accelerations),
        row(Point, "ay_m_s2", "point acceleration", "m/s^2", Accelerations),
        row(Joint, "fx_N", "reaction", "N", Reactions),
        row(Joint, "fy_N", "reaction", "N", Reactions),
        row(Slider, "slide_m", "slide", "m", Positions),
        row(Slider, "slide_speed_m_s", "slide speed", "m/s", Velocities),
        row(Slider, "slide_acceleration_m_s2", "slide acceleration", "m/s^2", Accelerations),
        row(Slider, "moment_N_m", "reaction moment", "N m", Reactions),
        row(Frame, "fx_N", "shaking force", "N", BalancingMoment),
        row(Frame, "fy_N", "shaking force", "N", BalancingMoment),
        row(Frame, "moment_N_m", "shaking moment", "N m", BalancingMoment),
        row(Drive, "torque_N_m", "balancing moment", "N m", BalancingMoment),
        row(Motor, "torque_N_m", "balancing moment", "N m", BalancingMoment),
    ]
};

/// One channel of a trajectory: a row of [`CHANNELS`] for one link, point, joint or drive.
#[derive(Clone, Debug)]
pub struct Channel {
    /// Name of the link, point or joint; empty for the drive.
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

impl fmt::Display for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = self.kind.subject.word();
        if self.of.is_empty() {
            write!(f, "{word}.")?
        } else {
            write!(f, "{word}.{}.", self.of)?
        }
        write!(f, "{}", self.kind.suffix)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for kind in &CHANNELS {
            let of = if kind.subject.is_whole() { "" } else { "A.b" };
            let channel = Channel { of: of.into(), kind };
            assert_eq!(Channel::named(&channel.to_string()), Some(channel));
        }
        assert_eq!(Channel::named("link.crank.speed"), None);
        assert_eq!(Channel::named("link.angle_rad"), None);
    }

    #[test]
    fn names_carry_their_unit() {
        for kind in &CHANNELS {
            let unit = kind.unit.replace("/s^2", "_s2").replace(['/', ' '], "_");
            assert!(kind.suffix.ends_with(&unit), "{} does not end with {unit}", kind.suffix);
        }
    }
}
