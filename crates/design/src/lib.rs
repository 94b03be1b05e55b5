//! Design of a mechanism whose numbers are proven. It is not part of the proof.
//! It covers bearings, clearance, diagrams, export, flywheel, motor choice and synthesis.

pub mod bearings;
pub mod clearance;
pub mod diagram;
pub mod draw;
pub mod drive;
pub mod export;
pub mod plan;
mod sentences;
pub mod synthesize;
