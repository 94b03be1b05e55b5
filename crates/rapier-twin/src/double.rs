//! The worlds in double precision.

pub(super) use parry2d_f64 as parry;
pub(super) use rapier2d_f64 as rapier;

/// The engine's number.
type Real = f64;

/// A number on its way into the engine.
fn real(value: f64) -> Real {
    value
}

/// A number on its way out of the engine.
fn wide(value: Real) -> f64 {
    value
}

#[path = "twins/mod.rs"]
pub(super) mod twins;
