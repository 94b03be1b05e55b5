//! Steady motion under a motor: the averaged model, the periodic motion, and the reduced quantities as functions of the
//! crank angle.
//! See docs/numerics/forces.md.

pub mod averaged;
pub mod course;
pub mod regime;

pub use averaged::Averaged;
pub use regime::Regime;
