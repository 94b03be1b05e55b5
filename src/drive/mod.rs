//! What moves a mechanism and what loads it.

mod branch;
pub mod catalogue;
pub mod load;
pub mod motion;
pub mod motor;

pub use branch::Branch;
pub use catalogue::CatalogueMotor;
pub use load::Load;
pub use motion::{Drive, MotionLaw};
pub use motor::{Motor, MotorLaw, ShaftInertia};
