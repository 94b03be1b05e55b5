//! Every key and every word that describes a mechanism in a scenario, and every channel of a trajectory, is tested by
//! an independent number.
//! The lists are the tables of the program, so the test fails for a new key, word or channel without a number.

use std::collections::BTreeSet;
use std::path::PathBuf;

use linkage::trajectory::CHANNELS;
use scenario::keys::{ValueKind, section};
use toml_edit::{Item, TableLike, Value};

use super::{SOURCE, files, loaded};

/// Sections that describe a mechanism, its motion and its loads.
const SECTIONS: [&str; 13] = [
    "links.*",
    "links.*.points.*",
    "links.*.mass_centre",
    "joints",
    "transmissions",
    "transmissions.motion",
    "drive",
    "drive.points",
    "motor",
    "motor.points",
    "gravity",
    "loads",
    "loads.table",
];
/// Keys on which no number of a trajectory depends: one for pictures, one for notes about the motor.
const WITHOUT_NUMBERS: [&str; 2] = ["drawn", "rated_torque"];

/// Files with independent numbers.
fn with_numbers() -> Vec<PathBuf> {
    let all = files("scenarios").into_iter().chain(files("tests/outside/scenarios"));
    all.filter(|path| loaded(path).oracles.iter().any(|own| own.source.starts_with(SOURCE))).collect()
}

/// Collects the keys at `path`.
/// If the value of a key is a text, the pair of key and text is collected.
fn collect(table: &dyn TableLike, path: &[&str], found: &mut BTreeSet<(String, String)>) {
    let Some((first, rest)) = path.split_first() else {
        for (key, item) in table.iter() {
            found.insert((key.into(), item.as_str().unwrap_or_default().into()));
        }
        return;
    };
    for (_, item) in table.iter().filter(|(key, _)| *first == "*" || key == first) {
        below(item, rest, found);
    }
}

fn below(item: &Item, path: &[&str], found: &mut BTreeSet<(String, String)>) {
    if let Some(table) = item.as_table_like() {
        collect(table, path, found);
    } else if let Some(tables) = item.as_array_of_tables() {
        tables.iter().for_each(|table| collect(table, path, found));
    } else if let Some(values) = item.as_array() {
        values.iter().filter_map(Value::as_inline_table).for_each(|table| collect(table, path, found));
    }
}

#[test]
fn every_key_unit_and_word_has_external_numbers() {
    let texts: Vec<toml_edit::DocumentMut> =
        with_numbers().iter().map(|path| std::fs::read_to_string(path).unwrap().parse().unwrap()).collect();
    let mut missing = Vec::new();
    for path in SECTIONS {
        let own = section(path).unwrap_or_else(|| panic!("there is no section {path}"));
        let parts: Vec<&str> = path.split('.').collect();
        let mut found = BTreeSet::new();
        texts.iter().for_each(|text| collect(text.as_table(), &parts, &mut found));
        let keys: BTreeSet<&str> = found.iter().map(|(key, _)| key.as_str()).collect();
        for key in own.keys.iter().filter(|key| !WITHOUT_NUMBERS.contains(&key.name)) {
            let spelled = key.spellings().into_iter().filter(|spelling| !keys.contains(spelling.as_str()));
            missing.extend(spelled.map(|spelling| format!("{path}: {spelling}")));
            if let ValueKind::Choice(words) = key.kind {
                let has = |word: &&&str| found.contains(&(key.name.into(), (**word).into()));
                // A file need not state a default, so default words are skipped.
                let words = words();
                let said = words.iter().filter(|word| !has(word) && !key.default.contains(&format!("\"{word}\"")));
                missing.extend(said.map(|word| format!("{path}: {} = {word:?}", key.name)));
            }
        }
    }
    assert!(missing.is_empty(), "no independent number depends on these: {missing:#?}");
}

#[test]
fn every_channel_has_an_external_number() {
    let scenarios: Vec<_> = with_numbers().iter().map(|path| loaded(path)).collect();
    let oracles = scenarios.iter().flat_map(|scenario| &scenario.oracles).filter(|own| own.source.starts_with(SOURCE));
    let series: Vec<_> = oracles.flat_map(|own| &own.series).collect();
    for kind in &CHANNELS {
        // A number near zero does not test the scale, so it does not count.
        let says = |value: f64, bound: f64| value.abs() > 1e3 * bound;
        let has = series.iter().any(|own| {
            std::ptr::eq(own.channel.kind, kind) && own.points.iter().any(|point| says(point.value, point.bound))
        });
        assert!(has, "{:?} {} has no independent number", kind.subject, kind.suffix);
    }
}
