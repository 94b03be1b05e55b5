//! Properties that all kinds of load have in common.

use crate::drive::Course;
use crate::mechanism::{JointId, JointSide, LinkId};

/// When a load acts: always, or only in one sense of a motion. For a spring: on one side of its unloaded state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acts {
    /// The load always acts, also at standstill.
    Always,
    /// The load acts while the rate or deflection is positive (counter-clockwise, or an increasing slide), not at zero.
    CounterClockwise,
    /// The load acts while the rate or deflection is negative (clockwise, or a decreasing slide), not at zero.
    Clockwise,
}

impl Acts {
    /// Whether the load acts at this rate. For a spring, the argument is the deflection from the unloaded state.
    /// At zero, a load that is limited to one sense does not act.
    #[inline]
    #[must_use]
    pub fn has(self, rate: f64) -> bool {
        match self {
            Acts::Always => true,
            Acts::CounterClockwise => rate > 0.0,
            Acts::Clockwise => rate < 0.0,
        }
    }
}

/// The motion whose sense a load depends on.
/// The law of the load changes when this motion reverses, so integration stops at the instant of reversal.
/// At this instant the load may have a jump or only a kink: see [`Load::jump`](super::Load::jump).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Senses {
    /// The load does not depend on a sense of motion.
    Nothing,
    /// The load depends on the sense of rotation of a link.
    Link(LinkId),
    /// The load depends on the direction of motion of a point.
    Point(JointSide),
    /// The load depends on the sense in which a joint turns or slides.
    Joint(JointId),
}

/// Points, links or joint on which a load acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum On {
    /// A moment on a link.
    Link(LinkId),
    /// A force on a point.
    Point(JointSide),
    /// A force between two points. The force pulls the points together or pushes them apart.
    Points([JointSide; 2]),
    /// A moment between two links. The moments on the two links are opposite.
    Links([LinkId; 2]),
    /// A force along the axis of a joint between two links, or the friction of this joint.
    Joint(JointId, [LinkId; 2]),
}

/// Name, point or link of action, and dependencies of a load: see [`Load::nature`](super::Load::nature).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadNature<'a> {
    /// Name of this kind of load in scenario files.
    pub sort: &'static str,
    /// Place of action.
    pub on: On,
    /// Motion whose sense the load depends on.
    pub senses: Senses,
    /// Whether the load depends on the magnitudes of speeds, and not only on their signs.
    pub is_viscous: bool,
    /// The two links between which the load measures the twist: see [`LoadState::twist`](super::LoadState::twist).
    pub twist: Option<[LinkId; 2]>,
    /// Quantities that may depend on the crank angle.
    pub courses: &'a [Course],
}

/// Meaning of a number of a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadRole {
    /// The load is proportional to the number.
    Amount,
    /// The load is proportional to the number, which must not be negative.
    Size,
    /// The number is a length of the joint (m), which must not be negative.
    Extent,
    /// The number is the free length (m), free slide (m) or free angle (rad). At this value the load is zero.
    Rest {
        /// Unit of the number: `m` or `rad`.
        unit: &'static str,
    },
}

/// A part of a load, for reading or changing: see [`Load::parts`](super::Load::parts).
#[derive(Debug, PartialEq)]
pub enum LoadPart<'a> {
    /// A link on which the load acts.
    Link(&'a mut LinkId),
    /// A point at which the load acts.
    Point(&'a mut JointSide),
    /// A number.
    Number {
        /// Meaning of the number.
        role: LoadRole,
        /// Name of the number in output, with its unit.
        name: &'static str,
        /// The number, in SI units.
        value: &'a mut f64,
    },
    /// Quantities that may depend on the crank angle. The load is proportional to these quantities.
    Courses {
        /// Name of the quantities in output, with their unit.
        name: &'static str,
        /// The quantities, in SI units.
        values: &'a mut [Course],
    },
    /// When the load acts.
    Acts(&'a mut Acts),
    /// Whether the force's direction turns with the link.
    Follows(&'a mut bool),
}
