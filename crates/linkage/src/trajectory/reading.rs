//! What the rows of the table of channels read of a state.

use super::subject::Subject;

/// What a row of the table reads. One kind of number a variant: the [sampler](crate::solver::Sampler) matches on them, so that a row without a
/// reader does not compile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reading {
    /// Of a link.
    Link(OfLink),
    /// Of a named point.
    Point(OfPoint),
    /// Of any joint.
    Joint(OfJoint),
    /// Of a prismatic joint, besides.
    Slider(OfSlider),
    /// Of the frame.
    Frame(OfFrame),
    /// Of the drive.
    Drive(OfDrive),
    /// Of a further drive.
    Motor(OfDrive),
}

impl Reading {
    /// What it is read of.
    #[must_use]
    pub const fn subject(self) -> Subject {
        match self {
            Reading::Link(_) => Subject::Link,
            Reading::Point(_) => Subject::Point,
            Reading::Joint(_) => Subject::Joint,
            Reading::Slider(_) => Subject::Slider,
            Reading::Frame(_) => Subject::Frame,
            Reading::Drive(_) => Subject::Drive,
            Reading::Motor(_) => Subject::Motor,
        }
    }
}

/// Number that is read of a body point.
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

/// Number that is read of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfLink {
    /// Angle of the link's frame, turns kept.
    Angle,
    /// Angular velocity.
    Omega,
    /// Angular acceleration.
    Alpha,
    /// Of its mass centre.
    Centre(OfPoint),
}

/// Number that is read of any joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfJoint {
    /// Force of the first link on the second along x.
    ForceX,
    /// The same along y.
    ForceY,
}

/// Number that is read of a prismatic joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfSlider {
    /// Slide.
    Slide,
    /// Its rate.
    Speed,
    /// Its second derivative.
    Acceleration,
    /// Moment of the first link on the second.
    Moment,
}

/// Number that is read of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfFrame {
    /// Shaking force along x.
    ForceX,
    /// Shaking force along y.
    ForceY,
    /// Shaking moment about the origin.
    Moment,
}

/// Number that is read of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OfDrive {
    /// Balancing moment on the driving link.
    Torque,
}
