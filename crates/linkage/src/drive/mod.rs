//! What moves a mechanism and what loads it.

mod branch;
pub mod course;
pub mod load;
pub mod motion;
pub mod motor;

pub use branch::Branch;
pub use course::Course;
pub use load::{Action, Acts, Load, Nature, Senses, Setting, Wrench};
pub use motion::{Drive, DriveState, MotionLaw};
pub use motor::{Motor, MotorLaw, ShaftInertia};
