//! Export of a mechanism as a model file for another program, for simulation and display there.

pub mod mjcf;
mod start;

pub use start::first_state;
