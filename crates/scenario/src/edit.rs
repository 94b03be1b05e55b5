//! Changes a scenario file without touching what people wrote in it.

use toml_edit::{DocumentMut, Item, Table, value};

use super::settings::EngineKeys;
use linkage::error::{Error, ErrorKind, Result};

/// The text of a scenario with another `[engine]` section: its step (s) and the given keys. Comments, order and
/// everything else stay.
///
/// # Errors
/// [`ErrorKind::Input`] if the text is not TOML, or if `engine` in it is not a section.
pub fn with_engine(text: &str, engine: (Option<f64>, EngineKeys)) -> Result<String> {
    let mut document: DocumentMut =
        text.parse().map_err(|error| Error::new(ErrorKind::Input, format!("the file is not valid TOML: {error}")))?;
    if document.get("engine").is_none() {
        document.insert("engine", Item::Table(Table::new()));
    }
    let Some(table) = document.get_mut("engine").and_then(Item::as_table_mut) else {
        return Err(Error::new(ErrorKind::Input, "`engine` is not a section").help("write it as `[engine]`"));
    };
    table.clear();
    fill(table, engine);
    Ok(document.to_string())
}

/// The `[engine]` section alone, to paste.
#[must_use]
pub fn engine_section(engine: (Option<f64>, EngineKeys)) -> String {
    let mut table = Table::new();
    fill(&mut table, engine);
    format!("[engine]\n{table}")
}

fn fill(table: &mut Table, (step, keys): (Option<f64>, EngineKeys)) {
    let count = |count: usize| value(i64::try_from(count).unwrap_or(i64::MAX));
    let EngineKeys { name, sweeps, substeps, route, extrapolated } = keys;
    let items = [
        ("dt_s", step.map(value)),
        ("name", name.map(value)),
        ("sweeps", sweeps.map(count)),
        ("substeps", substeps.map(count)),
        ("route", route.map(value)),
        ("extrapolated", extrapolated.map(count)),
    ];
    for (key, item) in items {
        if let Some(item) = item {
            table.insert(key, item);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_engine_section_changes() {
        let text =
            "# mine\nname = 'a'  # kept\n\n[engine]\nstep_deg = 0.5 # coarse\n\n[tolerances]\nengine_rel = 1e-2\n";
        let keys = EngineKeys {
            name: Some("impulse".into()),
            sweeps: Some(64),
            extrapolated: Some(1),
            ..EngineKeys::default()
        };
        let changed = with_engine(text, (Some(2.5e-4), keys.clone())).unwrap();
        assert!(changed.starts_with("# mine\nname = 'a'  # kept\n\n[engine]\n"), "{changed}");
        assert!(changed.ends_with("[tolerances]\nengine_rel = 1e-2\n"), "{changed}");
        for line in ["dt_s = 0.00025", "name = \"impulse\"", "sweeps = 64", "extrapolated = 1"] {
            assert!(changed.lines().any(|found| found == line), "{line}: {changed}");
        }
        assert!(!changed.contains("step_deg") && !changed.contains("route"), "{changed}");
        let added = with_engine("name = 'a'\n", (Some(1.0), EngineKeys::default())).unwrap();
        assert!(added.contains("[engine]\ndt_s = 1.0"), "{added}");
        assert!(["engine = 1\n", "["].iter().all(|text| with_engine(text, (Some(1.0), keys.clone())).is_err()));
        assert_eq!(engine_section((Some(1.0), EngineKeys::default())), "[engine]\ndt_s = 1.0\n");
    }
}
