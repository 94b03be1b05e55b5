#![doc = include_str!("../README.md")]
//!
//! If a mechanism of dyads of revolute pairs has a crank at constant speed and no loads except weights, [`solve`] uses
//! closed forms ([`dyads`]). In every other case, [`solve`] solves all equations of the mechanism at once ([`whole`]).
//! The second method accepts any [`Scalar`]: with [`Dual`] numbers it gives the exact derivatives of every channel with
//! respect to the [`CaseNumbers`] of the case.
//! The methods share the case with the analytic sides, but no equations and no code.
//! The inputs of the drives are computed from the time of the instant in full precision, except inputs that are given
//! by tables or formulas.

mod dual;
pub mod dyads;
mod eliminated;
mod equations;
mod forces;
mod frame;
mod law;
mod load_numbers;
mod loads;
mod long;
mod numbers;
mod readings;
mod scalar;
mod sentences;
mod task;
#[cfg(test)]
mod tests;
mod transmission;
mod vector;
pub mod whole;

pub use dual::Dual;
pub use equations::Whole;
pub use frame::Snapshot;
pub use long::Long;
pub use numbers::CaseNumbers;
pub use readings::Readings;
pub use scalar::{Lift, LiftTable, Scalar};

use linkage::case::Case;
use linkage::error::Result;
use linkage::input::Input;
use linkage::mechanism::GroupKind;
use linkage::trajectory::Trajectory;

/// Name of the method by which [`solve`] solves a case, in words.
pub fn method(case: &Case) -> &'static str {
    if has_closed_form(case) {
        sentences::CLOSED_FORM_IN_DOUBLE_DOUBLE
    } else {
        sentences::ALL_EQUATIONS_IN_DOUBLE_DOUBLE
    }
}

/// All channels of a case on its grid, rounded to doubles at the end.
///
/// # Errors
/// [`Unsupported`](linkage::ErrorKind::Unsupported) for a case with friction, transmissions, instants before t = 0, a
/// free motion, or a drive that may pass change points.
/// [`Geometry`](linkage::ErrorKind::Geometry) if the mechanism cannot be assembled or is singular. The error contains
/// the crank angle.
pub fn solve(case: &Case) -> Result<Trajectory> {
    if has_closed_form(case) { dyads::solve(case) } else { whole::solve(case) }
}

/// Whether the mechanism consists of dyads of revolute pairs, is driven by a crank at constant speed, and has no loads
/// except weights.
fn has_closed_form(case: &Case) -> bool {
    let drive = case.crank();
    let is_plain = case.drives.len() == 1 && case.loads.is_empty() && !case.is_free() && drive.input == Input::Angle;
    let are_dyads = case.structure.groups.iter().all(|group| group.kind == GroupKind::Rrr && group.is_rigid());
    is_plain && drive.constant_speed().is_some() && are_dyads
}
