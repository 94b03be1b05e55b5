//! Changes a scenario file without changing comments, order or other text.

use crate::sentences;
use toml_edit::{DocumentMut, Item, Table, value};

use super::engine::{EngineSettings, ROWS, SECTIONS, Slot};
use linkage::error::{Error, ErrorKind, Result};

/// The text of a scenario, with the given settings as its `[engine]` section.
/// Comments, order and all other text do not change.
///
/// # Errors
/// [`ErrorKind::Input`] if the text is not TOML, or if `engine` in the text is not a section.
pub fn with_engine(text: &str, engine: EngineSettings) -> Result<String> {
    let mut document: DocumentMut =
        text.parse().map_err(|error| Error::new(ErrorKind::Input, sentences::the_file_is_not_valid_toml(&error)))?;
    if document.get("engine").is_none() {
        document.insert("engine", Item::Table(Table::new()));
    }
    let Some(table) = document.get_mut("engine").and_then(Item::as_table_mut) else {
        let error = Error::new(ErrorKind::Input, sentences::ENGINE_IS_NOT_A_SECTION);
        return Err(error.help(sentences::WRITE_IT_AS_ENGINE));
    };
    table.clear();
    fill(table, engine);
    Ok(document.to_string())
}

/// The text of the `[engine]` section alone, ready to paste.
#[must_use]
pub fn engine_section(engine: EngineSettings) -> String {
    let mut table = Table::new();
    fill(&mut table, engine);
    format!("[engine]\n{table}")
}

fn fill(table: &mut Table, mut engine: EngineSettings) {
    let count = |count: usize| value(i64::try_from(count).unwrap_or(i64::MAX));
    for row in ROWS {
        let Some(key) = SECTIONS[0].keys.iter().find(|key| Some(key.name) == row.key) else { continue };
        let item = match (row.slot)(&mut engine) {
            Slot::Positive(number) => number.get().map(value),
            Slot::Engines(engines) => engines.value().and_then(|own| own.first().copied()).map(|own| value(own.name())),
            Slot::Count(number) | Slot::Times(number) => number.get().map(count),
            Slot::Route(route) => route.get().map(|route| value(route.name())),
        };
        if let Some(item) = item {
            // The first spelling is the key in SI units.
            table.insert(&key.spellings()[0], item);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{EngineName, EngineSetting};

    #[test]
    fn only_the_engine_section_changes() {
        let text =
            "# mine\nname = 'a'  # kept\n\n[engine]\nstep_deg = 0.5 # coarse\n\n[tolerances]\nengine_rel = 1e-2\n";
        let keys = EngineSettings {
            engines: EngineSetting::of(vec![EngineName::Impulse]),
            step: EngineSetting::of(2.5e-4),
            sweeps: EngineSetting::of(64),
            extrapolated: EngineSetting::of(1),
            ..EngineSettings::default()
        };
        let stepped = || EngineSettings { step: EngineSetting::of(1.0), ..EngineSettings::default() };
        let changed = with_engine(text, keys.clone()).unwrap();
        assert!(changed.starts_with("# mine\nname = 'a'  # kept\n\n[engine]\n"), "{changed}");
        assert!(changed.ends_with("[tolerances]\nengine_rel = 1e-2\n"), "{changed}");
        for line in ["dt_s = 0.00025", "name = \"impulse\"", "sweeps = 64", "extrapolated = 1"] {
            assert!(changed.lines().any(|found| found == line), "{line}: {changed}");
        }
        assert!(!changed.contains("step_deg") && !changed.contains("route"), "{changed}");
        let added = with_engine("name = 'a'\n", stepped()).unwrap();
        assert!(added.contains("[engine]\ndt_s = 1.0"), "{added}");
        assert!(["engine = 1\n", "["].iter().all(|text| with_engine(text, keys.clone()).is_err()));
        assert_eq!(engine_section(stepped()), "[engine]\ndt_s = 1.0\n");
    }
}
