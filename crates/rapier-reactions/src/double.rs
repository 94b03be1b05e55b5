//! Reactions of worlds of `rapier2d-f64`.

pub(super) use rapier2d_f64 as rapier;

/// The engine's floating-point type.
type Real = f64;

/// Rotation of the fastest body in the tiny step of a probe (rad).
const TURN: f64 = 1e-4;

/// Relative change of forces at which the sweeps of a probe end.
const TOLERANCE: f64 = 1e-8;

/// Converts a number for the engine.
fn real(value: f64) -> Real {
    value
}

/// Converts a number from the engine.
fn wide(value: Real) -> f64 {
    value
}

#[path = "engine/snapshot.rs"]
mod snapshot;

#[path = "engine/impulses.rs"]
mod impulses;

#[path = "engine/probe.rs"]
mod probe;

#[path = "engine/window.rs"]
mod window;

pub use impulses::{ImpulseReader, motor_effort, substep};
pub use probe::Probing;
pub use snapshot::{JointHandle, JointReaction, WorldRef, extrapolated};
pub use window::{BalancedReactions, PoseWindow};
