//! Requests of the page that change the draft or the file.

use super::desk::Desk;
use crate::cli::output;
use crate::report::watch::{Request, RequestKind, answer};
use linkage::error::{Error, Result};
use linkage::math::Vec2;
use scenario::edit;

/// Carries out a request, and returns the answer.
pub(super) fn answered(desk: &Desk, request: &Request) -> String {
    let text = request.text.as_str();
    let changed = match &request.kind {
        RequestKind::Draft => Ok(None),
        RequestKind::Keep => output::write(text, &desk.file).map(|()| None),
        RequestKind::Parameter { key, value } => edit::with_parameter(text, key, *value).map(Some),
        RequestKind::Point { name, places } => moved(text, name, places).map(Some),
    };
    match changed {
        Ok(changed) => answer(Ok((desk.put(changed.as_deref().unwrap_or(text)), changed.as_deref()))),
        Err(error) => answer(Err(&error)),
    }
}

/// Moves a point on all its links.
fn moved(text: &str, point: &str, places: &[(String, [Vec2; 2])]) -> Result<String> {
    let mut text = text.to_string();
    let mut refused: Option<Error> = None;
    let mut is_moved = false;
    for (link, way) in places {
        match edit::with_point(&text, link, point, *way) {
            Ok(changed) => (text, is_moved) = (changed, true),
            Err(error) => refused = Some(error),
        }
    }
    // A coordinate that is an expression cannot be changed. Such a coordinate is an error only if the point could be
    // moved on none of its links.
    match refused {
        Some(error) if !is_moved => Err(error),
        _ => Ok(text),
    }
}
