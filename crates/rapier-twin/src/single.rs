//! Rapier worlds in single precision.

pub(super) use parry2d as parry;
pub(super) use rapier_reactions::single as reactions;
pub(super) use rapier2d as rapier;

/// The engine's floating-point type.
type Real = f32;

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
#[path = "twins/worlds.rs"]
pub(super) mod twins;
