//! `linkproof solve`.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;

use super::engine_args::{SettingArgs, engine_names};
use super::grid::Range;
use super::load::{load, reference_names};
use super::output;
use super::progress::Bar;
use crate::report::table_csv;
use crate::scenario::grid::only_times;
use analytic::range::explained;
use linkage::case::{Case, Grid};
use linkage::error::{Error, ErrorKind, Result};

const EXAMPLES: &str = "\
Examples:
  linkproof solve scenarios/crank_rocker.toml --with assur
  linkproof solve scenarios/ov7_base.toml --with newton --crank-deg 0:-360:-30 --csv table.csv
  linkproof solve scenarios/crank_rocker.toml --with rapier --dt 1e-4 --times 0:0.46:0.01
  linkproof solve scenarios/ov7_base.toml --with rapier --sweeps 4096 --extrapolate   other settings of the engine
  linkproof solve scenarios/crank_rocker.toml --with assur --mode coupler,rocker=right

Columns: t_s, crank_rad, then link.NAME, point.NAME, joint.NAME and drive channels (`linkproof list --channels`).";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Scenario file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Solver: an analytic one or an engine
    #[arg(long, value_name = "SOLVER", value_parser = PossibleValuesParser::new(solver_names()))]
    with: String,
    /// Crank angles in degrees, measured as in the scenario, instead of its grid
    #[arg(long, value_name = "FROM:TO:STEP", allow_hyphen_values = true, conflicts_with = "times")]
    crank_deg: Option<Range>,
    /// Times in seconds, instead of the scenario's grid
    #[arg(long, value_name = "FROM:TO:STEP", allow_hyphen_values = true)]
    times: Option<Range>,
    /// Start a group in another assembly mode than the file states, or in the configuration with that number in
    /// `inspect --modes`. May be given for several groups
    #[arg(long, value_name = "LINK,LINK=MODE")]
    mode: Vec<String>,
    #[command(flatten)]
    settings: SettingArgs,
    /// File to write to, `-` for standard output
    #[arg(long, value_name = "FILE", default_value = "-", value_parser = output::target)]
    csv: PathBuf,
}

fn solver_names() -> Vec<&'static str> {
    [reference_names(), engine_names()].concat()
}

pub(super) fn solve(args: &Args) -> Result<()> {
    let scenario = load(&args.file, &args.mode)?;
    let case = on_grid(&scenario.case, args)?;
    let mut bar = Bar::new(&scenario.name);
    let mut progress = |part| bar.at(part);
    let trajectory = match analytic::named(&args.with) {
        Some(solver) => match args.settings.given() {
            Some(option) => return Err(no_engine(&args.with, option)),
            None => solver.solve_with(&case, &mut progress).map_err(|error| explained(&case, error))?,
        },
        None => args.settings.engine(&args.with, &scenario)?.solve_with(&case, &mut progress)?,
    };
    drop(bar);
    output::write(&table_csv::solution(&trajectory)?, &args.csv)
}

/// The error for an engine's setting given to an analytic solver: it shows a misunderstanding, so it is not ignored.
fn no_engine(solver: &str, option: &str) -> Error {
    Error::new(ErrorKind::Input, format!("{option} is a setting of an engine, but {solver} is analytic and has none"))
        .help(format!("leave {option} out, or solve --with one of: {}", engine_names().join(", ")))
}

fn on_grid(case: &Case, args: &Args) -> Result<Case> {
    let grid = match (&args.crank_deg, &args.times) {
        (Some(_), _) if let Some(message) = only_times(case.crank()) => {
            return Err(Error::new(ErrorKind::Input, message).help("give times by --times FROM:TO:STEP"));
        }
        (Some(Range(degrees)), _) => {
            let cranks = degrees.iter().map(|angle| angle.to_radians()).collect();
            Grid::of_cranks(case.crank(), cranks)
        }
        (None, Some(Range(times))) => Grid::of_times(case.crank(), times.clone()),
        (None, None) => return Ok(case.clone()),
    };
    grid.check(case.crank()).map_err(|message| {
        Error::new(ErrorKind::Input, message).help("check the unit and size of --crank-deg or --times")
    })?;
    case.on(grid)
}
