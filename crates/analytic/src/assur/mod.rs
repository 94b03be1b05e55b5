//! Side 1: group by group, forwards for the motion and backwards for the forces; dyads in closed form.

#[cfg(feature = "batch")]
pub mod batch;
mod forces;
pub mod groups;
mod pose_solver;
mod solver;
mod transfer;
mod turns;

pub use pose_solver::PoseSolver;
pub use solver::AssurSolver;
