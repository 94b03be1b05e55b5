//! `linkproof synthesize`.

mod closed_form;
mod search;
mod target;

use linkage::error::Result;

const EXAMPLES: &str = "\
Examples:
  linkproof new --shipped      write the files that the examples name
  linkproof synthesize crank-rocker --pivot-mm 150,15 --rocker-mm 250 --extreme-deg 50 --swing-deg 32 -o rocker.toml
  linkproof synthesize slider-crank --stroke-mm 100 --offset-mm 30 --time-ratio 1.2 -o slider.toml
  linkproof synthesize search scenarios/ov7_drives/sinker_task.toml -o sinker.toml --svg sinker.svg
  linkproof synthesize check scenarios/ov7_drives/sinker_task.toml scenarios/ov7_drives/sinker.toml

What is found is written as a scenario, which `linkproof run` then proves. `linkproof docs synthesis` describes methods and files.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    /// Crank-rocker from the pivots, the rocker's length, one extreme position and the swing
    CrankRocker(closed_form::CrankRockerArgs),
    /// Slider-crank from stroke and offset, and the rod's length or the time ratio
    SliderCrank(closed_form::SliderCrankArgs),
    /// Lengths and pivots of any linkage so that its output follows a timing: random search, then refinement of the
    /// best candidates
    Search(search::Args),
    /// Show how well a scenario keeps the timing of a synthesis file
    Check(search::CheckArgs),
}

pub(super) fn synthesize(args: &Args) -> Result<()> {
    match &args.command {
        Command::CrankRocker(args) => closed_form::crank_rocker(args),
        Command::SliderCrank(args) => closed_form::slider_crank(args),
        Command::Search(args) => search::search(args),
        Command::Check(args) => search::check(args),
    }
}
