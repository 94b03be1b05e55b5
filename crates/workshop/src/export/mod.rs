//! A mechanism as a model file of another program, to be simulated and looked at there.

pub mod mjcf;
