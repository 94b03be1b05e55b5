//! What moves a mechanism and what loads it.

mod branch;
pub mod load;
pub mod motion;
pub mod motor;

pub use branch::Branch;
pub use load::Load;
pub use motion::{Drive, DriveState, MotionLaw};
pub use motor::{Motor, MotorLaw, ShaftInertia};
