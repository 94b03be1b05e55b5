//! Random correct mechanisms for stress families and for tests. The same seed gives the same mechanism on every
//! machine.
//!
//! A mechanism is drawn in its start pose ([`sketch`]), so that it can be assembled.
//! The mechanism is stored as data ([`spec`]).
//! The stored mechanism can be turned, mirrored and loaded before it is written as a scenario.

pub mod driven;
pub mod dyads;
pub mod frictional;
pub mod geared;
pub mod sketch;
pub mod spec;
