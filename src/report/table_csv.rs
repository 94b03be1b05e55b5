//! Solutions as CSV, one row per instant, with 17 significant digits, so that every double is read back exactly.

use analytic::reduced::RunUp;
use linkage::error::{Error, ErrorKind, Result};
use linkage::trajectory::Trajectory;

/// Time, crank angle, then all channels of a solution.
///
/// # Errors
/// [`ErrorKind::Io`] if the table cannot be written.
pub(crate) fn solution(trajectory: &Trajectory) -> Result<String> {
    let columns: Vec<&[f64]> =
        [trajectory.times(), trajectory.cranks()].into_iter().chain(trajectory.iter().map(|(_, v)| v)).collect();
    let rows = (0..trajectory.times().len()).map(|row| columns.iter().map(|column| column[row]).collect());
    table(&["t_s", "crank_rad"], trajectory, rows)
}

/// The crank and the motor's moment in a run-up, then all wanted channels.
///
/// # Errors
/// [`ErrorKind::Io`] if the table cannot be written.
pub(crate) fn run_up(run_up: &RunUp) -> Result<String> {
    let own = ["t_s", "crank_rad", "crank_omega_rad_s", "crank_alpha_rad_s2", "motor_on_crank_N_m", "shaft_N_m"];
    let rows = run_up.motion.iter().enumerate().map(|(row, at)| {
        let own = [at.t, at.crank, at.omega, at.alpha, at.motor, at.shaft];
        own.into_iter().chain(run_up.trajectory.iter().map(|(_, values)| values[row])).collect()
    });
    table(&own, &run_up.trajectory, rows)
}

/// A table with columns of its `own` and those of a trajectory.
fn table(own: &[&str], trajectory: &Trajectory, rows: impl Iterator<Item = Vec<f64>>) -> Result<String> {
    let failed = |error: csv::Error| Error::new(ErrorKind::Io, format!("the table cannot be written: {error}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    let names = trajectory.channels().iter().map(ToString::to_string);
    writer.write_record(own.iter().map(ToString::to_string).chain(names)).map_err(failed)?;
    for row in rows {
        writer.write_record(row.iter().map(|value| format!("{value:.16e}"))).map_err(failed)?;
    }
    let bytes = writer.into_inner().map_err(|error| failed(error.into_error().into()))?;
    Ok(String::from_utf8(bytes).expect("names and numbers are text"))
}
