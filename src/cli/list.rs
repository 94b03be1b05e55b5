//! `linkproof list`.

use crate::sentences;
use std::path::{Path, PathBuf};

use super::load::plain;
use super::{advice, output};
use crate::report::lists;
use linkage::error::Result;
use scenario::{self, Scenario};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/list.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Directory of scenario files [default: scenarios, or else this directory]; with --channels a scenario file
    #[arg(value_name = "DIR")]
    place: Option<PathBuf>,
    /// List the channels instead: those of a scenario, with a file
    #[arg(long)]
    channels: bool,
    /// List the solvers instead
    #[arg(long, conflicts_with = "channels")]
    solvers: bool,
}

pub(super) fn list(args: &Args) -> Result<()> {
    let text = if args.channels {
        match &args.place {
            Some(file) => lists::channels_of(&plain(file)?.case),
            None => lists::channels(),
        }
    } else if args.solvers {
        let (solvers, engines) = (analytic::all(), prover::engines::all(1.0));
        let engines = engines.iter().map(|engine| (engine.name(), engine.version()));
        lists::solvers(solvers.iter().map(|solver| solver.name()), engines)
    } else {
        let usual = Path::new("scenarios");
        let directory = args.place.as_deref().unwrap_or(if usual.is_dir() { usual } else { Path::new(".") });
        let files =
            scenario::files_in(directory).map_err(|error| error.help(sentences::NAME_THE_DIRECTORY_THAT_HOLDS))?;
        let all: Vec<_> = files.into_iter().map(|file| (Scenario::load(&file), file)).collect();
        lists::scenarios(directory, &all, advice::told)
    };
    output::print(&text)
}
