//! `linkproof synthesize`.

mod check;
mod closed_form;
mod front;
mod precision;
mod proven;
mod search;

use linkage::error::Result;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/synthesize.txt").trim_ascii_end())]
pub(super) struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    /// Crank-rocker from the pivots, the rocker's length, one extreme position and the swing
    CrankRocker(closed_form::CrankRockerArgs),
    /// Slider-crank from stroke and offset, and either the rod's length or the time ratio
    SliderCrank(closed_form::SliderCrankArgs),
    /// Four-bar whose crank and rocker pass three to five pairs of angles
    Function(precision::FunctionArgs),
    /// Four-bar whose coupler passes three to five poses
    Motion(precision::MotionArgs),
    /// Four-bar with a coupler point that passes three to five points at given crank angles
    Path(precision::PathArgs),
    /// Lengths and pivots of any linkage whose output should follow a timing: random search, then refinement of the
    /// best candidates
    Search(search::Args),
    /// Pareto front: the smallest deviation from the task as a function of a limit that is varied
    Front(front::Args),
    /// Show how well scenarios keep the timing of a synthesis file; compare several at one speed
    Check(check::CheckArgs),
    /// Draw phases and displacements of all organs of a machine over the main shaft's angle
    Cyclogram(check::CyclogramArgs),
}

pub(super) fn synthesize(args: &Args) -> Result<()> {
    match &args.command {
        Command::CrankRocker(args) => closed_form::crank_rocker(args),
        Command::SliderCrank(args) => closed_form::slider_crank(args),
        Command::Function(args) => precision::function(args),
        Command::Motion(args) => precision::motion(args),
        Command::Path(args) => precision::path(args),
        Command::Search(args) => search::search(args),
        Command::Front(args) => front::front(args),
        Command::Check(args) => check::check(args),
        Command::Cyclogram(args) => check::cyclogram(args),
    }
}
