//! Comparison of two trajectories: residuals, their distribution, the convergence of the engine, and the verdict.

pub mod convergence;
pub mod other_sweeps;
mod residual;
pub mod verdict;

pub use convergence::{Convergence, Ladder};
pub use linkage::math::statistics::{differences, largest_difference};
pub use other_sweeps::OtherSweeps;
pub(crate) use residual::{Built, magnitudes_by, scales_beyond};
pub use residual::{Residual, difference, magnitudes, residuals, residuals_on, scales};
pub use verdict::{Check, Verdict, overall, place_of_finding};
