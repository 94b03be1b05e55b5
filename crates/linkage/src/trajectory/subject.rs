//! What a channel belongs to.

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
        match self {
            Subject::Frame | Subject::Drive => true,
            Subject::Link | Subject::Point | Subject::Joint | Subject::Slider | Subject::Motor => false,
        }
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
