//! The proof of a scenario that a synthesis has found.

use crate::sentences;
use std::path::Path;

use crate::plain::{brief, style};
use linkage::error::Result;
use prover::run::{Options, prove};
use scenario::Scenario;

/// Work allowed for finding settings: a twentieth of the work that `linkproof run` allows. Usual linkages need less. A
/// linkage almost at a dead point would take minutes with more work, and its verdict would still be inconclusive.
const BUDGET: f64 = 1e6;

/// Proves the scenario with this text and returns the verdict in one sentence.
/// If a side or the engine cannot solve the scenario, the sentence says why.
///
/// # Errors
/// The errors of [`Scenario::parse`]; `path` is the place of the file in these errors.
pub(super) fn proven(text: &str, path: &Path) -> Result<String> {
    let scenario = Scenario::parse(text, path)?;
    let options = Options { budget: Some(BUDGET), ..Options::default() };
    Ok(match prove(&scenario, &options) {
        Ok(proof) => style::plain(&brief::verdict_line(&proof)),
        Err(error) => sentences::the_scenario_is_not_proven(&error.message()),
    })
}
