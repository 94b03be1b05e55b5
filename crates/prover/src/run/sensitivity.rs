//! Sensitivity of a free motion to the forces that cause it.
//! The sensitivity is the condition number of the problem and does not depend on the solver.
//! See docs/numerics/bounds.md.

use crate::bounds::largest_difference;
use linkage::case::Case;
use linkage::drive::Motor;
use linkage::error::Result;
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;

/// Relative change of gravity and of the motor's torque. The change is small enough for a linear response, but large
/// compared with rounding.
const CHANGE: f64 = 1e-6;

/// Sensitivity of every channel of `reference`, in the order of these channels and in the channel's unit.
/// The sensitivity is the largest change of the channel's values over the run, per relative change of gravity and motor
/// torque.
/// The list is empty for a motion that does not depend on forces.
///
/// # Errors
/// The errors of the solver.
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

#[cfg(test)]
mod tests {
    use super::*;
    use analytic::AssurSolver;
    use fixtures::of_repository;
    use linkage::math::KeepNan;

    /// In stronger gravity, a pendulum released from rest passes the same positions in a shorter time.
    /// If gravity is multiplied by 1 + e, the time is divided by sqrt(1 + e): theta(t; (1 + e) g) = theta(t sqrt(1 +
    /// e); g).
    /// Each time derivative is multiplied by one more factor sqrt(1 + e).
    #[test]
    fn sensitivity_of_a_pendulum_to_gravity_is_that_to_time_scale() {
        let case = of_repository("scenarios/pendulum.toml").case;
        let found = AssurSolver.solve(&case).unwrap();
        let sensitivity = of(&case, &AssurSolver, &found).unwrap();
        let own = |name: &str| found.named(&format!("link.rod.{name}")).unwrap();
        let (omega, alpha) = (own("omega_rad_s"), own("alpha_rad_s2"));
        let largest = |of: &dyn Fn(usize) -> f64| (0..omega.len()).map(|row| of(row).abs()).fold(0.0, f64::larger);
        let time = |row: usize| found.times()[row] / 2.0;
        let wanted = [
            ("angle_rad", largest(&|row| omega[row] * time(row))),
            ("omega_rad_s", largest(&|row| omega[row] / 2.0 + alpha[row] * time(row))),
        ];
        for (name, wanted) in wanted {
            let channel = found.channels().iter().position(|own| own.to_string() == format!("link.rod.{name}"));
            let found = sensitivity[channel.unwrap()];
            assert!((found / wanted - 1.0).abs() < 1e-4, "{name}: {found} {wanted}");
        }
    }
}
