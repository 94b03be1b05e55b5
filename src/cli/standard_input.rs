//! A scenario from standard input, in place of a file.

use std::io::{self, IsTerminal};
use std::path::Path;
use std::sync::OnceLock;

use super::output;
use linkage::error::{Error, ErrorKind, Result};

/// What stands for standard input in place of a path.
const DASH: &str = "-";

/// What messages call it. Files that the scenario names are relative to the working directory.
const NAME: &str = "<standard input>";

/// Whether a path stands for standard input.
pub(super) fn is_meant(path: &Path) -> bool {
    path == Path::new(DASH)
}

/// The path, as messages name it.
pub(super) fn named(path: &Path) -> &Path {
    if is_meant(path) { Path::new(NAME) } else { path }
}

/// The text of standard input, which is read once.
pub(super) fn text() -> Result<&'static str> {
    static TEXT: OnceLock<std::result::Result<String, Error>> = OnceLock::new();
    let read = || {
        if io::stdin().is_terminal() {
            output::note("the scenario is read from standard input, up to its end (Ctrl-D)");
        }
        files::text_from(io::stdin().lock()).map_err(|error| {
            let usual = "give a scenario, as in: linkproof run - < four_bar.toml";
            Error::new(ErrorKind::Io, format!("{NAME} cannot be read: {error}")).help(files::way_out(&error, usual))
        })
    };
    TEXT.get_or_init(read).as_ref().map(String::as_str).map_err(Error::clone)
}

/// Refuses to write settings into what is no file.
pub(super) fn refuse_writing(path: &Path, write: bool) -> Result<()> {
    if !(write && is_meant(path)) {
        return Ok(());
    }
    let error = Error::new(ErrorKind::Input, format!("settings cannot be written to {NAME}")).key("--write");
    Err(error.help("save the scenario to a file and name that, or leave --write out: the report tells the settings"))
}
