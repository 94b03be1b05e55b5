//! Subjects of channels, and the quantities of a state that the table of channels contains.

/// Subject of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ChannelSubject {
    /// A link. The position of a link is the position of its mass centre.
    Link,
    /// A named point.
    Point,
    /// A joint.
    Joint,
    /// A prismatic joint, as the subject of the channels that only prismatic joints have.
    Slider,
    /// A revolute joint with friction.
    Journal,
    /// A prismatic joint with friction.
    Guide,
    /// A transmission.
    Transmission,
    /// The frame. Joints on the ground, drives, transmissions and loads act on the frame.
    Frame,
    /// The first drive, unless it moves a prismatic joint.
    Drive,
    /// A drive other than the first drive, named after its revolute joint.
    Motor,
    /// The first drive, if it moves a prismatic joint.
    Thrust,
    /// A drive other than the first drive, named after its prismatic joint.
    FurtherThrust,
}

impl ChannelSubject {
    /// Whether a mechanism has at most one subject of this kind, so that the subject needs no name.
    #[must_use]
    pub fn is_whole(self) -> bool {
        match self {
            ChannelSubject::Frame | ChannelSubject::Drive | ChannelSubject::Thrust => true,
            ChannelSubject::Link
            | ChannelSubject::Point
            | ChannelSubject::Joint
            | ChannelSubject::Slider
            | ChannelSubject::Journal
            | ChannelSubject::Guide
            | ChannelSubject::Transmission
            | ChannelSubject::Motor
            | ChannelSubject::FurtherThrust => false,
        }
    }

    /// Whether the subject is a drive.
    #[must_use]
    pub fn is_drive(self) -> bool {
        match self {
            ChannelSubject::Drive | ChannelSubject::Motor | ChannelSubject::Thrust | ChannelSubject::FurtherThrust => {
                true
            }
            ChannelSubject::Link
            | ChannelSubject::Point
            | ChannelSubject::Joint
            | ChannelSubject::Slider
            | ChannelSubject::Journal
            | ChannelSubject::Guide
            | ChannelSubject::Transmission
            | ChannelSubject::Frame => false,
        }
    }

    /// First word of the channel names.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            ChannelSubject::Link => "link",
            ChannelSubject::Point => "point",
            ChannelSubject::Joint | ChannelSubject::Slider | ChannelSubject::Journal | ChannelSubject::Guide => "joint",
            ChannelSubject::Transmission => "transmission",
            ChannelSubject::Frame => "frame",
            ChannelSubject::Drive | ChannelSubject::Motor | ChannelSubject::Thrust | ChannelSubject::FurtherThrust => {
                "drive"
            }
        }
    }
}

/// The quantity that a row of the table contains, one variant per subject.
/// The [sampler](crate::solver::Sampler) matches on the variants. If the sampler does not handle a variant, the code
/// does not compile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reading {
    /// A quantity of a link.
    Link(OfLink),
    /// A quantity of a named point.
    Point(OfPoint),
    /// A quantity of any joint.
    Joint(OfJoint),
    /// An additional quantity of a prismatic joint.
    Slider(OfSlider),
    /// The friction of a revolute joint.
    Journal(OfFriction),
    /// The friction of a prismatic joint.
    Guide(OfFriction),
    /// A quantity of a transmission.
    Transmission(OfTransmission),
    /// A quantity of the frame.
    Frame(OfFrame),
    /// A quantity of the first drive, unless it moves a prismatic joint.
    Drive(OfDrive),
    /// A quantity of a drive other than the first, at a revolute joint.
    Motor(OfDrive),
    /// A quantity of the first drive, if it moves a prismatic joint.
    Thrust(OfDrive),
    /// A quantity of a drive other than the first, at a prismatic joint.
    FurtherThrust(OfDrive),
}

impl Reading {
    /// The subject of the quantity.
    #[must_use]
    pub const fn subject(self) -> ChannelSubject {
        match self {
            Reading::Link(_) => ChannelSubject::Link,
            Reading::Point(_) => ChannelSubject::Point,
            Reading::Joint(_) => ChannelSubject::Joint,
            Reading::Slider(_) => ChannelSubject::Slider,
            Reading::Journal(_) => ChannelSubject::Journal,
            Reading::Guide(_) => ChannelSubject::Guide,
            Reading::Transmission(_) => ChannelSubject::Transmission,
            Reading::Frame(_) => ChannelSubject::Frame,
            Reading::Drive(_) => ChannelSubject::Drive,
            Reading::Motor(_) => ChannelSubject::Motor,
            Reading::Thrust(_) => ChannelSubject::Thrust,
            Reading::FurtherThrust(_) => ChannelSubject::FurtherThrust,
        }
    }
}

impl Reading {
    /// Rate of change of the quantity, if the rate is also a quantity of the table.
    #[must_use]
    pub const fn rate(self) -> Option<Reading> {
        const fn of_point(of: OfPoint) -> Option<OfPoint> {
            Some(match of {
                OfPoint::X => OfPoint::VelocityX,
                OfPoint::Y => OfPoint::VelocityY,
                OfPoint::VelocityX => OfPoint::AccelerationX,
                OfPoint::VelocityY => OfPoint::AccelerationY,
                OfPoint::AccelerationX | OfPoint::AccelerationY => return None,
            })
        }
        match self {
            Reading::Link(OfLink::Angle) => Some(Reading::Link(OfLink::Omega)),
            Reading::Link(OfLink::Omega) => Some(Reading::Link(OfLink::Alpha)),
            Reading::Link(OfLink::Centre(of)) => match of_point(of) {
                Some(rate) => Some(Reading::Link(OfLink::Centre(rate))),
                None => None,
            },
            Reading::Point(of) => match of_point(of) {
                Some(rate) => Some(Reading::Point(rate)),
                None => None,
            },
            Reading::Slider(OfSlider::Slide) => Some(Reading::Slider(OfSlider::Speed)),
            Reading::Slider(OfSlider::Speed) => Some(Reading::Slider(OfSlider::Acceleration)),
            Reading::Link(OfLink::Alpha)
            | Reading::Slider(OfSlider::Acceleration | OfSlider::Moment)
            | Reading::Joint(_)
            | Reading::Journal(_)
            | Reading::Guide(_)
            | Reading::Transmission(_)
            | Reading::Frame(_)
            | Reading::Drive(_)
            | Reading::Motor(_)
            | Reading::Thrust(_)
            | Reading::FurtherThrust(_) => None,
        }
    }
}

/// Quantity of a body point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfPoint {
    /// World x coordinate.
    X,
    /// World y coordinate.
    Y,
    /// Velocity along x.
    VelocityX,
    /// Velocity along y.
    VelocityY,
    /// Acceleration along x.
    AccelerationX,
    /// Acceleration along y.
    AccelerationY,
}

/// Quantity of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfLink {
    /// Angle of the link's frame, unwrapped.
    Angle,
    /// Angular velocity.
    Omega,
    /// Angular acceleration.
    Alpha,
    /// A quantity of the link's mass centre.
    Centre(OfPoint),
}

/// Quantity of any joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfJoint {
    /// Force of the first link on the second along x.
    ForceX,
    /// Force of the first link on the second along y.
    ForceY,
}

/// Quantity of a prismatic joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfSlider {
    /// Slide.
    Slide,
    /// Rate of the slide.
    Speed,
    /// Second derivative of the slide.
    Acceleration,
    /// Moment of the first link on the second.
    Moment,
}

/// Quantity of a joint with friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfFriction {
    /// Friction on the second link: a moment in a revolute joint, a force along the axis in a prismatic joint. The
    /// friction is positive if it increases the joint's coordinate.
    Effort,
}

/// Quantity of a transmission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfTransmission {
    /// Force on the second member along the first line of action; a negative force acts along the second line.
    Force,
}

/// Quantity of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfFrame {
    /// Shaking force along x.
    ForceX,
    /// Shaking force along y.
    ForceY,
    /// Shaking moment about the origin.
    Moment,
}

/// Quantity of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfDrive {
    /// Balancing moment on the driving link, or driving force along the axis of a prismatic joint.
    Effort,
}
