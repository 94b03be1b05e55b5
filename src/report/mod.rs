//! What a proof looks like: pure functions of a [`crate::proof::Proof`].

mod engines;
pub mod json;
pub mod text;
