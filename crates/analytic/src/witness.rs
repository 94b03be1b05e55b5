//! Independent methods that check the results of the two analytic sides. No other result depends on these methods.

pub mod momentum;
pub mod power;
pub mod triad;
