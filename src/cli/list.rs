//! `linkproof list`.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use super::{advice, output};
use crate::scenario::Scenario;
use linkage::error::{Error, ErrorKind, Result};
use linkage::trajectory::{CHANNELS, Channel};

const EXAMPLES: &str = "\
Examples:
  linkproof list                 the scenarios in scenarios/
  linkproof list my_scenarios    those of another directory
  linkproof list --channels      every channel, its unit and meaning
  linkproof list --solvers       analytic solvers and engines";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Directory of scenario files
    #[arg(value_name = "DIR", default_value = "scenarios")]
    directory: PathBuf,
    /// List the channels instead
    #[arg(long)]
    channels: bool,
    /// List the solvers instead
    #[arg(long, conflicts_with = "channels")]
    solvers: bool,
}

pub(super) fn list(args: &Args) -> Result<()> {
    let text = if args.channels {
        channels()
    } else if args.solvers {
        solvers()
    } else {
        scenarios(&args.directory)?
    };
    output::print(&text)
}

fn scenarios(directory: &Path) -> Result<String> {
    let entries = fs::read_dir(directory).map_err(|error| {
        Error::new(ErrorKind::Io, format!("the directory {} cannot be read: {error}", directory.display()))
            .help("name the directory that holds your scenario files: linkproof list DIR")
    })?;
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    files.sort();
    let mut text = String::new();
    for file in &files {
        let _ = match Scenario::load(file) {
            Ok(scenario) => writeln!(
                text,
                "{}\n    {}\n    {}",
                file.display(),
                scenario.title,
                scenario.case.structure.formula(&scenario.case.mechanism)
            ),
            Err(error) => {
                writeln!(text, "{}\n    cannot be read: {}", file.display(), error.line_by(advice::told))
            }
        };
    }
    if files.is_empty() {
        let _ = writeln!(text, "no scenario files (*.toml) in {}", directory.display());
    }
    Ok(text)
}

fn channels() -> String {
    let mut text = String::new();
    for kind in &CHANNELS {
        let of = if kind.subject.is_whole() { "" } else { "NAME" };
        let name = Channel { of: of.into(), kind }.to_string();
        let _ = writeln!(text, "{name:40} {:8} {:26} with \"{}\"", kind.unit, kind.quantity, kind.stage.name());
    }
    text
}

fn solvers() -> String {
    let mut text = String::new();
    for solver in analytic::all() {
        let _ = writeln!(text, "{:10} analytic", solver.name());
    }
    for engine in crate::engines::all(1.0) {
        let _ = writeln!(text, "{:10} engine, {}", engine.name(), engine.version());
    }
    text
}
