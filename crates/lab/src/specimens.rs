//! Random correct mechanisms, the same from the same seed on every machine: for stress families and for tests.
//!
//! A drawing is made in its start pose ([`sketch`]), so that it can be assembled; it is data that can be turned,
//! mirrored and loaded ([`spec`]) before it becomes the text of a scenario.

pub mod dyads;
pub mod sketch;
pub mod spec;
