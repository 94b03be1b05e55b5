//! Finds the dimensions of a mechanism for a required motion: in closed form if possible, otherwise by a search over
//! lengths and pivots.

pub mod achieved;
mod bars;
pub mod crank_rocker;
pub mod draft;
mod evaluate;
pub mod front;
mod gradient;
pub mod machine_file;
mod nearest;
pub mod precision;
mod rating;
pub mod reached;
pub mod redraw;
pub mod search;
pub mod slider_crank;
pub mod target;
pub mod task;
pub mod task_file;

pub use achieved::Achieved;
pub use crank_rocker::CrankRocker;
pub use draft::DraftContents;
pub use search::{SearchResult, search};
pub use slider_crank::SliderCrank;

use linkage::error::{Error, ErrorKind};
use linkage::math::KeepNan;
use std::f64::consts::PI;

/// Time ratio: the time of the slower stroke divided by the time of the faster stroke, at a constant speed of the
/// crank:
/// K = (pi + |theta|) / (pi - |theta|).
/// `theta` (rad) is the angle between the directions from the crank's pivot to the output's pin in the two extreme
/// positions.
fn time_ratio(theta: f64) -> f64 {
    (PI + theta.abs()) / (PI - theta.abs())
}

/// Transmission angle (rad, at most a right angle) between coupler and rocker at their pin, by the law of cosines.
/// `distance` is the distance between the coupler's other pin and the rocker's pivot (m).
fn transmission_angle(distance: f64, coupler: f64, rocker: f64) -> f64 {
    let cos = (coupler.powi(2) + rocker.powi(2) - distance * distance) / (2.0 * coupler * rocker);
    cos.abs().smaller(1.0).acos()
}

fn wrong(key: &str, message: String, help: &str) -> Error {
    Error::new(ErrorKind::Input, message).key(key).help(help)
}
