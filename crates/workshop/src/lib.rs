//! Design work outside the proof, on a mechanism whose numbers are proven.
//! It covers bearings, diagrams, export, flywheel, motor choice and synthesis.

pub mod bearings;
pub mod diagram;
pub mod export;
pub mod flywheel;
pub mod motor;
pub mod synthesis;
pub mod task;
