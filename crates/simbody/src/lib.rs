#![doc = include_str!("../README.md")]
//! Planar linkages in Simbody.
//! Bodies are connected by pins and sliders, constraints close the loops, and coordinates are prescribed in time.
//! Simbody's error-controlled integrator computes the motion, and Simbody computes the reactions.
//!
//! All data are plain numbers in SI units, in the plane x-y; angles are in rad, counter-clockwise positive.
//! Simbody works in three dimensions.
//! The mobilizers permit no motion out of the plane, and the constraints add no equation out of the plane.

mod ffi;
mod model;
mod parts;
mod sentences;
mod state;

pub use ffi::{Act, LinkageRun, version};
pub use model::SimbodyModel;
pub use parts::{Failure, GROUND, Inertia, IntegrationSettings, Law, LoopClosure, SimbodyBody, SimbodyJoint};
pub use state::{BodyState, LoopState, SimbodyState};
