//! Design of a mechanism from the results of the analytic solvers. The proof does not use this crate.
//! The crate covers bearings, clearance, diagrams, exercises, export, flywheel, import, motor choice, plans,
//! relations of joints, sensitivities and synthesis.

pub mod bearings;
pub mod clearance;
pub mod diagram;
pub mod draw;
pub mod drive;
pub mod exercise;
pub mod export;
pub mod import;
pub mod plan;
pub mod relations;
pub mod rigid;
pub mod sensitivity;
mod sentences;
pub mod synthesize;
