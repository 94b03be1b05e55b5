//! `linkproof man`: the manual, from the arguments of the command line.

use crate::sentences;
use std::path::{Path, PathBuf};
use std::{fs, io};

use clap::Command;
use clap_mangen::Man;

use super::output;
use linkage::error::{Error, ErrorKind, Result};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/man.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Directory for the pages of linkproof and of all its commands; it is created if it is missing [default: the page
    /// of linkproof, to standard output]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Writes one page to standard output, or all pages to a directory.
pub(super) fn run(args: &Args, command: Command) -> Result<()> {
    // Without the help subcommand, the page of linkproof has the same text when it is written alone and when it is
    // written with the pages of all commands.
    let mut command = command.disable_help_subcommand(true);
    command.build();
    let Some(directory) = &args.output else {
        let mut page = Vec::new();
        Man::new(command).render(&mut page).map_err(|error| failed(Path::new("-"), &error))?;
        return output::data(&String::from_utf8_lossy(&page));
    };
    let mut all = Vec::new();
    let made = fs::create_dir_all(directory).and_then(|()| pages(&command, &mut all));
    made.map_err(|error| failed(directory, &error))?;
    all.iter().try_for_each(|(name, text)| output::make(text, &directory.join(name)))
}

/// Adds the names and texts of the pages of a command and of all its subcommands.
fn pages(command: &Command, all: &mut Vec<(String, String)>) -> io::Result<()> {
    command.get_subcommands().filter(|own| !own.is_hide_set()).try_for_each(|own| pages(own, all))?;
    let page = Man::new(command.clone());
    let mut text = Vec::new();
    page.render(&mut text)?;
    all.push((page.get_filename(), String::from_utf8_lossy(&text).into_owned()));
    Ok(())
}

fn failed(to: &Path, error: &io::Error) -> Error {
    Error::new(ErrorKind::Io, sentences::the_manual_cannot_be_written(&to.display(), &error))
        .help(sentences::NAME_ANOTHER_DIRECTORY_WITH)
}
