//! Rerun: its recordings, written by its own library for Python, and its viewer.

use crate::sentences;
use std::fs;
use std::path::Path;
use std::process::Command;

use super::process;
use crate::bench::Clock;

/// Writes a film as a recording of Rerun. Its own library is the only thing that knows the format.
const SCRIPT: &str = include_str!("rerun.py");
/// Longest time for that (s).
const LIMIT: f64 = 120.0;

/// Makes a recording of Rerun with its blueprint of a film (JSON), by way of a Python that has Rerun's library.
///
/// # Errors
/// Why there is none, with the last words of Python.
pub fn converted(film: &str, python: &str, clock: Clock) -> Result<Vec<u8>, String> {
    let own = tempfile::tempdir().map_err(|error| error.to_string())?;
    let at = |name: &str| own.path().join(name);
    // A script called like the library would be taken for it.
    for (name, text) in [("show.py", SCRIPT), ("film.json", film)] {
        fs::write(at(name), text).map_err(|error| error.to_string())?;
    }
    let [script, source, made] = ["show.py", "film.json", "film.rrd"].map(|name| at(name).display().to_string());
    process::run(python, &[&script, &source, &made], own.path(), LIMIT, clock)?;
    fs::read(at("film.rrd")).map_err(|error| error.to_string())
}

/// Opens a recording in Rerun's viewer, and waits until it is closed.
///
/// # Errors
/// Why it cannot be started, or how it ended.
pub fn opened(recording: &Path, python: &str) -> Result<(), String> {
    let script = sentences::exec_rerun(&python);
    let status = Command::new("sh").args(["-c", &script, "rerun"]).arg(recording).status();
    match status.map_err(|error| error.to_string())? {
        status if status.success() => Ok(()),
        status => Err(sentences::it_ended_with_2(&status)),
    }
}
