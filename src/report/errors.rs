//! An error: the line of the file concerned, what was found there, and the way out.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::tell::Tell;
use linkage::error::Error;

/// An error as text, without a newline at its end; advice is worded by `tell`.
pub(crate) fn text(error: &Error, tell: Tell) -> String {
    let title = match error.scenario_key() {
        Some(key) => format!("`{key}`: {}", error.message()),
        None => error.message().to_string(),
    };
    let help = error.way_out_by(tell);
    let Some(place) = error.place() else {
        // The renderer would draw a margin for lines that do not exist.
        let help = help.map(|help| format!("\n  = help: {help}")).unwrap_or_default();
        return format!("error: {title}{help}");
    };
    let path = place.file.display().to_string();
    let annotation = AnnotationKind::Primary.span(place.span.clone());
    let snippet = Snippet::source(place.text.as_str()).path(path.as_str()).annotation(annotation);
    let mut group = Group::with_title(Level::ERROR.primary_title(title.as_str())).element(snippet);
    if let Some(help) = help {
        group = group.element(Level::HELP.message(help));
    }
    Renderer::plain().render(&[group])
}
