//! The proof of a scenario that a synthesis has found.

use crate::sentences;
use std::path::Path;

use crate::plain::{brief, style};
use linkage::error::Result;
use prover::run::{Options, prove};
use scenario::Scenario;

/// Proves the scenario with this text, as `linkproof run` does, and returns the verdict in one sentence.
/// If a side or the engine cannot solve the scenario, the sentence says why.
///
/// # Errors
/// The errors of [`Scenario::parse`]; `path` is the place of the file in these errors.
pub(super) fn proven(text: &str, path: &Path) -> Result<String> {
    let scenario = Scenario::parse(text, path)?;
    Ok(match prove(&scenario, &Options::default()) {
        Ok(proof) => style::plain(&brief::verdict_line(&proof)),
        Err(error) => sentences::the_scenario_is_not_proven(&error.message()),
    })
}
