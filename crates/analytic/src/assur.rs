//! Side 1: the solver by Assur groups.
//! Motion is solved from the first group to the last, forces from the last to the first; dyads are solved in closed
//! form.

#[cfg(feature = "batch")]
pub mod batch;
mod clear;
mod forces;
mod gauges;
pub mod groups;
mod passing;
mod pose_solver;
pub(crate) mod transfer;
mod turns;
mod watch;
mod whole_turns;

pub use pose_solver::PoseSolver;
