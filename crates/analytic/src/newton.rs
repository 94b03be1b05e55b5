//! Side 2 solves all constraints of the mechanism at once, by Newton's method and Lagrange multipliers.

mod blocks;
mod constraint;
mod free;
mod friction;
mod passing;
mod solver;
mod steps;
mod system;
mod transmission;
mod whole_turns;

pub use solver::{NewtonAt, NewtonSolver, TIGHT_NEWTON};
