//! What moves a mechanism and what loads it.

pub mod load;
pub mod motion;

pub use load::Load;
pub use motion::{Drive, MotionLaw};
