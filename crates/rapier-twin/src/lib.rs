//! Rapier, in two builds and two precisions.
//!
//! A world takes from the case its geometry, masses, drives and the pose at t = 0, nothing later. It first drives itself
//! backwards to a little before the first instant wanted and then forwards, so that the transient of
//! the first steps has died away before anything is read.

mod build;
mod double;
mod engine;
mod free;
mod ghost;
mod guard;
mod native;
pub mod newton_euler;
mod noise;
mod probe;
mod quiet;
mod rapier;
mod ring;
mod run;
#[cfg(feature = "f32")]
mod single;
mod window;
pub mod world;

pub use build::{Build, Precision};
pub use linkage::mechanism::spanning_tree as tree;
pub use quiet::is_guarded;
pub use rapier::Rapier;
