//! `linkproof solve`.

use std::path::{Path, PathBuf};

use super::engine_args::{MemoryArgs, SettingArgs};
use super::grid::GridArgs;
use super::load::{StartArgs, only};
use super::output;
use super::outputs::{Outputs, results};
use super::solving::With;
use crate::report::table_csv;
use linkage::error::Result;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/solve.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Solver: an analytic one or an engine
    #[arg(long, value_name = "SOLVER", default_value = "assur", value_parser = With::parser())]
    with: With,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    start: StartArgs,
    #[command(flatten)]
    settings: SettingArgs,
    #[command(flatten)]
    memory: MemoryArgs,
    /// Request only these channels, as in `run`; quantities that they do not depend on are not computed. May be given
    /// several times
    #[arg(long, value_name = "WORD")]
    only: Vec<String>,
    #[command(flatten)]
    outputs: Outputs<Solutions>,
}

results! { Solutions {
    Csv = "one row per instant",
} }

pub(super) fn solve(args: &Args) -> Result<()> {
    let scenario = only(args.start.load(&args.file, &args.grid)?, &args.only)?;
    let case = scenario.case.scene()?.case;
    let trajectory = args.with.solve(&scenario, &case, &args.settings, args.memory)?;
    let to = args.outputs.first(Solutions::Csv).unwrap_or(Path::new("-"));
    output::stream(to, |out| table_csv::solution(&trajectory, out))
}
