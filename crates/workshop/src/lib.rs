//! Design work off the proving line: what is done with a mechanism once its numbers are right.

pub mod bearings;
pub mod diagram;
pub mod export;
pub mod flywheel;
pub mod motor;
pub mod synthesis;
pub mod task;
