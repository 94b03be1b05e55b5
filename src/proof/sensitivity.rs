//! How strongly a free motion depends on the forces that cause it. This is the condition of the problem, whatever the
//! solver.

use crate::compare::largest_difference;
use linkage::case::Case;
use linkage::drive::Motor;
use linkage::error::Result;
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;

/// Share by which gravity and the motor's torque are changed: small compared with the motion, large compared with
/// rounding.
const CHANGE: f64 = 1e-6;

/// For every channel of `reference`, in its order: the largest change of its values over the run, per share of change
/// in gravity and motor torque, in the channel's unit. Empty for a motion that does not depend on forces.
///
/// # Errors
/// Those of the solver.
pub(super) fn of(case: &Case, solver: &dyn Solver, reference: &Trajectory) -> Result<Vec<f64>> {
    if !case.is_free() {
        return Ok(Vec::new());
    }
    let share = 1.0 + CHANGE;
    let stronger = |motor: &Motor| Motor { law: motor.law.scaled(share), ..motor.clone() };
    let drives = case.drives.map(|drive| drive.with_motor(drive.motor().map(stronger)));
    let changed = case.with(|parts| (parts.gravity, parts.drives) = (case.gravity * share, drives))?;
    let other = solver.solve(&changed)?;
    let of = |((channel, ours), (_, theirs)): ((&linkage::trajectory::Channel, &[f64]), (_, &[f64]))| {
        largest_difference(ours, theirs, channel.kind.periodic) / CHANGE
    };
    Ok(reference.iter().zip(other.iter()).map(of).collect())
}
