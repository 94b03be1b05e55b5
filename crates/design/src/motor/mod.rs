//! Choice of a motor.

mod catalogue;
mod choice;

pub use catalogue::{CatalogueMotor, weakest_sufficient};
pub use choice::Choice;
