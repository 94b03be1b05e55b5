//! Finds numbers of a scenario file by their paths, and replaces them.
//!
//! A path consists of the keys from the root of the file, joined by dots, as in messages.
//! An entry of a list of tables is given by its name (`joints.A.axis_deg`), or by its number from 1 if it has no name
//! (`loads[1].force_N`).

use crate::sentences;
use std::fmt::Write;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::unit;
use super::words::suggestion;
use linkage::error::{Error, ErrorKind, Result};

/// Whether a key is the path of a number rather than the key of a parameter.
pub(super) fn is_path(key: &str) -> bool {
    key.contains('.')
}

/// Replaces numbers of a file by the numbers in `set`. Keys of parameters are skipped.
///
/// # Errors
/// [`ErrorKind::Input`] for a path at which the file has no number.
pub(super) fn replace(tree: &mut DeTable, set: &[(String, f64)]) -> Result<()> {
    for (path, value) in set.iter().filter(|(key, _)| is_path(key)) {
        let Some(found) = in_table(tree, path) else {
            let mut known = Vec::new();
            each(tree, &mut String::new(), &mut known);
            let known = known.iter().map(String::as_str);
            let error = Error::new(ErrorKind::Input, sentences::the_file_has_no_number_at(path));
            return Err(error.key(path.clone()).help(suggestion(path, known, "`")));
        };
        // The number is stored as a text: a text value is read as an arithmetic expression, and a number is one.
        *found.as_mut() = DeValue::String(format!("{value:?}").into());
    }
    Ok(())
}

/// The number at a path below a table.
fn in_table<'t, 'a>(table: &'t mut DeTable<'a>, path: &str) -> Option<&'t mut Spanned<DeValue<'a>>> {
    // Names of links and points may contain dots, so every key with which the path begins is tried.
    let keys: Vec<String> = table.keys().map(|key| key.get_ref().to_string()).collect();
    let (key, rest) = keys.iter().find_map(|key| {
        Some((key, path.strip_prefix(key.as_str())?))
            .filter(|(_, rest)| rest.is_empty() || rest.starts_with(['.', '[']))
    })?;
    in_value(table.get_mut(key.as_str())?, rest)
}

/// The number at the remaining path: an empty text, `.KEY...` or `[NUMBER]...`.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
fn in_value<'t, 'a>(value: &'t mut Spanned<DeValue<'a>>, rest: &str) -> Option<&'t mut Spanned<DeValue<'a>>> {
    if rest.is_empty() {
        return is_number(value.get_ref()).then_some(value);
    }
    match value.as_mut() {
        DeValue::Table(table) => in_table(table, rest.strip_prefix('.')?),
        DeValue::Array(array) => {
            let (index, rest) = match rest.strip_prefix('[') {
                Some(rest) => {
                    let (number, rest) = rest.split_once(']')?;
                    (number.parse::<usize>().ok()?.checked_sub(1)?, rest)
                }
                None => {
                    let rest = rest.strip_prefix('.')?;
                    let begins = |value: &Spanned<DeValue>| {
                        let after = rest.strip_prefix(name(value.get_ref())?)?;
                        after.starts_with('.').then_some(after)
                    };
                    array.iter().enumerate().find_map(|(index, value)| Some((index, begins(value)?)))?
                }
            };
            in_value(array.get_mut(index)?, rest)
        }
        _ => None,
    }
}

/// The name of an entry of a list of tables.
fn name<'v>(value: &'v DeValue) -> Option<&'v str> {
    value.get("name")?.get_ref().as_str()
}

/// A plain number; `None` for any other value, and for a number that cannot be converted, such as an integer that is
/// too large.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
pub(super) fn plain_number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) => {
            i128::from_str_radix(integer.as_str(), integer.radix()).ok().map(|number| number as f64)
        }
        _ => None,
    }
}

/// Path of an entry of a list: its name, or its number from 1 if it has no name.
pub(super) fn path_of_entry(list: &str, index: usize, entry: &DeValue) -> String {
    match name(entry) {
        Some(name) => format!("{list}.{name}"),
        None => format!("{list}[{}]", index + 1),
    }
}

/// Whether a value is a number or a text. A text may be an arithmetic expression.
fn is_number(value: &DeValue) -> bool {
    matches!(value, DeValue::Integer(_) | DeValue::Float(_) | DeValue::String(_))
}

/// Adds the paths of all numbers below a table.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
fn each(table: &DeTable, path: &mut String, found: &mut Vec<String>) {
    for (key, value) in table {
        let length = path.len();
        write!(path, "{}{}", if length > 0 { "." } else { "" }, key.get_ref()).expect("a text");
        match value.get_ref() {
            // A text under a key with a unit is an arithmetic expression.
            DeValue::String(_) if unit::ending(key.get_ref()).is_some() => found.push(path.clone()),
            other => in_each(other, path, found),
        }
        path.truncate(length);
    }
}

#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
fn in_each(value: &DeValue, path: &mut String, found: &mut Vec<String>) {
    match value {
        DeValue::Table(table) => each(table, path, found),
        DeValue::Array(array) => {
            for (index, value) in array.iter().enumerate() {
                in_each(value.get_ref(), &mut path_of_entry(path, index, value.get_ref()), found);
            }
        }
        DeValue::Integer(_) | DeValue::Float(_) => found.push(path.clone()),
        _ => {}
    }
}
