//! What can be asked of every load, whatever its sort.

use crate::drive::Course;
use crate::mechanism::{JointSide, LinkId};

/// The sense of rotation of the link for which a moment acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acts {
    /// For every motion of the link.
    Always,
    /// While the link turns counter-clockwise, not at standstill.
    CounterClockwise,
    /// While the link turns clockwise, not at standstill.
    Clockwise,
}

/// The motion whose sense a load depends on. Its law changes where that motion reverses, so that nobody integrates over
/// such an instant. It need not jump there: see [`Load::jump`](super::Load::jump).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Senses {
    /// The load does not depend on a sense of motion.
    Nothing,
    /// On the sense of rotation of a link.
    Link(LinkId),
    /// On the sense of motion of a point.
    Point(JointSide),
}

/// Where a load acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum On {
    /// A moment on a link.
    Link(LinkId),
    /// A force on a point.
    Point(JointSide),
    /// A force between two points: it pulls them together or pushes them apart.
    Points([JointSide; 2]),
    /// A moment between two links: on the second one the opposite of that on the first.
    Links([LinkId; 2]),
}

/// What a load is called, where it acts, and the quantities it depends on: see [`Load::nature`](super::Load::nature).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadNature<'a> {
    /// Name of its sort in scenario files.
    pub sort: &'static str,
    /// Where it acts.
    pub on: On,
    /// The motion whose sense it depends on.
    pub senses: Senses,
    /// Whether it depends on the size of speeds, not only on their senses.
    pub is_viscous: bool,
    /// The two links whose [`Setting::twist`](super::LoadState::twist) it depends on.
    pub twist: Option<[LinkId; 2]>,
    /// Its quantities that may depend on the crank angle.
    pub courses: &'a [Course],
}

/// What a number of a load means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadRole {
    /// The load is proportional to it.
    Amount,
    /// The load is proportional to it, and it must not be negative.
    Size,
    /// Where the load vanishes, in this unit.
    Rest {
        /// m or rad.
        unit: &'static str,
    },
}

/// A part of a load, to be read or changed: see [`Load::parts`](super::Load::parts).
#[derive(Debug, PartialEq)]
pub enum LoadPart<'a> {
    /// A link that it acts on.
    Link(&'a mut LinkId),
    /// A point that it acts on.
    Point(&'a mut JointSide),
    /// A number.
    Number {
        /// What it means.
        role: LoadRole,
        /// Its name in output, with its unit.
        name: &'static str,
        /// The number, in SI units.
        value: &'a mut f64,
    },
    /// Quantities that may depend on the crank angle. The load is proportional to them.
    Courses {
        /// Their name in output, with their unit.
        name: &'static str,
        /// The quantities, in SI units.
        values: &'a mut [Course],
    },
    /// When it acts.
    Acts(&'a mut Acts),
    /// Whether its direction turns with its link.
    Follows(&'a mut bool),
}
