//! Requests of the page that change the draft or the file.

use std::io::Write;

use serde_json::{Value, json};

use super::desk::Desk;
use files::OutputTarget;
use linkage::error::{Error, Result};
use linkage::math::Vec2;
use scenario::edit;

/// Answers a request, with the number of the new draft, its text if the program has changed it, or an error in words.
pub(super) fn answer(desk: &Desk, what: &str, body: &Value) -> Option<Value> {
    let text = body["text"].as_str()?;
    let changed = match what {
        "draft" => Ok(None),
        "keep" => kept(desk, text).map(|()| None),
        "parameter" => edit::with_parameter(text, body["key"].as_str()?, body["value"].as_f64()?).map(Some),
        "point" => moved(text, body["point"].as_str()?, body["places"].as_array()?).map(Some),
        _ => return None,
    };
    Some(match changed {
        Ok(changed) => json!({ "draft": desk.put(changed.as_deref().unwrap_or(text)), "text": changed }),
        Err(error) => json!({ "error": error.message(), "help": error.way_out() }),
    })
}

/// Writes the draft to the file.
fn kept(desk: &Desk, text: &str) -> Result<()> {
    files::replace(&OutputTarget::Named(&desk.file), |mut to| to.write_all(text.as_bytes())).map_err(
        |found: std::io::Error| {
            let usual = crate::sentences::CHECK_THAT_THE_FILE_MAY_BE_WRITTEN;
            files::unwritten(&desk.file.display().to_string(), &found, Some(text.len() as u64), usual)
        },
    )
}

/// Moves a point on all its links.
fn moved(text: &str, point: &str, places: &[Value]) -> Result<String> {
    let at = |value: &Value| Some(Vec2::new(value[0].as_f64()?, value[1].as_f64()?));
    let mut text = text.to_string();
    let mut refused: Option<Error> = None;
    let mut is_moved = false;
    for place in places {
        let (Some(link), Some(from), Some(to)) = (place["link"].as_str(), at(&place["from"]), at(&place["to"])) else {
            continue;
        };
        match edit::with_point(&text, link, point, [from, to]) {
            Ok(changed) => (text, is_moved) = (changed, true),
            Err(error) => refused = Some(error),
        }
    }
    // A coordinate that is an expression stays as it is, if the point moves on another link.
    match refused {
        Some(error) if !is_moved => Err(error),
        _ => Ok(text),
    }
}
