//! Threads behind the page: one follows the file, one solves drafts analytically, one proves them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::desk::{Desk, Outcome};
use crate::cli::advice;
use crate::cli::html::reduced;
use crate::draw::{Drawn, Medium, PictureOptions, picture};
use crate::report::html::{self, Beside};
use crate::report::watch::picture_page;
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::GROUND;
use linkage::quiet::guarded;
use prover::run::{Options, Proof, prove};
use scenario::{Draft, Scenario, StartRequest};

/// Time between two looks at the file.
const TICK: Duration = Duration::from_millis(5);
/// The file is read at least this often, because an editor may keep length and time of change.
const RELOOK: Duration = Duration::from_millis(500);
/// Most mistakes on the page.
const MOST: usize = 50;

/// Follows the file.
pub(super) fn follow(desk: &Desk) {
    let (mut seen, mut since) = (None, Instant::now());
    loop {
        let now = fs::metadata(&desk.file).ok().map(|own| (own.len(), own.modified().ok()));
        if now != seen || since.elapsed() >= RELOOK {
            (seen, since) = (now, Instant::now());
            let text = now.and_then(|_| scenario::source::text_of(&desk.file).ok());
            // An editor may empty the file before it writes the new text.
            if text.as_deref() != Some("") {
                desk.saw(text);
            }
        }
        thread::sleep(TICK);
    }
}

/// Solves the newest draft analytically, again and again.
pub(super) fn move_drafts(desk: &Desk) {
    let mut done = 0;
    loop {
        let (draft, text) = desk.next_draft(done, |_| true);
        done = draft;
        // The positions alone first, because their page is small.
        for stage in ["moving", "solved"] {
            let outcome = guarded(|| moved(&text, &desk.file, stage)).unwrap_or_else(|_| Err(internal()));
            let outcome = outcome.unwrap_or_else(|error| failed(&text, &desk.file, error));
            let is_wrong = outcome.stage == "wrong";
            desk.publish(Outcome { draft, ..outcome });
            if is_wrong {
                break;
            }
        }
    }
}

/// Proves the newest draft that could be solved, again and again.
pub(super) fn prove_drafts(desk: &Desk) {
    let mut done = 0;
    loop {
        let is_ready = |outcome: &Outcome| ["moving", "solved"].contains(&outcome.stage) && outcome.draft > done;
        let (draft, text) = desk.next_draft(done, is_ready);
        let before = desk.outcome();
        if before.draft != draft {
            continue;
        }
        done = draft;
        let judged = guarded(|| judged(&text, &desk.file)).unwrap_or_else(|_| Err(internal()));
        desk.publish(match judged {
            Ok((page, verdict)) => Outcome { stage: "judged", page: Arc::new(page), verdict: Some(verdict), ..before },
            Err(error) => Outcome { stage: "judged", errors: told(&error), ..before },
        });
    }
}

fn internal() -> Error {
    Error::new(ErrorKind::Unsupported, sentences::AN_INTERNAL_ERROR).help(sentences::REPORT_THE_FILE)
}

/// The page of a scenario that is solved analytically: its positions (`moving`) or all its channels (`solved`).
fn moved(text: &str, file: &Path, stage: &'static str) -> Result<Outcome> {
    let whole = Scenario::parse(text, file)?;
    let scenario = if stage == "moving" { whole.only(&["positions".into()])? } else { whole };
    let proof = Proof::unjudged(&scenario)?;
    let reduced = Err(sentences::IT_IS_SHOWN_WITH_THE_VERDICT.into());
    let beside = Beside { given: text, settings: &BTreeMap::new(), reduced };
    let page = html::watched(&proof, &beside, Some(sentences::THE_PROOF_RUNS), advice::told);
    let points = &scenario.case.mechanism.links()[GROUND].points;
    Ok(Outcome {
        stage,
        page: Arc::new(page),
        parameters: parameters(text),
        ground: points.iter().map(|point| json!([point.name, point.local.x, point.local.y])).collect(),
        ..Outcome::default()
    })
}

/// The page of a proof, and the word of its verdict.
fn judged(text: &str, file: &Path) -> Result<(String, &'static str)> {
    let scenario = Scenario::parse(text, file)?;
    let proof = prove(&scenario, &Options::default())?;
    let settings = crate::report::recorded::metadata(&proof);
    let beside = Beside { given: text, settings: &settings, reduced: reduced(&scenario) };
    Ok((html::watched(&proof, &beside, None, advice::told), proof.verdict.word()))
}

/// Mistakes of a file, and a picture of what can be drawn.
fn failed(text: &str, file: &Path, error: Error) -> Outcome {
    let wish = PictureOptions::default();
    let errors = told(&error);
    let drawn = || -> Result<Vec<u8>> {
        let draft = Draft::parse(text, file, &StartRequest::default())?;
        let drawn = Drawn::of_draft(draft, &wish, Medium::Svg, error)?;
        picture(&[drawn], &wish, Medium::Svg)
    };
    let svg = guarded(drawn).ok().and_then(Result::ok).and_then(|bytes| String::from_utf8(bytes).ok());
    let page = svg.map(|svg| picture_page(&svg)).unwrap_or_default();
    Outcome { stage: "wrong", errors, page: Arc::new(page), parameters: parameters(text), ..Outcome::default() }
}

/// Mistakes with line and column from 1, the length of the faulty text, and the way out.
fn told(error: &Error) -> Vec<Value> {
    let one = |error: &Error| {
        let place = error.place().map(|place| {
            let start = place.text.get(..place.span.start).unwrap_or_default();
            let column = start.rsplit('\n').next().unwrap_or_default().encode_utf16().count() + 1;
            let at = start.encode_utf16().count();
            let length = place.text.get(place.span.clone()).unwrap_or_default().encode_utf16().count();
            json!({ "line": place.line(), "column": column, "at": at, "length": length })
        });
        json!({
            "key": error.scenario_key(), "message": error.message(),
            "help": error.way_out_by(advice::told), "place": place,
        })
    };
    error.each().take(MOST).map(one).collect()
}

/// Parameters that are plain numbers: key and number.
fn parameters(text: &str) -> Vec<Value> {
    let all = scenario::edit::parameters(text).unwrap_or_default();
    all.into_iter().map(|(key, number)| json!({ "key": key, "value": number })).collect()
}
