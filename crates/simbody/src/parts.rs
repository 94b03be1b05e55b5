//! The parts of a linkage as plain numbers, and what stops a run.

use std::fmt;

/// Number of the ground; bodies are numbered from 1 in the order in which they were added.
pub const GROUND: usize = 0;

/// How a body hangs on its parent. Places (m) and unit vectors of axes are in the frame of the body they are on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint {
    /// A pin: its coordinate is the angle of the child in its parent (rad).
    Pin {
        /// Place on the parent (m).
        on_parent: [f64; 2],
        /// Place on the child (m).
        on_child: [f64; 2],
    },
    /// A slider: its coordinate is the way of the child's place along the axis, from the parent's place (m).
    Slider {
        /// Place on the parent (m).
        on_parent: [f64; 2],
        /// Place on the child (m).
        on_child: [f64; 2],
        /// Axis in the parent's frame.
        axis_parent: [f64; 2],
        /// The same axis in the child's frame.
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
    /// Mass at the same centre that the body carries for the integrator's sake only (kg): gravity does not act on it, and applied
    /// forces carry it wherever reactions are read. Exact while every freedom is prescribed, since
    /// accelerations do not depend on masses then. Simbody cannot move a free mobilizer with no inertia on it.
    pub extra_mass: f64,
    /// Moment of inertia of the same kind (kg m^2).
    pub extra_inertia: f64,
}

/// A prescribed coordinate: where the body starts plus `rate` times the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// Rate of the coordinate (rad/s or m/s).
    pub rate: f64,
}

/// A body of the tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// The body it hangs on, added before, or [`GROUND`].
    pub parent: usize,
    /// The joint it hangs by.
    pub joint: Joint,
    /// Its inertia.
    pub inertia: Inertia,
    /// Moment of constant size against its rotation (N m), nothing while it stands.
    pub resistance: f64,
    /// Coordinate of its joint at time 0 (rad or m).
    pub coordinate: f64,
    /// Rate of the coordinate at time 0, where it is not prescribed (rad/s or m/s). Rates that do not belong together are projected onto the loops.
    pub rate: f64,
    /// Its prescribed motion, where it has one.
    pub law: Option<Law>,
}

/// A revolute joint between two bodies that are in the tree already: it closes a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closing {
    /// First and second body.
    pub bodies: [usize; 2],
    /// The joint's place on either (m).
    pub places: [[f64; 2]; 2],
}

/// How exactly to integrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Accuracy of the integrator: bound on its weighted local error.
    pub accuracy: f64,
    /// Largest constraint error that projections leave (m).
    pub tolerance: f64,
    /// Time in which something happens (s): rates of constraint errors are held to `tolerance` divided by it.
    pub time_scale: f64,
    /// Internal steps allowed in a time scale, or between two instants nearer than that: before a dead point the integrator would creep on
    /// for hours.
    pub steps: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { accuracy: 1e-10, tolerance: 1e-12, time_scale: 0.1, steps: 30_000 }
    }
}

/// What kept Simbody from going on.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// What was wrong with the model, or Simbody's own words.
    pub message: String,
    /// Time that was reached (s), where there was a run.
    pub time: Option<f64>,
    /// Gap of every loop there (m).
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
