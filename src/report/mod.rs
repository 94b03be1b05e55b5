//! Presentation of a proof: pure functions of a [`crate::proof::Proof`].

mod cells;
mod engines;
pub mod json;
pub mod residuals;
mod tell;
pub mod text;

pub(crate) use cells::table;
pub use tell::Tell;
