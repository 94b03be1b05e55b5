//! The common first step of every command: a scenario from a file, and names to choose from.

use std::path::Path;

use crate::scenario::Scenario;
use linkage::error::Result;

/// Reads a scenario and starts its groups in the given `modes`.
pub(super) fn load(file: &Path, modes: &[String]) -> Result<Scenario> {
    let scenario = Scenario::load(file)?;
    if modes.is_empty() { Ok(scenario) } else { scenario.with_modes(modes).map_err(|error| error.key("--mode")) }
}

/// Names of the analytic solvers, the default first.
pub(super) fn reference_names() -> Vec<&'static str> {
    analytic::all().iter().map(|solver| solver.name()).collect()
}
