//! Steady motion under a motor: averaged, periodic, and the course of the reduced quantities over the turn.
//! See docs/numerics/forces.md.

pub mod averaged;
pub mod course;
pub mod regime;

pub use averaged::Averaged;
pub use regime::Regime;
