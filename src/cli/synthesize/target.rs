//! The file that a found scenario is written to.

use crate::sentences;
use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::output;
use linkage::error::Result;

/// Path of a scenario to be written: `-` or a name that ends in `.toml`.
pub(super) fn scenario_target(text: &str) -> std::result::Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if text != "-" && path.extension().is_none_or(|extension| extension != "toml") {
        return Err(sentences::A_SCENARIO_IS_WRITTEN_TO_A_FILE.into());
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
        let message = sentences::the_scenario_found_would_overwrite(&source.display());
        return output::refused("--output", message, sentences::NAME_ANOTHER_FILE);
    }
    output::write(text, to)
}
