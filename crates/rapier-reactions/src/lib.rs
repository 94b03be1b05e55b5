#![doc = include_str!("../README.md")]

mod balance;
pub mod double;
mod error;
mod model;
mod motion;
mod plane;
mod rows;
mod sentences;
#[cfg(feature = "f32")]
pub mod single;
mod tiny;

pub use error::ReactionError;
pub use rows::{JointRows, JointType};
pub use tiny::{TinyStep, tiny_steps};
