//! Solutions as CSV, one row per instant, with 17 significant digits, so that every double is read back exactly.

use crate::sentences;
use std::io::{Error, Result, Write};

use analytic::reduced::RunUp;
use design::export::cam;
use linkage::case::Case;
use linkage::trajectory::Trajectory;

/// A table of texts as CSV, its header first.
///
/// # Errors
/// [`Io`](linkage::error::ErrorKind::Io) if the table cannot be written.
pub(crate) fn as_csv<R: IntoIterator<Item = String>>(
    rows: impl IntoIterator<Item = R>,
) -> linkage::error::Result<String> {
    let failed = |error: csv::Error| {
        linkage::error::Error::new(linkage::error::ErrorKind::Io, sentences::the_table_cannot_be_written(&error))
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    rows.into_iter().try_for_each(|row| writer.write_record(row).map_err(failed))?;
    let bytes = writer.into_inner().map_err(|error| failed(error.into_error().into()))?;
    Ok(String::from_utf8(bytes).expect("names and numbers are text"))
}

/// The profiles of all cams of a case.
///
/// # Errors
/// The errors of [`cam::table`], and [`Io`](linkage::error::ErrorKind::Io) if the table cannot be written.
pub(crate) fn cams(case: &Case) -> linkage::error::Result<String> {
    as_csv(cam::table(case)?)
}

/// Writes time, crank angle, then all channels of a solution.
///
/// # Errors
/// The errors of `to`.
pub(crate) fn solution(trajectory: &Trajectory, to: &mut dyn Write) -> Result<()> {
    let columns: Vec<&[f64]> =
        [trajectory.times(), trajectory.inputs()].into_iter().chain(trajectory.iter().map(|(_, v)| v)).collect();
    let rows = (0..trajectory.times().len()).map(|row| columns.iter().map(|column| column[row]).collect());
    table(&["t_s", trajectory.input().key()], trajectory, rows, to)
}

/// Writes time, motion of the crank and moment of the motor in a run-up, then all requested channels.
///
/// # Errors
/// The errors of `to`.
pub(crate) fn run_up(run_up: &RunUp, to: &mut dyn Write) -> Result<()> {
    let own = [
        "t_s",
        run_up.trajectory.input().key(),
        "crank_omega_rad_s",
        "crank_alpha_rad_s2",
        "motor_on_crank_N_m",
        "shaft_N_m",
    ];
    let rows = run_up.motion.iter().enumerate().map(|(row, at)| {
        let own = [at.t, at.crank, at.omega, at.alpha, at.motor, at.shaft];
        own.into_iter().chain(run_up.trajectory.iter().map(|(_, values)| values[row])).collect()
    });
    table(&own, &run_up.trajectory, rows, to)
}

/// Converts an error of the CSV writer: to the I/O error that caused it, which keeps its I/O kind, or else to an error
/// of the kind `Other`.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the CSV writer")]
fn io_error(error: csv::Error) -> Error {
    if !error.is_io_error() {
        return Error::other(error);
    }
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => Error::other(format!("{other:?}")),
    }
}

/// A number with 17 significant digits.
pub(crate) fn number(value: f64) -> String {
    format!("{value:.16e}")
}

/// Writes a table: the columns `own`, then the channels of a trajectory.
/// The table is written row by row, because the text of all rows would need three times the memory of the numbers.
fn table(
    own: &[&str],
    trajectory: &Trajectory,
    rows: impl Iterator<Item = Vec<f64>>,
    to: &mut dyn Write,
) -> Result<()> {
    let mut writer = csv::Writer::from_writer(to);
    let names = trajectory.channels().iter().map(ToString::to_string);
    writer.write_record(own.iter().map(ToString::to_string).chain(names)).map_err(io_error)?;
    for row in rows {
        writer.write_record(row.into_iter().map(number)).map_err(io_error)?;
    }
    writer.flush()
}
