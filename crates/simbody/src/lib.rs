#![doc = include_str!("../README.md")]
//!
//! Planar linkages in Simbody: bodies on pins and sliders, loops closed by constraints, coordinates prescribed in time,
//! Simbody's own error-controlled integrator, and its reactions.
//!
//! All data are plain numbers in SI units, in the plane x-y; angles are in rad, counter-clockwise positive.
//! Simbody works in three dimensions.
//! The mobilizers permit no motion out of the plane, and the constraints add no equation there.

mod ffi;
mod model;
mod parts;
mod sentences;
mod state;

pub use ffi::{Act, LinkageRun, version};
pub use model::SimbodyModel;
pub use parts::{Failure, GROUND, Inertia, IntegrationSettings, Law, LoopClosure, SimbodyBody, SimbodyJoint};
pub use state::{BodyState, LoopState, SimbodyState};
