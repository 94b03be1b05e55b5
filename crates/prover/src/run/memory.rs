//! Memory that a run needs, estimated before the run begins.
//!
//! A run stores whole trajectories: 8 bytes for every value.
//! The number of an engine's runs is not known in advance, so the estimate assumes a number that suffices for most
//! searches.
//! Measured peaks lie between half and twice the estimate.
//! See docs/numerics/settings.md.

use crate::sentences;
use linkage::case::Case;
use linkage::engine::Rows;
use linkage::error::{Advice, Error, ErrorKind, Result};
use scenario::Oracle;

/// Memory allowed by default (bytes).
pub(crate) const MOST: f64 = 4e9;
/// Memory of a run without its instants (bytes).
const ELSE: f64 = 2e7;
/// Number of trajectories of a proof at its peak: two analytic sides, the three judged runs, one run with another
/// number of sweeps, the best run so far, and one run in progress.
const TRAJECTORIES: f64 = 8.0;
/// Number of runs of an engine in memory at the peak: one run for each halving of the step, and, at some steps, further
/// runs with different numbers of sweeps.
const RUNS: f64 = 12.0;
/// Number of values stored per instant in addition to the channels: time, crank angle, order, openings, powers.
const BESIDE: usize = 6;

/// Estimated memory (bytes) of a proof of a case in which `engines` engines run one after the other.
#[must_use]
pub fn of_proof(case: &Case, engines: usize) -> f64 {
    // After the runs of an engine are finished, its trajectory stays in memory.
    let trajectories = TRAJECTORIES + engines.saturating_sub(1) as f64;
    let row = trajectories * trajectory(case) + RUNS * Rows::bytes_of_row(case) as f64;
    ELSE + case.grid.len() as f64 * row
}

/// Memory per number of a table (bytes). Each number is stored three times: as text from the file, as a value with its
/// printed digits, and as the computed value for comparison.
const OF_NUMBER: f64 = 88.0;
/// Memory per row of a table, without the row's numbers (bytes).
const OF_ROW: f64 = 50.0;

/// Estimated memory (bytes) of comparing a table with both sides. The table has `rows` rows and `claims` compared
/// columns; each side is solved in `channels` channels.
#[must_use]
pub fn of_comparison(rows: usize, claims: usize, channels: usize) -> f64 {
    let solved = (2 * (channels + BESIDE) * size_of::<f64>()) as f64;
    ELSE + rows as f64 * (solved + claims as f64 * OF_NUMBER + OF_ROW)
}

/// Estimated memory (bytes) for published numbers, and for the values of both sides that are compared with them.
#[must_use]
pub fn of_oracles(oracles: &[Oracle]) -> f64 {
    let series: Vec<usize> = oracles.iter().flat_map(|own| &own.series).map(|own| own.instants().count()).collect();
    let (rows, numbers) = (series.iter().copied().max().unwrap_or(0), series.iter().sum::<usize>());
    // Rounded instants need three more trajectories: the solution at the instants, the solution at one end of the
    // rounding interval, and the changes between them.
    let is_rounded = oracles.iter().flat_map(|own| &own.series).any(|own| own.all().any(|point| point.at_error > 0.0));
    let trajectories = if is_rounded { 5 } else { 2 };
    let solved = (trajectories * (2 * series.len() + BESIDE) * size_of::<f64>()) as f64;
    rows as f64 * (solved + OF_ROW) + numbers as f64 * OF_NUMBER
}

/// Checks, before any allocation, that an input may use the memory `needed` (bytes). `what` names the input.
///
/// # Errors
/// [`ErrorKind::Unsupported`] with advice.
pub fn check_input(what: &str, needed: f64, most: Option<f64>) -> Result<()> {
    let fewer = Advice::Text(sentences::GIVE_FEWER_ROWS_OR_FEWER.into());
    allowed(needed, most, || sentences::needs_about_of_memory(&what, &gigabytes(needed)), fewer)
}

/// Checks that the memory `needed` (bytes) is allowed. `what` is the beginning of the error message; `fewer` is advice
/// on how to use less memory.
fn allowed(needed: f64, most: Option<f64>, what: impl FnOnce() -> String, fewer: Advice) -> Result<()> {
    let most = most.unwrap_or(MOST);
    if needed <= most {
        return Ok(());
    }
    let message = sentences::are_allowed(&what(), &gigabytes(most));
    Err(Error::new(ErrorKind::Unsupported, message).help(fewer).or_help(Advice::MoreMemory { to: needed }))
}

/// Estimated memory (bytes) of one solution of a case. The solver combines `runs` runs.
#[must_use]
pub fn of_solution(case: &Case, runs: usize) -> f64 {
    let row = trajectory(case) + runs.saturating_sub(1) as f64 * Rows::bytes_of_row(case) as f64;
    ELSE + case.grid.len() as f64 * row
}

/// Memory of a trajectory per instant (bytes).
fn trajectory(case: &Case) -> f64 {
    ((case.channels().len() + BESIDE) * size_of::<f64>()) as f64
}

/// Checks that `needed` (bytes) is at most `most`, or at most the default limit if `most` is `None`.
///
/// # Errors
/// [`ErrorKind::Unsupported`] with the size of the run and advice.
pub fn check(case: &Case, needed: f64, most: Option<f64>) -> Result<()> {
    allowed(needed, most, || told(case, needed), Advice::FewerInstants).map_err(|error| error.key("grid"))
}

/// Memory that a run needs, in words.
#[must_use]
pub fn told(case: &Case, needed: f64) -> String {
    let (instants, channels) = (case.grid.len(), case.channels().len());
    sentences::instants_of_channels_need_about(&instants, &channels, &gigabytes(needed))
}

fn gigabytes(bytes: f64) -> String {
    format!("{:.1} GB", bytes / 1e9)
}
