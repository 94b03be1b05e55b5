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
    /// List channels instead: all channels, or the channels of a scenario if a file is given
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
        let bare = |file: PathBuf| file.strip_prefix(".").map(Path::to_path_buf).unwrap_or(file);
        let all: Vec<_> = files.into_iter().map(bare).map(|file| (Scenario::load(&file), file)).collect();
        let list = lists::scenarios(directory, &all, advice::told);
        if all.is_empty() { format!("{list}{}\n", sentences::NEW_WRITES_ONE) } else { list }
    };
    output::print(&text)
}
