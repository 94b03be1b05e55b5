//! Reactions of worlds of `rapier2d`. Results are f64.

pub(super) use rapier2d as rapier;

/// The engine's floating-point type.
type Real = f32;

/// Rotation of the fastest body in the tiny step of a probe (rad).
const TURN: f64 = 5e-3;

/// Relative change of forces at which the sweeps of a probe end.
const TOLERANCE: f64 = 1e-3;

/// Converts a number for the engine.
fn real(value: f64) -> Real {
    value as f32
}

/// Converts a number from the engine.
fn wide(value: Real) -> f64 {
    f64::from(value)
}

// Rapier has one crate for each precision. Both crates define the same names.
// Code that compiles against one crate therefore also compiles against the other crate.
#[expect(clippy::duplicate_mod, reason = "the same sources against another crate and another number")]
#[path = "engine/snapshot.rs"]
mod snapshot;

#[expect(clippy::duplicate_mod, reason = "the same sources against another crate and another number")]
#[path = "engine/impulses.rs"]
mod impulses;

#[expect(clippy::duplicate_mod, reason = "the same sources against another crate and another number")]
#[path = "engine/probe.rs"]
mod probe;

#[expect(clippy::duplicate_mod, reason = "the same sources against another crate and another number")]
#[path = "engine/window.rs"]
mod window;

pub use impulses::{ImpulseReader, motor_effort, substep};
pub use probe::Probing;
pub use snapshot::{JointHandle, JointReaction, WorldRef, extrapolated};
pub use window::{BalancedReactions, PoseWindow};
