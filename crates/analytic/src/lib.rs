#![doc = include_str!("../README.md")]
//!
//! Side 1 ([`assur`]) solves group by group, side 2 ([`newton`]) solves the whole mechanism at once.

pub mod assur;
mod assur_solver;
pub mod modes;
pub mod motion;
pub mod newton;
pub mod range;
pub mod reduced;
mod sentences;
pub mod steady;
pub mod witness;

pub use assur::PoseSolver;
pub use assur_solver::{AssurAt, AssurSolver, TIGHT_ASSUR};
pub use newton::{NewtonAt, NewtonSolver, TIGHT_NEWTON};

use linkage::solver::Solver;

/// The analytic solvers; the default solver comes first.
#[must_use]
pub fn all() -> [&'static dyn Solver; 2] {
    [&AssurSolver, &NewtonSolver]
}

/// The analytic solver with the name `name`.
#[must_use]
pub fn named(name: &str) -> Option<&'static dyn Solver> {
    all().into_iter().find(|solver| solver.name() == name)
}
