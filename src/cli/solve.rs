//! `linkproof solve`.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;

use super::engine_args::{MemoryArgs, SettingArgs, engine_names};
use super::grid::GridArgs;
use super::load::{StartArgs, only, reference_names};
use super::output;
use super::progress::Bar;
use crate::proof::memory;
use crate::report::table_csv;
use analytic::range::explained;
use linkage::error::{Error, ErrorKind, Result};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/solve.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Solver: an analytic one or an engine
    #[arg(long, value_name = "SOLVER", value_parser = PossibleValuesParser::new(solver_names()))]
    with: String,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    start: StartArgs,
    #[command(flatten)]
    settings: SettingArgs,
    #[command(flatten)]
    memory: MemoryArgs,
    /// Ask for these channels only, as in `run`: what they do not depend on is not computed. May be given several times
    #[arg(long, value_name = "WORD")]
    only: Vec<String>,
    /// File to write to, `-` for standard output
    #[arg(long, value_name = "FILE", default_value = "-", value_parser = output::target)]
    csv: PathBuf,
}

fn solver_names() -> Vec<&'static str> {
    [reference_names(), engine_names()].concat()
}

pub(super) fn solve(args: &Args) -> Result<()> {
    let scenario = only(args.start.load(&args.file, &args.grid)?, &args.only)?;
    let case = &scenario.case.scene()?.case;
    let engine = match analytic::named(&args.with) {
        Some(_) => None,
        None => Some(args.settings.engine(&args.with, &scenario)?),
    };
    let runs = engine.as_ref().map_or(1, |engine| engine.settings().extrapolated + 1);
    let needed = memory::of_solution(case, runs);
    memory::check(case, needed, Some(args.memory.bytes()))?;
    args.memory.tell(case, needed);
    let mut bar = Bar::new(&scenario.name);
    let mut progress = |part| bar.at(part);
    let trajectory = match (analytic::named(&args.with), engine) {
        (Some(solver), _) => match args.settings.given() {
            Some(option) => return Err(no_engine(&args.with, option)),
            None => solver.solve_with(case, &mut progress).map_err(|error| explained(case, error))?,
        },
        (None, engine) => engine.expect("no analytic solver is an engine").solve_with(case, &mut progress)?,
    };
    drop(bar);
    output::stream(&args.csv, |out| table_csv::solution(&trajectory, out))
}

/// The error for an engine's setting given to an analytic solver: it shows a misunderstanding, so it is not ignored.
fn no_engine(solver: &str, option: &str) -> Error {
    Error::new(ErrorKind::Input, format!("{option} is a setting of an engine, but {solver} is analytic and has none"))
        .help(format!("leave {option} out, or solve --with one of: {}", engine_names().join(", ")))
}
