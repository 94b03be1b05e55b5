//! Threads behind the page: one follows the file, one solves drafts analytically, one proves them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use super::desk::Desk;
use crate::cli::advice;
use crate::cli::html::reduced;
use crate::draw::{Drawn, Medium, PictureOptions, picture};
use crate::report::html::{self, Beside};
use crate::report::recorded;
use crate::report::watch::{DraftStage, Outcome, picture_page};
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use linkage::mechanism::GROUND;
use linkage::quiet::guarded;
use prover::run::{Options, Proof, prove};
use scenario::{Draft, Scenario, StartRequest, edit};

/// Time between two looks at the file.
const TICK: Duration = Duration::from_millis(2);
/// The file is read at least this often, because a change may leave its length and its time of change as they were.
const RELOOK: Duration = Duration::from_millis(500);

/// Largest size of all columns in the first page and in the later pages (bytes). With fewer instants, the browser shows
/// a page sooner.
const PICTURE_BYTES: usize = 25_000;
const LATER_BYTES: usize = 500_000;

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
        let (draft, text) = desk.next_draft(done);
        done = draft;
        let publish = |outcome: Outcome| desk.publish(Outcome { draft, ..outcome });
        let moved = || {
            let scenario = Scenario::parse(&text, &desk.file)?;
            // First the page has neither the text nor any channels but positions, because such a page is small.
            let first = moved(&scenario.clone().only(&["positions".into()])?, "", PICTURE_BYTES)?;
            publish(Outcome { stage: DraftStage::Moving, ..first.clone() });
            desk.wait_for_drawing(draft);
            desk.leave(draft, scenario.clone());
            if !desk.needs_curves(draft) {
                return Ok(());
            }
            let page = moved(&scenario, &scenario.text, LATER_BYTES)?.page;
            publish(Outcome { stage: DraftStage::Solved, page, ..first });
            Ok(())
        };
        if let Err(error) = stopped(moved) {
            publish(failed(&text, &desk.file, error));
        }
    }
}

/// Proves the newest draft that could be read, again and again.
pub(super) fn prove_drafts(desk: &Desk) {
    loop {
        let (draft, scenario) = desk.next_unproven();
        let publish = |stage: DraftStage, add: &dyn Fn(Outcome) -> Outcome| {
            if let Some(before) = desk.outcome(draft) {
                desk.publish(Outcome { stage, ..add(before) });
            }
        };
        let judged = || {
            let proof = prove(&scenario, &Options::default())?;
            let verdict = Some(proof.verdict.word());
            publish(DraftStage::Proven, &|before| Outcome { verdict, ..before });
            let page = Arc::new(judged(&proof, &scenario));
            publish(DraftStage::Judged, &|before| Outcome { page: Arc::clone(&page), ..before });
            Ok(())
        };
        if let Err(error) = stopped(judged) {
            publish(DraftStage::Judged, &|before| Outcome { error: Some(error.clone()), ..before });
        }
    }
}

/// The result of a calculation; an error if it panics.
fn stopped<T>(work: impl FnOnce() -> Result<T>) -> Result<T> {
    let internal = || Error::new(ErrorKind::Unsupported, sentences::AN_INTERNAL_ERROR).help(sentences::REPORT_THE_FILE);
    guarded(work).unwrap_or_else(|_| Err(internal()))
}

/// The page of a scenario that is solved analytically, with the text `given`.
fn moved(scenario: &Scenario, given: &str, bytes: usize) -> Result<Outcome> {
    let proof = Proof::unjudged(scenario)?;
    let reduced = Err(sentences::IT_IS_SHOWN_WITH_THE_VERDICT.into());
    let beside = Beside { given, settings: &BTreeMap::new(), reduced, bytes };
    let page = html::watched(&proof, &beside, Some(sentences::THE_PROOF_RUNS), advice::told);
    let points = &scenario.case.mechanism.links()[GROUND].points;
    Ok(Outcome {
        page: Arc::new(page),
        parameters: edit::parameters(&scenario.text).unwrap_or_default(),
        ground: points.iter().map(|point| (point.name.clone(), point.local)).collect(),
        ..Outcome::default()
    })
}

/// The page of a proof.
fn judged(proof: &Proof, scenario: &Scenario) -> String {
    let settings = recorded::metadata(proof);
    let beside = Beside { given: &scenario.text, settings: &settings, reduced: reduced(scenario), bytes: LATER_BYTES };
    html::watched(proof, &beside, None, advice::told)
}

/// Mistakes of a file, and a picture of what can be drawn.
fn failed(text: &str, file: &Path, error: Error) -> Outcome {
    let wish = PictureOptions::default();
    let drawn = || -> Result<Vec<u8>> {
        let draft = Draft::parse(text, file, &StartRequest::default())?;
        let drawn = Drawn::of_draft(draft, &wish, Medium::Svg, error.clone())?;
        picture(&[drawn], &wish, Medium::Svg)
    };
    let svg = stopped(drawn).ok().and_then(|bytes| String::from_utf8(bytes).ok());
    Outcome {
        stage: DraftStage::Wrong,
        page: Arc::new(svg.map(|svg| picture_page(&svg)).unwrap_or_default()),
        parameters: edit::parameters(text).unwrap_or_default(),
        error: Some(error),
        ..Outcome::default()
    }
}
