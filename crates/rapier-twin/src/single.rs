//! The worlds in single precision.

pub(super) use parry2d as parry;
pub(super) use rapier2d as rapier;

/// The engine's number.
type Real = f32;

/// A number on its way into the engine.
fn real(value: f64) -> Real {
    value as f32
}

/// A number on its way out of the engine.
fn wide(value: Real) -> f64 {
    f64::from(value)
}

// The engine is two crates, one a precision, with the same names in them: what stands against one stands against the other.
#[expect(clippy::duplicate_mod, reason = "the same sources against another crate and another number")]
#[path = "twins/mod.rs"]
pub(super) mod twins;
