//! `linkproof completions`: shell completions from the arguments of the command line.

use clap::Command;
use clap_complete::Shell;

use super::output;
use linkage::error::Result;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/completions.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Name of the shell
    shell: Shell,
}

/// Writes the completions of a shell to standard output.
pub(super) fn run(args: &Args, mut command: Command) -> Result<()> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut command, "linkproof", &mut text);
    output::data(&String::from_utf8_lossy(&text))
}
