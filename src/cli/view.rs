//! `linkproof view`.

use crate::sentences;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::ValueEnum;

use super::output;
use crate::report::{layout, plotjuggler};
use lab::outside;
use linkage::error::{Error, ErrorKind, Result};

/// Viewers with special output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Viewer {
    /// Rerun, with a separate recording and blueprint
    Rerun,
    /// Foxglove or Lichtblick, with a layout
    Foxglove,
    /// PlotJuggler, with a layout
    Plotjuggler,
}

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/view.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Recording (MCAP) written by `linkproof run`
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Viewer for the recording
    #[arg(long, value_enum, default_value = "rerun")]
    with: Viewer,
    /// Write to this file and open no viewer: a recording of Rerun (.rrd), or a layout (.json, .xml)
    #[arg(short, long, value_name = "FILE", value_parser = output::target)]
    output: Option<PathBuf>,
    /// Python command whose installation has Rerun's library (`pip install rerun-sdk`)
    #[arg(long, value_name = "COMMAND", default_value = "python3")]
    python: String,
}

pub(super) fn view(args: &Args) -> Result<()> {
    let beside = |ending: &str| args.output.clone().unwrap_or_else(|| args.file.with_extension(ending));
    match args.with {
        Viewer::Rerun => {
            let film = recording::film(&args.file)?;
            let to = beside("rrd");
            let since = Instant::now();
            let python = &args.python;
            let made = outside::converted(&layout::film(&film), python, &|| since.elapsed().as_secs_f64());
            let made = made.map_err(|found| {
                Error::new(ErrorKind::Io, sentences::cannot_be_written_by(&to.display(), &python, &found))
                    .help(sentences::PYTHON3_PIP_INSTALL_RERUN_SDK)
            })?;
            match args.output {
                Some(_) => output::write_bytes(&made, &to)?,
                None => output::make_by(&made, &to, &is_film)?,
            }
            output::print(&format!("rerun      {}\n", to.display()))?;
            if args.output.is_none() {
                outside::opened(&to, python).map_err(|found| {
                    Error::new(ErrorKind::Io, sentences::rerun_viewer_has_not_shown(&to.display(), &found))
                        .help(sentences::OPEN_THE_FILE_FROM_RERUN)
                })?;
            }
        }
        Viewer::Foxglove => {
            let film = recording::film(&args.file)?;
            let to = beside("foxglove.json");
            put(args, &layout::text(&film.view), &to)?;
            output::print(&sentences::layout_open_in_foxglove_or_lichtblick(&to.display(), &args.file.display()))?;
        }
        Viewer::Plotjuggler => {
            let to = beside("plotjuggler.xml");
            let numbers = recording::numbers(&args.file)?;
            put(args, &plotjuggler::text(&numbers, &seen_from(&to, &args.file)), &to)?;
            output::print(&sentences::layout_plotjuggler_file_file_being(&to.display()))?;
        }
    }
    Ok(())
}

/// Writes a layout; if the program chose the name, only a file that the program itself wrote is replaced.
fn put(args: &Args, text: &str, to: &Path) -> Result<()> {
    match args.output {
        Some(_) => output::write(text, to),
        None => output::make(text, to),
    }
}

/// Whether this program made the Rerun recording: the application's name is near the file's beginning.
fn is_film(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(4096)];
    head.starts_with(b"RRF") && head.windows(9).any(|part| part == b"linkproof")
}

/// The recording's path, as its layout states it.
/// If layout and recording are in one directory, the path is the file name, so that both can be moved together.
/// If they are in different directories, the path is absolute.
fn seen_from(layout: &Path, recording: &Path) -> PathBuf {
    match recording.file_name() {
        Some(name) if layout.parent() == recording.parent() => name.into(),
        _ => std::path::absolute(recording).unwrap_or_else(|_| recording.into()),
    }
}
