//! Errors as text: the line of the file, the invalid value, and the remedy.

use std::borrow::Cow;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::Tell;
use super::cells::{counted, some};
use crate::sentences;
use files::{visible, visible_lines};
use linkage::error::Error;
use linkage::math::statistics::distinct;
use linkage::mechanism::is_unseen;

/// A text for a snippet, in which positions are counted in bytes.
/// Every invisible character that is not ASCII is replaced by a visible character of the same number of bytes.
/// The library that renders the snippet replaces invisible ASCII characters.
fn of_same_length(text: &str) -> Cow<'_, str> {
    let is_hidden = |letter: char| !letter.is_ascii() && is_unseen(letter);
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let shown = |letter: char| match (is_hidden(letter), letter.len_utf8()) {
        (false, _) => letter.to_string(),
        (true, 2) => "\u{bf}".into(),
        (true, 3) => "\u{fffd}".into(),
        (true, _) => "\u{fffd}?".into(),
    };
    Cow::Owned(text.chars().map(shown).collect())
}

/// Largest number of lines that are listed for one cause.
const MOST_LINES: usize = 12;

/// An error, and the errors found together with it, as text without a newline at its end.
/// `tell` puts the advice into words.
pub fn text(error: &Error, tell: Tell) -> String {
    all(error, tell, ("error", Level::ERROR))
}

/// The text of an error, as a warning, because the command continued as far as possible.
#[cfg(feature = "command")]
pub(crate) fn warning(error: &Error, tell: Tell) -> String {
    all(error, tell, ("warning", Level::WARNING))
}

fn all(error: &Error, tell: Tell, level: (&str, Level<'static>)) -> String {
    let each = error.by_cause().into_iter().map(|group| one(group[0], tell, &level) + &others(&group[1..]));
    each.chain(error.rest().map(|rest| format!("{}: {rest}", level.0))).collect::<Vec<_>>().join("\n\n")
}

/// Locations of further errors with the same cause.
fn others(others: &[&Error]) -> String {
    let lines = others.iter().filter_map(|error| error.place()).map(|place| place.line().to_string());
    let lines = distinct(lines);
    match lines.as_slice() {
        [] => String::new(),
        lines => {
            let place = if lines.len() == 1 { "line" } else { "lines" };
            sentences::also_in_places(&counted(others.len(), "more time"), &place, &some(lines, MOST_LINES))
        }
    }
}

fn one(error: &Error, tell: Tell, (word, level): &(&str, Level<'static>)) -> String {
    let title = match error.scenario_key() {
        Some(key) => format!("`{key}`: {}", error.message()),
        None => error.message().to_string(),
    };
    let title = visible(&title);
    let help = error.way_out_by(tell).map(|help| visible_lines(&help));
    let Some(place) = error.place() else {
        // Without a location, this function composes the text, because the renderer would draw a margin for
        // non-existent lines.
        let help = help.map(|help| format!("\n  = help: {help}")).unwrap_or_default();
        return format!("{word}: {title}{help}");
    };
    let path = visible(&place.file.display().to_string());
    let source = of_same_length(&place.text);
    // A span may end within a character, for example if a text is cut after a number of bytes.
    // Both ends are moved to the nearest outer character boundary, because the renderer would panic within a character.
    let start = (0..=place.span.start.min(source.len())).rfind(|&at| source.is_char_boundary(at)).unwrap_or(0);
    let end = (place.span.end.clamp(start, source.len())..=source.len()).find(|&at| source.is_char_boundary(at));
    let annotation = AnnotationKind::Primary.span(start..end.unwrap_or(source.len()));
    let snippet = Snippet::source(&*source).path(path.as_str()).annotation(annotation);
    let mut group = Group::with_title(level.clone().primary_title(title.as_str())).element(snippet);
    if let Some(help) = help {
        group = group.element(Level::HELP.message(help));
    }
    Renderer::plain().render(&[group])
}
