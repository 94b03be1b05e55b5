//! Independent methods that check the results of the two sides. No other result depends on them.

pub mod momentum;
pub mod power;
pub mod triad;
