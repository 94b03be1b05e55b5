//! Design work outside the proof, on a mechanism whose numbers are proven.
//! It covers bearings, clearance, diagrams, export, flywheel, motor choice and synthesis.

pub mod bearings;
pub mod catalogue;
pub mod clearance;
pub mod diagram;
pub mod export;
pub mod flywheel;
pub mod motor;
pub mod redraw;
mod sentences;
pub mod synthesis;
pub mod task;
pub mod task_file;
