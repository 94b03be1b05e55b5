//! Properties that every load has, whatever its kind.

use crate::drive::Course;
use crate::mechanism::{JointSide, LinkId};

/// The sense of rotation of the link for which a moment acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acts {
    /// In every motion of the link.
    Always,
    /// While the link turns counter-clockwise, not at standstill.
    CounterClockwise,
    /// While the link turns clockwise, not at standstill.
    Clockwise,
}

/// The motion on whose sense a load depends.
/// The load's law changes where that motion reverses, so integration stops at that instant.
/// The load need not jump at that instant: see [`Load::jump`](super::Load::jump).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Senses {
    /// The load does not depend on a sense of motion.
    Nothing,
    /// The load depends on the sense of rotation of a link.
    Link(LinkId),
    /// The load depends on the direction of motion of a point.
    Point(JointSide),
}

/// Place of action of a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum On {
    /// A moment on a link.
    Link(LinkId),
    /// A force on a point.
    Point(JointSide),
    /// A force between two points: it pulls them together or pushes them apart.
    Points([JointSide; 2]),
    /// A moment between two links: opposite on the second link to that on the first.
    Links([LinkId; 2]),
}

/// Name, place of action and dependencies of a load: see [`Load::nature`](super::Load::nature).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadNature<'a> {
    /// Name of this kind of load in scenario files.
    pub sort: &'static str,
    /// Place of action.
    pub on: On,
    /// Motion on whose sense the load depends.
    pub senses: Senses,
    /// Whether the load depends on the size of speeds, not only on their senses.
    pub is_viscous: bool,
    /// The two links whose [`Setting::twist`](super::LoadState::twist) it depends on.
    pub twist: Option<[LinkId; 2]>,
    /// Quantities that may depend on the crank angle.
    pub courses: &'a [Course],
}

/// Meaning of a number of a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadRole {
    /// The load is proportional to it.
    Amount,
    /// The load is proportional to it; not negative.
    Size,
    /// Value at which the load vanishes, in this unit.
    Rest {
        /// `m` or `rad`.
        unit: &'static str,
    },
}

/// A part of a load, to be read or changed: see [`Load::parts`](super::Load::parts).
#[derive(Debug, PartialEq)]
pub enum LoadPart<'a> {
    /// A link on which the load acts.
    Link(&'a mut LinkId),
    /// A point on which the load acts.
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
    /// Quantities that may depend on the crank angle. The load is proportional to them.
    Courses {
        /// Name of the quantities in output, with their unit.
        name: &'static str,
        /// The quantities, in SI units.
        values: &'a mut [Course],
    },
    /// Sense of rotation for which it acts.
    Acts(&'a mut Acts),
    /// Whether the force's direction turns with the link.
    Follows(&'a mut bool),
}
