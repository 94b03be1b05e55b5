//! Rapier worlds in double precision.

pub(super) use parry2d_f64 as parry;
pub(super) use rapier_reactions::double as reactions;
pub(super) use rapier2d_f64 as rapier;

/// The engine's floating-point type.
type Real = f64;

/// Converts a number for the engine.
fn real(value: f64) -> Real {
    value
}

/// Converts a number from the engine.
fn wide(value: Real) -> f64 {
    value
}

#[path = "twins/worlds.rs"]
pub(super) mod twins;
