//! Drives and loads of a mechanism.

mod branch;
pub mod course;
pub mod driven;
pub mod drives;
pub mod load;
pub mod motion;
pub mod motor;

pub use branch::MotorBranch;
pub use course::Course;
pub use driven::{Drive, DriveMotion};
pub use drives::Drives;
pub use load::{Action, Acts, Load, LoadNature, LoadState, On, Senses, Wrench};
pub use motion::{InputState, MotionLaw};
pub use motor::{Motor, MotorLaw, ShaftInertia};
