//! Independent methods for the results of the two sides. They serve only as checks; no other result depends on them.

pub mod momentum;
pub mod power;
pub mod triad;
