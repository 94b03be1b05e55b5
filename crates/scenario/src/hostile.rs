//! What no text of a file may hold: letters that a reader does not see, and texts of any length.
//!
//! Titles, sources and names go into reports, tables, drawings and recordings. A line break there would forge a line of
//! a report, an escape character would command a terminal, and a change of direction would show another name than the
//! one that is meant.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use linkage::error::{Error, ErrorKind, Place, Result};
use linkage::mechanism::{LONGEST_NAME, is_unseen};

/// Longest text (characters).
const LONGEST_TEXT: usize = 10_000;

/// Most signs that begin a value or a table, dots of decimals included. A value takes some 200 bytes once it is read,
/// whatever its length in the file: the memory is told before it is taken.
const MOST_VALUES: usize = 2_000_000;

/// Most parts of a file: tables, such as points, links, joints, loads and formulas. Costs grow with the square of their
/// number in several places; with so many they are seconds. Published numbers do not count.
const MOST_PARTS: usize = 30_000;
const UNCOUNTED: &str = "oracle";

/// Gives the place of a range of bytes in the file.
type Places<'a> = &'a dyn Fn(Range<usize>) -> Place;

/// Checks that a text can be read without taking up the memory: how many values it may have at most.
///
/// # Errors
/// [`ErrorKind::Input`] with the place of the first value too many.
pub fn check_size(source: Places, text: &str) -> Result<()> {
    let mut signs = text.bytes().enumerate().filter(|(_, byte)| matches!(byte, b',' | b'=' | b'[' | b'{' | b'.'));
    match signs.nth(MOST_VALUES) {
        None => Ok(()),
        Some((at, _)) => {
            let message = format!("the file has more than {MOST_VALUES} values (signs `,` `=` `[` `{{` `.`)");
            Err(Error::new(ErrorKind::Input, message).at(source(at..at + 1)).help(
                "divide it, or take a coarser grid; long columns of published numbers belong in a table (`file`)",
            ))
        }
    }
}

/// Checks all keys and texts of a file.
///
/// # Errors
/// [`ErrorKind::Input`] with the place and the key of the first that is refused.
pub fn check(source: Places, tree: &DeTable) -> Result<()> {
    table(source, tree, "", &mut 0)
}

fn table(source: Places, table: &DeTable, path: &str, parts: &mut usize) -> Result<()> {
    for (key, value) in table {
        let place = || source(key.span());
        let name: &str = key.get_ref();
        let refused = |message: String, help: &str| {
            let error = Error::new(ErrorKind::Input, message).at(place()).help(help);
            Err(if path.is_empty() { error } else { error.key(path) })
        };
        if name.contains(is_unseen) {
            return refused("a key holds a letter that is not seen".into(), UNSEEN_HELP);
        }
        if name.chars().count() > LONGEST_NAME {
            return refused(format!("a key has more than {LONGEST_NAME} letters"), "give it a shorter name");
        }
        let path = if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
        any(source, value, &path, parts)?;
    }
    Ok(())
}

const UNSEEN_HELP: &str = "take out line breaks, control characters and changes of the writing direction";

#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
fn any(source: Places, value: &Spanned<DeValue>, path: &str, parts: &mut usize) -> Result<()> {
    let refused = |message: String, help: &str| {
        Err(Error::new(ErrorKind::Input, message).key(path).at(source(value.span())).help(help))
    };
    match value.get_ref() {
        DeValue::String(text) if text.contains(is_unseen) => {
            refused("the text holds a letter that is not seen".into(), UNSEEN_HELP)
        }
        DeValue::String(text) if text.chars().count() > LONGEST_TEXT => {
            refused(format!("the text has more than {LONGEST_TEXT} letters"), "shorten it")
        }
        DeValue::Table(_) if *parts >= MOST_PARTS => refused(
            format!(
                "the file has more than {MOST_PARTS} parts (points, links, joints, loads, formulas and other tables)"
            ),
            "divide it into several files",
        ),
        DeValue::Table(own) => {
            *parts += usize::from(!path.starts_with(UNCOUNTED));
            table(source, own, path, parts)
        }
        DeValue::Array(array) => array.iter().try_for_each(|element| any(source, element, path, parts)),
        _ => Ok(()),
    }
}
