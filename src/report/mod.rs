//! What a proof looks like: pure functions of a [`crate::proof::Proof`].

pub mod json;
pub mod text;
