//! `linkproof synthesize`.

mod closed_form;
mod search;
mod told;

use std::fs;
use std::path::{Path, PathBuf};

use super::{output, progress};
use linkage::error::{Error, ErrorKind, Result};

const EXAMPLES: &str = "\
Examples:
  linkproof synthesize crank-rocker --pivot-mm 150,15 --rocker-mm 250 --extreme-deg 50 --swing-deg 32 -o rocker.toml
  linkproof synthesize slider-crank --stroke-mm 100 --offset-mm 30 --time-ratio 1.2 -o slider.toml
  linkproof synthesize search scenarios/ov7_drives/sinker_task.toml -o sinker.toml --svg sinker.svg
  linkproof synthesize check scenarios/ov7_drives/sinker_task.toml scenarios/ov7_drives/sinker.toml

What is found is written as a scenario, which `linkproof run` then proves. docs/synthesis.md describes methods and files.";

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
    /// Lengths and pivots of any linkage so that its output follows a timing: random search, the best refined
    Search(search::Args),
    /// How a scenario keeps the timing of a synthesis file
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

/// Path of a scenario to be written: `-` or a name that ends in `.toml`.
fn scenario_target(text: &str) -> std::result::Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if text != "-" && path.extension().is_none_or(|extension| extension != "toml") {
        return Err("a scenario is written to a file that ends in .toml, or to standard output with `-`".into());
    }
    Ok(path)
}

/// Writes a scenario, but never over one of the files that it comes from.
fn write_scenario(text: &str, to: &Path, sources: &[&Path]) -> Result<()> {
    let same = |source: &&Path| match (fs::canonicalize(source), fs::canonicalize(to)) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    };
    if let Some(source) = sources.iter().find(|source| same(source)) {
        let message = format!("the scenario found would overwrite {}, which it comes from", source.display());
        return Err(Error::new(ErrorKind::Input, message).key("--output").help("name another file"));
    }
    output::write(text, to)
}
