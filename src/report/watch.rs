//! The page of `linkproof watch`: the text of the file beside the page of its proof.
//! Also the messages between this page and the program.

use std::sync::Arc;

use serde_json::{Value, json};

use super::html::{escaped, filled, watching_script};
use crate::plain::Tell;
use linkage::error::Error;
use linkage::math::Vec2;

const TEMPLATE: &str = include_str!("watch/watch.html");
const FRAME: &str = include_str!("watch/frame.html");
const STYLE: &str = include_str!("watch/watch.css");
/// The script of the page.
pub(crate) const SCRIPT: &str = include_str!("watch/watch.js");
/// Largest number of mistakes on the page.
const MOST: usize = 50;

/// The page around the frame. The page contains no data; its script requests them.
pub(crate) fn shell(file: &str) -> String {
    filled(TEMPLATE, &[("file", &escaped(file)), ("style", STYLE), ("version", env!("CARGO_PKG_VERSION"))])
}

/// The frame in which pages of the mechanism replace each other.
pub(crate) fn frame() -> String {
    filled(FRAME, &[("script", &watching_script())])
}

/// A page with a still picture, for a mechanism with mistakes.
pub(crate) fn picture_page(svg: &str) -> String {
    let svg = svg.find("<svg").map_or(svg, |start| &svg[start..]);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>draft</title>\n\
         <style>body {{ margin: 0; background: #fff; }} svg {{ width: 100%; height: auto; }}</style></head>\n\
         <body>\n{svg}\n</body>\n</html>\n"
    )
}

linkage::words! {
    /// How much is known about a draft; later stages tell more.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
    pub(crate) enum DraftStage: name {
        /// Not yet solved.
        #[default]
        Read = "read",
        /// Positions.
        Moving = "moving",
        /// All channels, computed by the first analytic solver (`assur`); not judged yet.
        Solved = "solved",
        /// The verdict. Its page follows.
        Proven = "proven",
        /// The page with the verdict, or the error of the proof.
        Judged = "judged",
        /// Mistakes, and a picture of what can be drawn.
        Wrong = "wrong",
    }
}

/// Results about a draft.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    /// Number of the draft.
    pub(crate) draft: u64,
    pub(crate) stage: DraftStage,
    /// The mistakes of the draft, or the error of its proof.
    pub(crate) error: Option<Error>,
    /// The page of the mechanism; empty if nothing can be drawn.
    pub(crate) page: Arc<String>,
    /// Word of the verdict, if proven.
    pub(crate) verdict: Option<&'static str>,
    /// Parameters that are plain numbers, by their keys.
    pub(crate) parameters: Vec<(String, f64)>,
    /// Points of the ground (m).
    pub(crate) ground: Vec<(String, Vec2)>,
}

/// What the page shows besides the results.
pub(crate) struct Shown<'a> {
    /// Number of the last change.
    pub(crate) version: u64,
    /// Number of the newest draft.
    pub(crate) draft: u64,
    /// Whether the page has changed.
    pub(crate) is_page_new: bool,
    /// Whether the file is missing.
    pub(crate) is_missing: bool,
    /// Whether the file has the text of the newest draft.
    pub(crate) is_kept: bool,
    /// The text of the file, if it has changed.
    pub(crate) text: Option<&'a str>,
}

/// The state as a message to the page.
pub(crate) fn state(shown: &Shown, outcome: &Outcome, tell: Tell) -> String {
    let errors = outcome.error.iter().flat_map(Error::each).take(MOST).map(|error| mistake(error, tell));
    let parameters = outcome.parameters.iter().map(|(key, value)| json!({ "key": key, "value": value }));
    let has_page = !outcome.page.is_empty();
    let page = (has_page && shown.is_page_new).then_some(outcome.page.as_str());
    let message = json!({
        "version": shown.version, "draft": shown.draft, "shown": outcome.draft, "stage": outcome.stage.name(),
        "errors": errors.collect::<Value>(), "verdict": outcome.verdict, "parameters": parameters.collect::<Value>(),
        "ground": outcome.ground.iter().map(|(name, at)| json!([name, at.x, at.y])).collect::<Value>(),
        "hasPage": has_page, "page": page, "isMissing": shown.is_missing, "isKept": shown.is_kept, "text": shown.text,
    });
    message.to_string()
}

/// A mistake with its line and column from 1, its position in the text (UTF-16 units), and the remedy.
fn mistake(error: &Error, tell: Tell) -> Value {
    let units = |text: &str| text.encode_utf16().count();
    let place = error.place().map(|place| {
        let before = place.text.get(..place.span.start).unwrap_or_default();
        let column = units(before.rsplit('\n').next().unwrap_or_default()) + 1;
        let length = units(place.text.get(place.span.clone()).unwrap_or_default());
        json!({ "line": place.line(), "column": column, "at": units(before), "length": length })
    });
    json!({ "key": error.scenario_key(), "message": error.message(), "help": error.way_out_by(tell), "place": place })
}

/// A request of the page about a text.
pub(crate) struct Request {
    pub(crate) text: String,
    pub(crate) kind: RequestKind,
}

/// What the page asks for.
pub(crate) enum RequestKind {
    /// Solve the text.
    Draft,
    /// Write the text to the file.
    Keep,
    /// Change a parameter, in the unit of its key.
    Parameter { key: String, value: f64 },
    /// Move a point. For each link of the point: its old and its new position (m, in the frame of the link).
    Point { name: String, places: Vec<(String, [Vec2; 2])> },
}

impl Request {
    /// Reads the request `what` from the message `body`; `None` if this is not a valid request of the page.
    pub(crate) fn of(what: &str, body: &str) -> Option<Request> {
        let body: Value = serde_json::from_str(body).ok()?;
        let text = |key: &str| body[key].as_str().map(String::from);
        let kind = match what {
            "draft" => RequestKind::Draft,
            "keep" => RequestKind::Keep,
            "parameter" => RequestKind::Parameter { key: text("key")?, value: body["value"].as_f64()? },
            "point" => {
                let places = body["places"].as_array()?.iter().map(place).collect::<Option<_>>()?;
                RequestKind::Point { name: text("point")?, places }
            }
            _ => return None,
        };
        Some(Request { text: text("text")?, kind })
    }
}

/// A link, and two positions in its frame.
fn place(value: &Value) -> Option<(String, [Vec2; 2])> {
    let at = |key: &str| Some(Vec2::new(value[key][0].as_f64()?, value[key][1].as_f64()?));
    Some((value["link"].as_str()?.into(), [at("from")?, at("to")?]))
}

/// The answer to a request: the number of the newest draft, and its text if the program has changed it.
pub(crate) fn answer(done: Result<(u64, Option<&str>), &Error>) -> String {
    let message = match done {
        Ok((draft, text)) => json!({ "draft": draft, "text": text }),
        Err(error) => json!({ "error": error.message(), "help": error.way_out() }),
    };
    message.to_string()
}
