//! `linkproof completions` and `linkproof man`: what a shell and a manual know of the command line, from the same
//! arguments.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::Command;
use clap_complete::Shell;
use clap_mangen::Man;

use super::output;
use linkage::error::{Error, ErrorKind, Result};

const COMPLETIONS: &str = "\
Examples:
  linkproof completions bash > ~/.local/share/bash-completion/completions/linkproof
  linkproof completions zsh > ~/.zfunc/_linkproof                where `fpath` has ~/.zfunc
  linkproof completions fish > ~/.config/fish/completions/linkproof.fish

They hold from the next shell on.";

const MAN: &str = "\
Examples:
  linkproof man | man -l -                           the page of linkproof itself
  linkproof man -o ~/.local/share/man/man1           a page for each command too: man linkproof-run";

#[derive(Debug, clap::Args)]
#[command(after_help = COMPLETIONS)]
pub(super) struct CompletionArgs {
    /// Shell that completes
    shell: Shell,
}

#[derive(Debug, clap::Args)]
#[command(after_help = MAN)]
pub(super) struct ManArgs {
    /// Directory for the pages of linkproof and of all its commands; it is made if it is missing [default: the page of
    /// linkproof, to standard output]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Writes the completions of a shell to standard output.
pub(super) fn completions(args: &CompletionArgs, mut command: Command) -> Result<()> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut command, "linkproof", &mut text);
    output::print(&String::from_utf8_lossy(&text))
}

/// Writes one page to standard output, or all of them to a directory.
pub(super) fn man(args: &ManArgs, command: Command) -> Result<()> {
    let Some(directory) = &args.output else {
        let mut page = Vec::new();
        // As for the directory: both pages are the same.
        let mut command = command.disable_help_subcommand(true);
        command.build();
        Man::new(command).render(&mut page).map_err(|error| failed(Path::new("-"), &error))?;
        return output::print(&String::from_utf8_lossy(&page));
    };
    let pages = || -> io::Result<Vec<(OsString, String)>> {
        fs::create_dir_all(directory)?;
        let own = tempfile::tempdir()?;
        clap_mangen::generate_to(command, own.path())?;
        let read = |entry: io::Result<fs::DirEntry>| {
            let entry = entry?;
            Ok((entry.file_name(), fs::read_to_string(entry.path())?))
        };
        fs::read_dir(own.path())?.map(read).collect()
    };
    for (name, text) in pages().map_err(|error| failed(directory, &error))? {
        output::make(&text, &directory.join(name))?;
    }
    Ok(())
}

fn failed(to: &Path, error: &io::Error) -> Error {
    Error::new(ErrorKind::Io, format!("the manual cannot be written to {}: {error}", to.display()))
        .help("name another directory with -o")
}
