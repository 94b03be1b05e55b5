//! The laboratory: studies of the prover's quality. A proof does not need this crate.
//!
//! - [`mod@bench`]: work against error of every solver and engine.
//! - [`stress`], [`specimens`]: families of hard mechanisms, and random mechanisms.
//! - [`mutate`]: faults planted in one party, and the checks that find them.
//! - [`tune`]: search for the cheapest settings of an engine.
//! - [`outside`]: programs other than linkproof that solve or show a case.

pub mod bench;
pub mod mutate;
pub mod outside;
mod sentences;
pub mod specimens;
mod steps;
pub mod stress;
pub mod tune;
