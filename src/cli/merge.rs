//! `linkproof merge`.

use std::path::PathBuf;

use super::outputs::{Outputs, results};
use super::sweep::{goal, told};
use linkage::error::Result;
use sweep::{SweepStore, SweepSummary};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/merge.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Directories of the shards, or the one directory in which all shards are stored
    #[arg(required = true, value_name = "DIR")]
    directories: Vec<PathBuf>,
    /// Best cases to show: those with the smallest or largest values of a figure, as `min:FIGURE` or `max:FIGURE`
    /// [default: the smallest values of the first figure]
    #[arg(long, value_name = "END:FIGURE")]
    best: Option<String>,
    #[command(flatten)]
    outputs: Outputs<Merged>,
}

results! { Merged {
    Results = "directory of the joined table [default: the first DIR]",
    Html = "page with parallel coordinates and the best cases",
} }

pub(super) fn merge(args: &Args) -> Result<u8> {
    let to = args.outputs.first(Merged::Results).unwrap_or(&args.directories[0]);
    let goal = goal(args.best.as_deref(), &SweepStore::found(&args.directories[0])?.1)?;
    let (store, plan) = SweepStore::merged(&args.directories, to)?;
    let summary = SweepSummary::of(&plan, &store.table(), goal)?;
    told(&plan, &summary, goal, &store, args.outputs.of(Merged::Html))
}
