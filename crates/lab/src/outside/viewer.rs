//! Writes recordings with Rerun's library for Python, and opens recordings in Rerun's viewer.

use crate::sentences;
use std::fs;
use std::path::Path;
use std::process::Command;

use super::process;
use crate::bench::Clock;

/// Script that writes a film (a moving mechanism, as JSON) as a recording of Rerun.
/// The script uses Rerun's library, because no other library knows the format.
const SCRIPT: &str = include_str!("rerun.py");
/// Longest duration of the conversion of a film to a recording (s).
const LIMIT: f64 = 120.0;

/// Converts a film (JSON) to a recording of Rerun with its blueprint, using a Python that has Rerun's library.
///
/// # Errors
/// The reason of the failure, with the last line of Python's error output.
pub fn converted(film: &str, python: &str, clock: Clock) -> Result<Vec<u8>, String> {
    let own = tempfile::tempdir().map_err(|error| error.to_string())?;
    let at = |name: &str| own.path().join(name);
    // A script with the library's name would be imported by Python in place of the library.
    for (name, text) in [("show.py", SCRIPT), ("film.json", film)] {
        fs::write(at(name), text).map_err(|error| error.to_string())?;
    }
    let [script, source, made] = ["show.py", "film.json", "film.rrd"].map(|name| at(name).display().to_string());
    process::run(python, &[&script, &source, &made], own.path(), LIMIT, clock)?;
    fs::read(at("film.rrd")).map_err(|error| error.to_string())
}

/// Opens a recording in Rerun's viewer, and waits until the viewer is closed.
///
/// # Errors
/// The reason why the viewer cannot be started, or its exit status.
pub fn opened(recording: &Path, python: &str) -> Result<(), String> {
    let script = sentences::exec_rerun(&python);
    let status = Command::new("sh").args(["-c", &script, "rerun"]).arg(recording).status();
    match status.map_err(|error| error.to_string())? {
        status if status.success() => Ok(()),
        status => Err(sentences::it_ended_with_2(&status)),
    }
}
