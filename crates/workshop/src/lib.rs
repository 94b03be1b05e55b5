//! Design work outside the proof, on a mechanism whose numbers are proven.
//! It covers bearings, clearance, diagrams, export, flywheel, motor choice and synthesis.

pub mod bearings;
pub mod clearance;
pub mod diagram;
pub mod export;
pub mod flywheel;
pub mod motor;
pub mod synthesis;
pub mod task;
