//! Arguments of `linkproof run`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use crate::cli::engine_args::{EngineArgs, side};
use crate::cli::grid::GridArgs;
use crate::cli::live::LiveArgs;
use crate::cli::load::StartArgs;
use crate::cli::record_args::RecordArgs;
use crate::cli::reports::Reports;
use crate::cli::{html, number};
use prover::proof::Reference;

const EXAMPLES: &str = "\
Examples:
  linkproof new --shipped      write the files that the examples name
  linkproof run scenarios/crank_rocker.toml
  linkproof run scenarios/crank_rocker.toml --dt 1e-4          this step of the engine, not one that the run finds
  linkproof run mine.toml --write                              keep the settings that the run has found in the file
  linkproof run scenarios/crank_rocker.toml --verbose          every quantity and every check
  linkproof run scenarios/*.toml --no-record --quiet           one line for each file
  linkproof run scenarios/*.toml --reference newton            the other analytic side as reference
  linkproof run scenarios/crank_rocker.toml --engine all       every engine side by side, and who stands alone
  linkproof run scenarios/ov7_base.toml --sweeps 4096 --extrapolate   other settings of the engine
  linkproof run scenarios/fourth_class.toml --no-record --mode link_2,link_3,link_4,link_5=2   another configuration
  linkproof run scenarios/crank_rocker.toml --no-record --start-crank-deg 90 --crank-deg 90:450:2   another start and grid
  linkproof run scenarios/crank_rocker_runup.toml --no-record --times 0,0.01,0.05,0.1   only these instants
  linkproof run scenarios/crank_rocker.toml --slow 20 --record-forces   a recording to look at, twenty times slower
  linkproof run scenarios/crank_rocker.toml --live             move it in Foxglove or Lichtblick until Ctrl-C
  linkproof run scenarios/*.toml --no-record --json out.json   no recording, results for a script
  linkproof run scenarios/*.toml --no-record --junit out.xml --markdown out.md   for reports of tests, and a comment
  linkproof run scenarios/crank_rocker.toml --no-record --html crank_rocker.html   a page to look at, in any browser
  linkproof run scenarios/*.toml --no-record --html pages/     a page for each
  linkproof run mine.toml --set a_mm=30                        another number for a parameter of the file
  linkproof run scenarios/ov7_base.toml --no-record --only point.9.positions --explain   one point, and what that takes

Exit codes: 0 all agree, 1 something disagrees, 2 bad input or usage, 3 nothing proven either way.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(in crate::cli) struct Args {
    /// Scenario files; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Analytic solver that the engine is compared with; the other one checks it
    #[arg(long, default_value = "assur", value_parser = side())]
    pub reference: Reference,
    #[command(flatten)]
    pub engine: EngineArgs,
    #[command(flatten)]
    pub grid: GridArgs,
    #[command(flatten)]
    pub start: StartArgs,
    /// Multiply every bound by this factor, to see how close a proof is to its bounds; 0 judges as usual and prints
    /// every residual beside its bound
    #[arg(long, hide = true, value_name = "FACTOR", allow_hyphen_values = true, value_parser = number::not_negative)]
    pub tolerance_scale: Option<f64>,
    /// Write the settings that the proof has found to the `[engine]` section of the scenario file. They are those of the
    /// file's own mechanism, so that none of its numbers and modes may be given otherwise
    #[arg(long, conflicts_with_all = ["set", "mode", "start_crank_deg"])]
    pub write: bool,
    #[command(flatten)]
    pub record: RecordArgs,
    #[command(flatten)]
    pub live: LiveArgs,
    /// Ask for these channels only: a stage (positions), a subject (point.P, joint.B, drive), a subject's stage
    /// (point.P.positions) or a channel (joint.B.fx_N). What they do not depend on is not computed; published numbers of
    /// other channels are left out. May be given several times
    #[arg(long, value_name = "WORD")]
    pub only: Vec<String>,
    /// Show everything: structure, settings, every quantity, every check
    #[arg(short, long, conflicts_with = "quiet")]
    pub verbose: bool,
    /// Show only the verdict, in one line for each file
    #[arg(short, long)]
    pub quiet: bool,
    /// Number of files that are proven side by side; the output is the same for any number [default: all cores]
    #[arg(long, value_name = "N")]
    pub jobs: Option<NonZeroUsize>,
    /// Show what ran, how often and why, and what was skipped
    #[arg(long)]
    pub explain: bool,
    #[command(flatten)]
    pub reports: Reports,
    /// Write a page to look at: the mechanism moving, all channels of both sides with errors and bounds, verdict and
    /// findings. It needs nothing else, no network either. A file for one scenario; for several, or if it is there or
    /// ends with `/`, a directory with NAME.html for each
    #[arg(long, value_name = "FILE|DIR", value_parser = html::target)]
    pub html: Option<PathBuf>,
}
