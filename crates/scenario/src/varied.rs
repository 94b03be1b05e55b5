//! The numbers of a scenario file that an exercise may change, and the text of the file with other numbers.
//!
//! If the file has parameters, an exercise changes only the parameters.
//! Without parameters, an exercise changes the coordinates of the points, the speed of the drive, the masses and the
//! loads.

use crate::sentences;
use std::collections::BTreeMap;
use toml_edit::{DocumentMut, Item, TableLike, value};

use super::edit::{document, number};
use super::unit::{self, NamedUnit};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;

linkage::words! {
    /// Numbers of a scenario file that an exercise may change.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum NumberSort: name {
        /// Lengths of links and positions of pivots.
        Lengths = "lengths",
        /// Speeds of drives.
        Speed = "speed",
        /// Masses. In a file without parameters, the moment of inertia of a link is scaled with the link's mass.
        Masses = "masses",
        /// Forces and moments of loads.
        Loads = "loads",
    }
}

/// One number of a scenario file.
#[derive(Clone, Debug)]
pub struct VariedNumber {
    /// Keys from the root of the file to the number; entries of a list have their index as the key.
    pub path: Vec<String>,
    /// Kind of quantity that the number states.
    pub sort: NumberSort,
    /// The number, in the unit of its key.
    pub value: f64,
    unit: &'static NamedUnit,
}

/// Keys and sections that are valid only for the original numbers.
/// The section `engine` is valid only for the original numbers, because the best settings of an engine depend on the
/// dimensions.
const OWN: [&str; 5] = ["oracle", "formula", "source", "engine", "clearance"];

/// All numbers of a file that an exercise may change, in the order of the file.
///
/// # Errors
/// [`ErrorKind::Input`] if the text is not TOML.
pub fn varied_numbers(text: &str) -> Result<Vec<VariedNumber>> {
    let mut document = document(text)?;
    listed(&mut document);
    let root = document.as_item();
    let has_parameters = root.get("parameters").and_then(Item::as_table_like).is_some_and(|own| !own.is_empty());
    let mut found = Vec::new();
    let mut put = |path: &[String], number: f64| {
        let key = path.last().map_or("", String::as_str);
        let Some((family, unit)) = unit::ending(key).filter(|_| number != 0.0) else { return };
        let is = |other: &unit::UnitFamily| std::ptr::eq(family, other);
        let is_under = |section: &str| path[0] == section;
        let sort = if is(&unit::LENGTH) && (has_parameters || path.iter().any(|key| key == "points")) {
            NumberSort::Lengths
        } else if (is(&unit::ANGULAR_SPEED) || is(&unit::SPEED)) && (has_parameters || is_under("drive")) {
            NumberSort::Speed
        } else if is(&unit::MASS) {
            NumberSort::Masses
        } else if (is(&unit::FORCE) || is(&unit::MOMENT)) && (has_parameters || is_under("loads")) {
            NumberSort::Loads
        } else {
            return;
        };
        found.push(VariedNumber { path: path.to_vec(), sort, value: number, unit });
    };
    let sections: &[&str] = if has_parameters { &["parameters"] } else { &["ground", "links", "drive", "loads"] };
    for section in sections {
        if let Some(item) = root.get(section) {
            each(item, &mut vec![(*section).to_string()], &mut put);
        }
    }
    Ok(found)
}

/// Visits all numbers below an item, in the order of the file.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
fn each(item: &Item, path: &mut Vec<String>, put: &mut dyn FnMut(&[String], f64)) {
    let mut inside = |key: String, item: &Item| {
        path.push(key);
        each(item, path, put);
        path.pop();
    };
    match item {
        Item::ArrayOfTables(tables) => {
            tables.iter().enumerate().for_each(|(index, table)| inside(index.to_string(), &Item::Table(table.clone())));
        }
        item => match (item.as_table_like(), number(item)) {
            (Some(table), _) => table.iter().for_each(|(key, item)| inside(key.into(), item)),
            (None, Some(number)) => put(path, number),
            (None, None) => {}
        },
    }
}

impl VariedNumber {
    /// A number near `wanted` (in the unit of the key) with few digits.
    /// Lengths from 20 mm on are whole millimetres, smaller lengths whole tenths of a millimetre.
    /// Speeds from 20 on are whole units, smaller speeds whole tenths.
    /// Masses and loads have two significant digits.
    /// A number that would be rounded to zero has more digits.
    #[must_use]
    pub fn sensible(&self, wanted: f64) -> f64 {
        let in_unit = self.unit.to_si(1.0);
        let (tenth, unit) = match self.sort {
            NumberSort::Lengths => (20e-3 / in_unit, 1e-3 / in_unit),
            NumberSort::Speed => (20.0, 1.0),
            NumberSort::Masses | NumberSort::Loads => (0.0, 10f64.powf(wanted.abs().log10().floor() - 1.0)),
        };
        let mut step = if wanted.abs() >= tenth { unit } else { unit / 10.0 };
        while (wanted / step).round() == 0.0 {
            step /= 10.0;
        }
        // The number is printed with the decimals of the step and read back, so that the file shows no binary rounding
        // errors.
        let decimals = (-step.log10() + 1e-9).ceil().larger(0.0) as usize;
        format!("{:.decimals$}", (wanted / step).round() * step).parse().unwrap_or(wanted)
    }
}

/// The text of a scenario file, in which the scenario has the name `name`, and some numbers have the new values given
/// in `numbers`.
/// Sections that are valid only for the original numbers are left out.
/// If `numbers` is not empty, comments and the parts of the title that contain digits are left out too.
/// The coordinates of a link's mass centre are multiplied by the ratio, new to old, of the link's coordinate with the
/// largest magnitude. The moment of inertia of a link is multiplied by the ratio of the link's masses.
pub fn with_numbers(text: &str, name: &str, numbers: &[(VariedNumber, f64)]) -> Result<String> {
    let bare = if numbers.is_empty() { text.to_string() } else { without_comments(text) };
    let mut document = document(&bare)?;
    listed(&mut document);
    for key in OWN.iter().filter(|key| **key != "engine" || !numbers.is_empty()) {
        document.remove(key);
    }
    document["name"] = value(name);
    if let (Some(title), false) = (document.get("title").and_then(Item::as_str), numbers.is_empty()) {
        let has_digit = |part: &&str| part.contains(|sign: char| sign.is_ascii_digit());
        let kept: Vec<&str> = title.split(", ").filter(|part| !has_digit(part)).collect();
        document["title"] = value(kept.join(", "));
    }
    // `stretched` has two numbers for every link: the largest magnitude of its changed coordinates, and the new value
    // of this coordinate divided by the old value. `heavier` has the new mass of every link divided by the old mass.
    let mut stretched: BTreeMap<&str, (f64, f64)> = BTreeMap::new();
    let mut heavier: BTreeMap<&str, f64> = BTreeMap::new();
    for (number, new) in numbers {
        *entry(document.as_item_mut(), &number.path)? = value(*new);
        if let [section, link, rest @ ..] = &number.path[..]
            && section == "links"
        {
            let ratio = new / number.value;
            match number.sort {
                NumberSort::Masses => drop(heavier.insert(link, ratio)),
                NumberSort::Lengths if rest.first().is_some_and(|key| key == "points") => {
                    let own = stretched.entry(link).or_insert((0.0, 1.0));
                    if number.value.abs() > own.0 {
                        *own = (number.value.abs(), ratio);
                    }
                }
                NumberSort::Lengths | NumberSort::Speed | NumberSort::Loads => {}
            }
        }
    }
    let mut scaled = |path: &[&str], ratio: f64| {
        let path: Vec<String> = path.iter().map(ToString::to_string).collect();
        let Ok(item) = entry(document.as_item_mut(), &path) else { return };
        let table: &mut dyn TableLike = match item.as_table_like_mut() {
            Some(table) => table,
            None => return,
        };
        for (key, item) in table.iter_mut() {
            let is_meant = path.len() == 3 || key.get().starts_with("inertia_");
            if let (Some(old), true) = (number(item).filter(|old| *old != 0.0), is_meant && ratio != 1.0) {
                *item = value(format!("{:.4e}", old * ratio).parse::<f64>().unwrap_or(old));
            }
        }
    };
    for (link, (_, ratio)) in stretched {
        scaled(&["links", link, "mass_centre"], ratio);
    }
    for (link, ratio) in heavier {
        scaled(&["links", link], ratio);
    }
    Ok(document.to_string())
}

/// Writes the loads and transmissions as `[[loads]]` and `[[transmissions]]` if the file has them as arrays of inline
/// tables.
pub(super) fn listed(document: &mut DocumentMut) {
    for section in ["loads", "transmissions"] {
        if let Some(item) = document.get_mut(section) {
            let old = std::mem::take(item);
            *item = old.into_array_of_tables().map_or_else(|old| old, Item::ArrayOfTables);
        }
    }
}

/// The text without its comments, because a comment may state original numbers.
pub(super) fn without_comments(text: &str) -> String {
    let line = |line: &str| {
        let quotes = |part: &str| part.matches(['"', '\'']).count() % 2;
        let at = line.match_indices('#').map(|(at, _)| at).find(|&at| quotes(&line[..at]) == 0);
        at.map_or(line, |at| &line[..at]).trim_end().to_string()
    };
    let lines: Vec<String> = text.lines().map(line).collect();
    let is_kept =
        |at: &usize| !lines[*at].is_empty() || at.checked_sub(1).is_some_and(|before| !lines[before].is_empty());
    (0..lines.len()).filter(is_kept).map(|at| lines[at].clone() + "\n").collect()
}

/// The item at a path of keys.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
fn entry<'a>(item: &'a mut Item, path: &[String]) -> Result<&'a mut Item> {
    let missing = || {
        Error::new(ErrorKind::Input, sentences::the_file_has_no_number_at(&path.join(".")))
            .help(sentences::GIVE_THE_TEXT_WHOSE_NUMBERS_THESE_ARE)
    };
    let Some((key, rest)) = path.split_first() else { return Ok(item) };
    let inner = match item {
        // An entry of a list of tables is not an `Item`, so the last key is looked up here.
        Item::ArrayOfTables(tables) => {
            let table = key.parse().ok().and_then(|index: usize| tables.get_mut(index)).ok_or_else(missing)?;
            return match rest {
                [last] => table.get_mut(last).ok_or_else(missing),
                _ => Err(missing()),
            };
        }
        item => item.as_table_like_mut().and_then(|table| table.get_mut(key)).ok_or_else(missing)?,
    };
    entry(inner, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "name = 'a' # mine\ntitle = 'b, 130 rpm'\nsource = 'c'\n[ground.points]\n\
        O = { x_m = 0, y_mm = 150 }\n\
        [links.crank]\nmass_kg = 2\ninertia_kg_m2 = 0.01\nmass_centre = { x_m = 0.1, y_m = 0 }\n[links.crank.points]\n\
        A = { x_m = 0.2, y_m = 0 }\n[drive]\nspeed_rpm = 130\n[[loads]]\nforce_N = 100\n[engine]\nstep_deg = 1\n";

    #[test]
    fn numbers_are_found_changed_and_rounded() {
        let found = varied_numbers(TEXT).unwrap();
        let told: Vec<String> = found.iter().map(|own| format!("{} {}", own.path.join("."), own.value)).collect();
        let expected = [
            "ground.points.O.y_mm 150",
            "links.crank.mass_kg 2",
            "links.crank.points.A.x_m 0.2",
            "drive.speed_rpm 130",
            "loads.0.force_N 100",
        ];
        assert_eq!(told, expected);
        let sensible: Vec<f64> = found.iter().map(|own| own.sensible(1.0451 * own.value)).collect();
        assert_eq!(sensible, [157.0, 2.1, 0.209, 136.0, 100.0]);
        let changed: Vec<_> = found.into_iter().zip(sensible).collect();
        let text = with_numbers(TEXT, "k", &changed).unwrap();
        for line in
            ["name = \"k\"\ntitle = \"b\"\n", "y_mm = 157.0", "x_m = 0.209", "mass_centre = { x_m = 0.1045, y_m = 0 }"]
        {
            assert!(text.contains(line), "{line}: {text}");
        }
        assert!(
            text.contains("inertia_kg_m2 = 0.0105") && !text.contains("engine") && !text.contains("source"),
            "{text}"
        );
        assert!(with_numbers("name = 'a'\n", "k", &changed).is_err());
    }

    #[test]
    fn parameters_replace_all_other_numbers() {
        let parameters = "[parameters]\na_mm = 3.26\nn = 2\nspeed_rpm = 12.34\n";
        let text = TEXT.replace("= 130", "= 'speed_rpm'") + parameters;
        let found = varied_numbers(&text).unwrap();
        let told: Vec<f64> = found.iter().map(|own| own.sensible(own.value)).collect();
        assert_eq!(told, [3.3, 12.3]);
    }
}
