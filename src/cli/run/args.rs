//! Arguments of `linkproof run`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use crate::cli::engine_args::{EngineArgs, side};
use crate::cli::grid::GridArgs;
use crate::cli::live::LiveArgs;
use crate::cli::load::StartArgs;
use crate::cli::number;
use crate::cli::outputs::{Outputs, results};
use crate::cli::record_args::RecordArgs;
use prover::run::Reference;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("../help/run.txt").trim_ascii_end())]
pub(in crate::cli) struct Args {
    /// Scenario files; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Analytic solver that the engine is compared with; the other analytic solver checks it
    #[arg(long, default_value = "assur", value_parser = side())]
    pub reference: Reference,
    #[command(flatten)]
    pub engine: EngineArgs,
    #[command(flatten)]
    pub grid: GridArgs,
    #[command(flatten)]
    pub start: StartArgs,
    /// Multiply every bound by this factor, to see how close a proof is to its bounds. The factor 0 changes no bound
    /// and prints every residual beside its bound
    #[arg(long, hide = true, value_name = "FACTOR", allow_hyphen_values = true, value_parser = number::not_negative)]
    pub tolerance_scale: Option<f64>,
    /// Write the found settings to the `[engine]` section of the scenario file. The settings are
    /// valid only for the mechanism of the file, so options that change parameters, modes or the start are not allowed
    #[arg(long, conflicts_with_all = ["set", "mode", "start_crank_deg"])]
    pub write: bool,
    #[command(flatten)]
    pub record: RecordArgs,
    #[command(flatten)]
    pub live: LiveArgs,
    /// Request only these channels: a stage (positions), a subject (point.P, joint.B, drive), a subject's stage
    /// (point.P.positions) or a channel (joint.B.fx_N). Quantities that these channels do not depend on are not
    /// computed; published numbers of channels that are not requested are omitted. May be given several times
    #[arg(long, value_name = "WORD")]
    pub only: Vec<String>,
    /// Show everything: structure, settings, every quantity, every check
    #[arg(short, long, conflicts_with = "quiet")]
    pub verbose: bool,
    /// Show only the verdict, in one line for each file
    #[arg(short, long)]
    pub quiet: bool,
    /// Number of files that are proven in parallel; the output is the same for any number [default: all cores]
    #[arg(long, value_name = "N")]
    pub jobs: Option<NonZeroUsize>,
    /// Show what ran, how often and why, and what was omitted
    #[arg(long)]
    pub explain: bool,
    #[command(flatten)]
    pub outputs: Outputs<RunResults>,
}

results! { RunResults {
    Json = "the results",
    Junit = "JUnit: one suite per scenario, one case per channel and check",
    Markdown = "a comment for a pull request",
    Html = "a page with the moving mechanism, all channels, errors and bounds (`DIR/` for several scenarios)",
} }
