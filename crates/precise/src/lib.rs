#![doc = include_str!("../README.md")]
//!
//! [`solve`] solves dyads of revolute pairs in closed form ([`dyads`]). It solves every other mechanism from all
//! equations of the mechanism at once ([`whole`]).
//! Neither of the two methods shares an equation or code with the analytic sides. The case is the only common input.
//! The crank angle is computed from the time of the instant in full precision: start + speed t.

pub mod dyads;
mod frame;
mod long;
mod readings;
mod sentences;
mod task;
mod vector;
pub mod whole;

pub use long::Long;

use linkage::case::Case;
use linkage::error::Result;
use linkage::mechanism::GroupKind;
use linkage::trajectory::Trajectory;

/// Name of the method that computed the numbers, in words.
pub fn method(case: &Case) -> &'static str {
    if are_all_rrr(case) { sentences::CLOSED_FORM_IN_DOUBLE_DOUBLE } else { sentences::ALL_EQUATIONS_IN_DOUBLE_DOUBLE }
}

/// All channels of a case on its grid, rounded to doubles at the end.
///
/// # Errors
/// [`Unsupported`](linkage::ErrorKind::Unsupported) for a case with several drives, loads, transmissions, instants
/// before t = 0, a drive that may pass change points, or a drive other than a crank at constant speed.
/// [`Geometry`](linkage::ErrorKind::Geometry) if the mechanism cannot be assembled or is singular. The error contains
/// the crank angle.
pub fn solve(case: &Case) -> Result<Trajectory> {
    if are_all_rrr(case) { dyads::solve(case) } else { whole::solve(case) }
}

fn are_all_rrr(case: &Case) -> bool {
    case.structure.groups.iter().all(|group| group.kind == GroupKind::Rrr && group.is_rigid())
}
