//! Random correct mechanisms, the same from the same seed on every machine: for stress families and for tests.
//!
//! A mechanism is drawn in its start pose ([`sketch`]), so that it can be assembled.
//! It is stored as data ([`spec`]) that can be turned, mirrored and loaded before it becomes the text of a scenario.

pub mod dyads;
pub mod sketch;
pub mod spec;
