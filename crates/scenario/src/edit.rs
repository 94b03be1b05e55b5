//! Changes a scenario file without changing comments, order or other text.

use crate::sentences;
use toml_edit::{DocumentMut, Item, Table, TableLike, Value, value};

use super::engine::{EngineSettings, ROWS, SECTIONS, Slot};
use super::unit::{LENGTH, NamedUnit};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;

/// Coordinates that differ by less than this fraction of the larger one count as equal.
const EQUAL: f64 = 1e-9;
/// Number of significant digits of a written number, not counting the first digit.
const DIGITS: usize = 5;

/// The text as a document that keeps its comments and its order.
pub(super) fn document(text: &str) -> Result<DocumentMut> {
    text.parse().map_err(|error| Error::new(ErrorKind::Input, sentences::the_file_is_not_valid_toml(&error)))
}

/// The parameters that are plain numbers, with their keys, in the order of the file.
///
/// # Errors
/// [`ErrorKind::Input`] if the text is not TOML.
pub fn parameters(text: &str) -> Result<Vec<(String, f64)>> {
    let document = document(text)?;
    let all = document.get("parameters").and_then(Item::as_table_like).into_iter().flat_map(TableLike::iter);
    Ok(all.filter_map(|(key, item)| Some((key.to_string(), number(item)?))).collect())
}

/// The text in which the parameter `key` has the plain number `value` (in the unit of the key), rounded to six digits.
///
/// # Errors
/// [`ErrorKind::Input`] if the text is not TOML, or if the parameter is missing or an expression.
pub fn with_parameter(text: &str, key: &str, value: f64) -> Result<String> {
    let mut document = document(text)?;
    let found = document.get_mut("parameters").and_then(Item::as_table_like_mut).and_then(|all| all.get_mut(key));
    let missing = || Error::new(ErrorKind::Input, sentences::no_plain_number(&format_args!("parameters.{key}")));
    put(found.filter(|item| number(item).is_some()).ok_or_else(missing)?, value);
    Ok(document.to_string())
}

/// The text in which the point `point` of a link is moved from `from` to `to`. These coordinates (m) are in the frame
/// of the link; for the ground, in the world frame.
/// A coordinate that is a number gets the new number. If a coordinate is the name of a parameter, or minus this name,
/// the parameter gets the new number. A coordinate that stays the same is not written.
///
/// # Errors
/// [`ErrorKind::Input`] if the text is not TOML, if it has no such point, or if a coordinate is another expression.
pub fn with_point(text: &str, link: &str, point: &str, [from, to]: [Vec2; 2]) -> Result<String> {
    let mut document = document(text)?;
    let missing = || Error::new(ErrorKind::Input, sentences::no_point(&point, &link));
    let mut parameters = Vec::new();
    let points = match link {
        "ground" => document.get_mut("ground"),
        link => document.get_mut("links").and_then(|links| links.get_mut(link)),
    };
    let place = points.and_then(|own| own.get_mut("points")).and_then(|own| own.get_mut(point));
    let place: &mut dyn TableLike = place.and_then(Item::as_table_like_mut).ok_or_else(missing)?;
    for (axis, [old, new]) in [("x", [from.x, to.x]), ("y", [from.y, to.y])] {
        if (new - old).abs() <= EQUAL * (old.abs() + new.abs()) {
            continue;
        }
        let (key, unit) = length(place, axis).ok_or_else(missing)?;
        let item = place.get_mut(&key).ok_or_else(missing)?;
        let text = item.as_str().map(|text| text.trim().to_string());
        match text {
            None => put(item, new / unit.to_si(1.0)),
            Some(text) => {
                let (name, sign) = text.strip_prefix('-').map_or((text.as_str(), 1.0), |name| (name, -1.0));
                parameters.push((name.to_string(), sign * new, format!("{link}.{point}.{key} = \"{text}\"")));
            }
        }
    }
    for (name, size, place) in parameters {
        let expression = || Error::new(ErrorKind::Input, sentences::not_one_parameter(&place));
        let all = document.get_mut("parameters").and_then(Item::as_table_like_mut).ok_or_else(expression)?;
        let (key, unit) = length(all, &name).ok_or_else(expression)?;
        let item = all.get_mut(&key).filter(|item| number(item).is_some()).ok_or_else(expression)?;
        put(item, size / unit.to_si(1.0));
    }
    Ok(document.to_string())
}

/// The key of a length in a table, such as `x_mm` for `x`, and its unit.
fn length(table: &dyn TableLike, name: &str) -> Option<(String, &'static NamedUnit)> {
    table.iter().find_map(|(key, _)| Some((key.to_string(), LENGTH.unit_of(name, key)?)))
}

/// A plain number; `None` for anything else.
pub(super) fn number(item: &Item) -> Option<f64> {
    item.as_float().or_else(|| item.as_integer().map(|whole| whole as f64))
}

/// Replaces a number. The comment after the number stays.
fn put(item: &mut Item, new: f64) {
    let Some(old) = item.as_value_mut() else { return };
    let rounded = format!("{new:.DIGITS$e}").parse().unwrap_or(new);
    let is_whole = rounded.fract() == 0.0 && rounded.abs() < 1e9;
    let mut written = if is_whole { Value::from(rounded as i64) } else { Value::from(rounded) };
    *written.decor_mut() = old.decor().clone();
    *old = written;
}

/// The text of a scenario, with the given settings as its `[engine]` section.
/// Comments, order and all other text do not change.
///
/// # Errors
/// [`ErrorKind::Input`] if the text is not TOML, or if `engine` in the text is not a section.
pub fn with_engine(text: &str, engine: EngineSettings) -> Result<String> {
    let mut document = document(text)?;
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
    fn points_and_parameters_are_changed_in_place() {
        let text = "[parameters]\nl_mm = 40 # length\nk = 2\n[ground.points]\nO = { x_m = 1, y_m = 0 } # pivot\n\
                    [links.bar.points]\nB = { x_mm = \"-l\", y_mm = 0.5 }\nC = { x_m = \"k*l\", y_m = 0 }\n";
        let longer = with_parameter(text, "l_mm", 41.25).unwrap();
        assert_eq!(longer, text.replace("l_mm = 40 #", "l_mm = 41.25 #"));
        assert!(["k_mm", "x"].iter().all(|key| with_parameter(text, key, 1.0).is_err()));
        let at = |x: f64, y: f64| Vec2::new(x, y);
        let moved = with_point(text, "ground", "O", [at(1.0, 0.0), at(1.0, 1.0 / 3.0)]).unwrap();
        assert_eq!(moved, text.replace("y_m = 0 } # pivot", "y_m = 0.333333 } # pivot"));
        let moved = with_point(text, "bar", "B", [at(-0.04, 5e-4), at(-0.05, 2e-3)]).unwrap();
        assert_eq!(moved, text.replace("l_mm = 40", "l_mm = 50").replace("y_mm = 0.5", "y_mm = 2"));
        let refused = with_point(text, "bar", "C", [at(0.08, 0.0), at(0.09, 0.0)]).unwrap_err();
        assert!(refused.message().contains("k*l"), "{}", refused.message());
        assert!(with_point(text, "bar", "D", [at(0.0, 0.0), at(1.0, 0.0)]).is_err());
    }

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
