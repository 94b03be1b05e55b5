//! Design of a mechanism from results that other crates have proven. This crate is not part of the proof.
//! The crate covers bearings, clearance, diagrams, export, flywheel, motor choice, plans and synthesis.

pub mod bearings;
pub mod clearance;
pub mod diagram;
pub mod draw;
pub mod drive;
pub mod export;
pub mod plan;
mod sentences;
pub mod synthesize;
