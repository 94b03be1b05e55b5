//! What a channel belongs to.

/// What a channel belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Subject {
    /// A link; positions are those of its mass centre.
    Link,
    /// A named point.
    Point,
    /// A joint.
    Joint,
    /// A prismatic joint: the additional rows besides those of any joint.
    Slider,
    /// The frame. All joints with the ground and the drive act on it.
    Frame,
    /// The drive.
    Drive,
    /// A further drive, named after its joint.
    Motor,
}

impl Subject {
    /// Whether a mechanism has exactly one of it, so that it needs no name.
    #[must_use]
    pub fn is_whole(self) -> bool {
        match self {
            Subject::Frame | Subject::Drive => true,
            Subject::Link | Subject::Point | Subject::Joint | Subject::Slider | Subject::Motor => false,
        }
    }

    /// Whether it is what a drive exerts.
    #[must_use]
    pub fn is_drive(self) -> bool {
        match self {
            Subject::Drive | Subject::Motor => true,
            Subject::Link | Subject::Point | Subject::Joint | Subject::Slider | Subject::Frame => false,
        }
    }

    /// First word of the channel names.
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
