//! The mechanism reduced to its driving link: moment of inertia and moment of resistance as functions of the crank angle.

use crate::case::{Case, Grid, Wanted};
use crate::error::Result;
use crate::math::Motion;
use crate::solver::Solver;
use crate::trajectory::Stage;

/// Reduced moment of inertia (kg m^2): twice the kinetic energy over the square of the driving link's speed,
/// I* = sum of m (v / omega_1)^2 + J (omega / omega_1)^2.
#[must_use]
pub fn moment_of_inertia(case: &Case, motions: &[Motion]) -> f64 {
    let energy = |(link, motion): (usize, &Motion)| {
        let body = &case.mechanism.links()[link];
        body.mass * motion.point_velocity(body.mass_centre).norm_squared() + body.inertia * motion.omega.powi(2)
    };
    let sum: f64 = motions.iter().enumerate().skip(1).map(energy).sum();
    sum / motions[case.drive.link].omega.powi(2)
}

/// Reduced moment of resistance (N m): minus the power of gravity and loads over the driving link's speed, positive
/// where the drive must do work against them.
#[must_use]
pub fn moment_of_resistance(case: &Case, motions: &[Motion]) -> f64 {
    let power = |(link, motion): (usize, &Motion)| {
        let body = &case.mechanism.links()[link];
        case.gravity.dot(&motion.point_velocity(body.mass_centre)) * body.mass
            + case.load_moment(link, motion.omega) * motion.omega
    };
    let sum: f64 = motions.iter().enumerate().skip(1).map(power).sum();
    -sum / motions[case.drive.link].omega
}

/// Means of the reduced quantities over one turn of the crank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Means {
    /// Mean reduced moment of inertia (kg m^2).
    pub inertia: f64,
    /// Mean reduced moment of resistance (N m).
    pub resistance: f64,
}

/// Number of equally spaced crank angles that the means are taken over. The mean of a smooth periodic function converges faster
/// than any power; a kink, where a load changes its sense, leaves an error of the order of the squared spacing: below 1e-6 of the mean.
pub const TURN_POINTS: usize = 3600;

/// Means over one turn, with the motion of the given solver.
///
/// # Errors
/// Those of the solver, for mechanisms whose crank cannot turn fully.
pub fn means_over_turn(case: &Case, solver: &dyn Solver) -> Result<Means> {
    let step = std::f64::consts::TAU / TURN_POINTS as f64;
    let cranks = (0..TURN_POINTS).map(|k| case.drive.start + step * k as f64).collect();
    let turn = Case { wanted: Wanted::of(&[Stage::Velocities]), ..case.on(Grid::of_cranks(&case.drive, cranks)) };
    let mut means = Means { inertia: 0.0, resistance: 0.0 };
    let mut visit = |_: usize, state: &crate::solver::State| {
        means.inertia += moment_of_inertia(&turn, &state.motions) / TURN_POINTS as f64;
        means.resistance += moment_of_resistance(&turn, &state.motions) / TURN_POINTS as f64;
        Ok(())
    };
    solver.sweep(&turn, &mut visit, &mut |_| {})?;
    Ok(means)
}
