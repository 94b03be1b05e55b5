//! The file that a found scenario is written to.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::output;
use linkage::error::Result;

/// Path of a scenario to be written: `-` or a name that ends in `.toml`.
pub(super) fn scenario_target(text: &str) -> std::result::Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if text != "-" && path.extension().is_none_or(|extension| extension != "toml") {
        return Err("a scenario is written to a file that ends in .toml, or to standard output with `-`".into());
    }
    output::writable(path)
}

/// Writes a scenario, but never over one of its source files.
pub(super) fn write_scenario(text: &str, to: &Path, sources: &[&Path]) -> Result<()> {
    let same = |source: &&Path| match (fs::canonicalize(source), fs::canonicalize(to)) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    };
    if let Some(source) = sources.iter().find(|source| same(source)) {
        let message = format!("the scenario found would overwrite {}, which it comes from", source.display());
        return output::refused("--output", message, "name another file");
    }
    output::write(text, to)
}
