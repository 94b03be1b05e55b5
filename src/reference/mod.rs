//! The analytic side: two solvers that share nothing but the mechanism and small mathematics.

mod assur_solver;
pub mod batch;
pub mod dynamics;
mod free;
mod kinetostatics;
pub mod modes;
pub mod momentum;
mod newton_solver;
pub mod peaks;
mod pose_solver;
pub mod power;
pub mod range;
pub mod reduced;
pub mod triad;
mod turns;

pub use assur_solver::AssurSolver;
pub use newton_solver::NewtonSolver;
pub use pose_solver::PoseSolver;

use crate::solver::Solver;

/// The analytic solvers, the default first.
#[must_use]
pub fn all() -> [&'static dyn Solver; 2] {
    [&AssurSolver, &NewtonSolver]
}

/// The analytic solver called `name`.
#[must_use]
pub fn named(name: &str) -> Option<&'static dyn Solver> {
    all().into_iter().find(|solver| solver.name() == name)
}
