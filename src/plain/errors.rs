//! Errors: the line of the file concerned, what was found there, and the way out.

use std::borrow::Cow;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::Tell;
use files::{visible, visible_lines};
use linkage::error::Error;
use linkage::mechanism::is_unseen;

/// A text for a snippet, whose places are counted in bytes: every letter that is not seen gives way to a sign of as many
/// bytes. Those of ASCII the renderer replaces itself.
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

/// An error, and those that were found with it, as text without a newline at its end; advice is worded by `tell`.
pub fn text(error: &Error, tell: Tell) -> String {
    all(error, tell, ("error", Level::ERROR))
}

/// The same as a warning: the command has done what it could.
pub(crate) fn warning(error: &Error, tell: Tell) -> String {
    all(error, tell, ("warning", Level::WARNING))
}

fn all(error: &Error, tell: Tell, level: (&str, Level<'static>)) -> String {
    let each = error.each().map(|error| one(error, tell, &level));
    each.chain(error.rest().map(|rest| format!("{}: {rest}", level.0))).collect::<Vec<_>>().join("\n\n")
}

fn one(error: &Error, tell: Tell, (word, level): &(&str, Level<'static>)) -> String {
    let title = match error.scenario_key() {
        Some(key) => format!("`{key}`: {}", error.message()),
        None => error.message().to_string(),
    };
    let title = visible(&title);
    let help = error.way_out_by(tell).map(|help| visible_lines(&help));
    let Some(place) = error.place() else {
        // The renderer would draw a margin for lines that do not exist.
        let help = help.map(|help| format!("\n  = help: {help}")).unwrap_or_default();
        return format!("{word}: {title}{help}");
    };
    let path = visible(&place.file.display().to_string());
    let source = of_same_length(&place.text);
    // A span may end within a letter, as where a text is cut after so many bytes; the renderer would panic.
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
