//! The `[engine]` section that keeps settings which a command has found.

use crate::sentences;
use std::io::{self, Write};
use std::path::Path;

use files::{self, OutputTarget};
use linkage::engine::Settings;
use linkage::error::Result;
use prover::engines::named;

use scenario::{EngineSetting, EngineSettings};
use scenario::{Scenario, edit};

/// What a scenario must state to run an engine at `settings`. The engine's usual route is left out unless the scenario
/// states one: without it the engine's own forces are judged too.
pub(super) fn keys(scenario: &Scenario, name: &str, settings: Settings) -> EngineSettings {
    let Some(engine) = named(name, settings.resolution) else { return EngineSettings::default() };
    let own = &scenario.engine;
    let usual = engine.routes().first().copied();
    let mut keys = EngineSettings::exactly(engine.with(settings).as_ref());
    // For an engine that chooses its own steps, the scenario's step stays: it belongs to the other engines.
    if engine.controls_error() {
        keys.step = own.step.clone();
    }
    if own.route.is_free() && usual == Some(settings.route) {
        keys.route = EngineSetting::Free;
    }
    keys.substeps = EngineSetting::from(Some(settings.substeps).filter(|&substeps| substeps > 1));
    keys.extrapolated = EngineSetting::from(Some(settings.extrapolated).filter(|&times| times > 0));
    keys
}

/// Writes the section into the scenario's file. Everything else in the file stays as it is.
///
/// # Errors
/// [`ErrorKind::Io`] if the file cannot be written, and those of [`edit::with_engine`].
pub(super) fn write(file: &Path, scenario: &Scenario, keys: EngineSettings) -> Result<()> {
    let text = edit::with_engine(&scenario.text, keys)?;
    files::replace(&OutputTarget::Named(file), |mut to| to.write_all(text.as_bytes())).map_err(|error: io::Error| {
        let usual = sentences::CHECK_THAT_THE_FILE_MAY_BE_WRITTEN;
        files::unwritten(&file.display().to_string(), &error, Some(text.len() as u64), usual)
    })
}
