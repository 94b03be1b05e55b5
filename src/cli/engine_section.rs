//! The `[engine]` section that keeps settings which a command has found.

use std::io::{self, Write};
use std::path::Path;

use files::{self, Target};
use linkage::engine::Settings;
use linkage::error::Result;
use prover::engines::named;
use scenario::{EngineKeys, Scenario, edit};

/// What a scenario must state to run an engine at `settings`: its step (s), and its other keys. The engine's usual
/// route is left out unless the scenario states one: without it the engine's own forces are judged too.
pub(super) fn keys(scenario: &Scenario, name: &str, settings: Settings) -> (Option<f64>, EngineKeys) {
    let Settings { resolution, sweeps, substeps, route, extrapolated } = settings;
    let engine = named(name, resolution);
    // For an engine that chooses its own steps, the scenario's step stays: it belongs to the other engines.
    let chooses = engine.as_ref().is_some_and(|engine| engine.controls_error());
    let usual = engine.as_ref().and_then(|engine| engine.routes().first().copied());
    let keys = EngineKeys {
        name: Some(name.into()),
        sweeps: (sweeps > 0).then_some(sweeps),
        substeps: (substeps > 1).then_some(substeps),
        route: (scenario.engine.route.is_some() || usual != Some(route)).then(|| route.name().into()),
        extrapolated: (extrapolated > 0).then_some(extrapolated),
    };
    (if chooses { scenario.dt } else { Some(resolution) }, keys)
}

/// Writes the section into the scenario's file. Everything else in the file stays as it is.
///
/// # Errors
/// [`ErrorKind::Io`] if the file cannot be written, and those of [`edit::with_engine`].
pub(super) fn write(file: &Path, scenario: &Scenario, keys: (Option<f64>, EngineKeys)) -> Result<()> {
    let text = edit::with_engine(&scenario.text, keys)?;
    files::replace(&Target::Named(file), |mut to| to.write_all(text.as_bytes())).map_err(|error: io::Error| {
        let usual = "check that the file may be written to, or copy the section by hand";
        files::unwritten(&file.display().to_string(), &error, Some(text.len() as u64), usual)
    })
}
