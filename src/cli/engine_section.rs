//! The `[engine]` section, which stores the settings that a command has found.

use crate::sentences;
use std::io::{self, Write};
use std::path::Path;

use files::{self, OutputTarget};
use linkage::engine::Settings;
use linkage::error::Result;
use prover::engines::named;

use scenario::{EngineSetting, EngineSettings, Scenario, edit};

/// The keys with which a scenario runs an engine at `settings`.
/// The route is omitted if it is the engine's usual route and the scenario states no route.
/// Without a stated route, a proof also judges the forces that the engine itself exerts.
pub(super) fn keys(scenario: &Scenario, name: &str, settings: Settings) -> EngineSettings {
    let Some(engine) = named(name, settings.resolution) else { return EngineSettings::default() };
    let own = &scenario.engine;
    let usual = engine.routes().first().copied();
    let mut keys = EngineSettings::exactly(engine.with(settings).as_ref());
    // An engine that chooses its own steps has no step to store. The step in the scenario is kept, for other engines.
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

/// Writes the section into the scenario's file and leaves the rest of the file unchanged.
///
/// # Errors
/// [`ErrorKind::Io`] if the file cannot be written, and the errors of [`edit::with_engine`].
pub(super) fn write(file: &Path, scenario: &Scenario, keys: EngineSettings) -> Result<()> {
    let text = edit::with_engine(&scenario.text, keys)?;
    files::replace(&OutputTarget::Named(file), |mut to| to.write_all(text.as_bytes())).map_err(|error: io::Error| {
        let usual = sentences::CHECK_THAT_THE_FILE_MAY_BE_WRITTEN;
        files::unwritten(&file.display().to_string(), &error, Some(text.len() as u64), usual)
    })
}
