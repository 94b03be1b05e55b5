//! The parts of a linkage as plain numbers, and the failure of a run.

use std::fmt;

/// Number of the ground. Bodies are numbered from 1 in the order in which they were added.
pub const GROUND: usize = 0;

/// The joint between a body and its parent.
/// Positions (m) and unit vectors of axes are in the frame of the body to which they belong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SimbodyJoint {
    /// A revolute joint. The coordinate of the joint is the angle of the child minus the angle of the parent (rad).
    Pin {
        /// Position on the parent (m).
        on_parent: [f64; 2],
        /// Position on the child (m).
        on_child: [f64; 2],
    },
    /// A prismatic joint.
    /// The coordinate of the joint is the distance along the axis from the parent's point to the child's point (m).
    Slider {
        /// Position on the parent (m).
        on_parent: [f64; 2],
        /// Position on the child (m).
        on_child: [f64; 2],
        /// Axis in the parent's frame.
        axis_parent: [f64; 2],
        /// Axis in the child's frame.
        axis_child: [f64; 2],
    },
}

/// Inertia of a body.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Inertia {
    /// Mass (kg).
    pub mass: f64,
    /// Mass centre in the body's frame (m).
    pub centre: [f64; 2],
    /// Moment of inertia about the mass centre (kg m^2).
    pub inertia: f64,
    /// Additional mass at the mass centre, only for the integrator (kg).
    /// Gravity does not act on this mass. When reactions are read, additional forces cancel the inertia forces of this
    /// mass.
    /// The results are exact if every degree of freedom is prescribed, because accelerations then do not depend on
    /// masses.
    /// The mass is needed because Simbody cannot move a free mobilizer without inertia.
    pub extra_mass: f64,
    /// Additional moment of inertia, only for the integrator (kg m^2). The additional moment of inertia is treated like
    /// the additional mass.
    pub extra_inertia: f64,
}

/// A prescribed coordinate. The coordinate is its start value plus `rate` times the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// Rate of the coordinate (rad/s or m/s).
    pub rate: f64,
}

/// A body of the tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimbodyBody {
    /// Number of the parent: a body that was added earlier, or [`GROUND`].
    pub parent: usize,
    /// The joint to the parent.
    pub joint: SimbodyJoint,
    /// Mass and inertia of the body.
    pub inertia: Inertia,
    /// Moment of constant magnitude that opposes the body's rotation (N m). The moment does not act on a body at rest.
    pub resistance: f64,
    /// Coordinate of the body's joint at time 0 (rad or m).
    pub coordinate: f64,
    /// Rate of the coordinate at time 0 (rad/s or m/s). The rate is used only if the coordinate is not prescribed.
    /// Rates that violate the loop constraints are projected onto these constraints.
    pub rate: f64,
    /// Prescribed motion of the coordinate, if any.
    pub law: Option<Law>,
}

/// A revolute joint that closes a loop. The two bodies of this joint are already in the tree. The memory layout is that
/// of C.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopClosure {
    /// First and second body.
    pub bodies: [usize; 2],
    /// Position of the joint on the first and on the second body (m), each in the frame of that body.
    pub places: [[f64; 2]; 2],
}

/// Accuracy of the integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntegrationSettings {
    /// Accuracy of the integrator: bound on its weighted local error.
    pub accuracy: f64,
    /// Largest constraint error that may remain after a projection (m).
    pub tolerance: f64,
    /// Characteristic time of the motion (s). Rates of constraint errors are kept below `tolerance` / `time_scale`.
    pub time_scale: f64,
    /// Number of internal steps allowed per time scale. If two instants are less than a time scale apart, this number
    /// of steps is allowed between the two instants.
    /// Without a limit the integrator would need hours for tiny steps near a dead point.
    pub steps: usize,
}

impl Default for IntegrationSettings {
    fn default() -> Self {
        IntegrationSettings { accuracy: 1e-10, tolerance: 1e-12, time_scale: 0.1, steps: 30_000 }
    }
}

/// A fault of the model, or a failure of Simbody.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The fault of the model, or the message of Simbody.
    pub message: String,
    /// Time reached (s), if a run had started.
    pub time: Option<f64>,
    /// Gap of every loop at the time reached (m).
    pub gaps: Vec<f64>,
}

impl Failure {
    pub(crate) fn of(message: impl Into<String>) -> Self {
        Failure { message: message.into(), time: None, gaps: Vec::new() }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        self.time.map_or(Ok(()), |time| write!(f, " (at t = {time} s)"))
    }
}

impl std::error::Error for Failure {}
