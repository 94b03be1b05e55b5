//! Side 1: group by group, forwards for the motion and backwards for the forces. Dyads in closed form.

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
