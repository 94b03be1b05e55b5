//! What a proof looks like: pure functions of a [`crate::proof::Proof`].

mod engines;
pub mod json;
pub mod text;

use linkage::error::Advice;

/// How advice is told: a program with options names them, [`Advice::to_string`] names none.
pub type Tell = fn(&Advice) -> String;
