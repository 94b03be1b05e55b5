//! What moves a mechanism and what loads it.

pub mod load;
pub mod motion;
pub mod motor;

pub use load::Load;
pub use motion::{Drive, MotionLaw};
pub use motor::{Motor, MotorLaw};
