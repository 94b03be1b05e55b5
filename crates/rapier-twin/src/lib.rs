#![doc = include_str!("../README.md")]
//!
//! See docs/numerics/twins.md.

mod added;
mod branch;
mod double;
mod engine;
mod free;
mod friction;
mod ghost;
mod guard;
mod jumps;
mod lines;
mod masses;
mod native;
pub mod newton_euler;
mod noise;
mod probe;
mod rapier;
mod reactions;
mod ring;
mod run;
mod sentences;
#[cfg(feature = "f32")]
mod single;
mod steer;
mod window;
pub mod world;

pub use linkage::mechanism::spanning_tree as tree;
pub use rapier::{Build, Precision, Rapier};
