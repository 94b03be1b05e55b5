//! Side 1: the solver by Assur groups.
//! The solver computes the motion from the first group to the last, and the forces from the last group to the first.
//! Dyads are solved in closed form.

#[cfg(feature = "batch")]
pub mod batch;
mod clear;
mod forces;
mod gauges;
pub mod groups;
mod passing;
mod pose_solver;
mod standstill;
pub(crate) mod transfer;
mod turns;
mod watch;
mod whole_turns;

pub use pose_solver::PoseSolver;
pub use standstill::{effort_at_rest, rows_at_rest};
