//! Dimensions from a wanted motion: closed forms where there are any, else a search over lengths and pivots.

pub mod achieved;
pub mod crank_rocker;
pub mod draft;
mod evaluate;
mod rating;
pub mod search;
pub mod slider_crank;

pub use achieved::Achieved;
pub use crank_rocker::CrankRocker;
pub use draft::Sheet;
pub use search::{Found, search};
pub use slider_crank::SliderCrank;

use std::f64::consts::PI;

/// Time of the slower stroke over that of the faster one where the directions of crank and coupler in the two extreme positions differ by `theta` (rad):
/// K = (pi + |theta|) / (pi - |theta|), at a constant speed of the crank.
fn time_ratio(theta: f64) -> f64 {
    (PI + theta.abs()) / (PI - theta.abs())
}
