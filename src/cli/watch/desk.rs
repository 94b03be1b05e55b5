//! What the page shows: the draft, the text of the file, and what is known about the draft.

use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde_json::{Value, json};

/// Results about a draft.
#[derive(Clone, Debug, Default)]
pub(super) struct Outcome {
    /// Number of the draft.
    pub(super) draft: u64,
    /// `wrong` (with a picture of what can be drawn), `moving` (positions), `solved` (all channels, analytically) or
    /// `judged`.
    pub(super) stage: &'static str,
    /// Mistakes with their places.
    pub(super) errors: Vec<Value>,
    /// The page of the mechanism.
    pub(super) page: Arc<String>,
    /// Word of the verdict, if judged.
    pub(super) verdict: Option<&'static str>,
    /// Parameters that are plain numbers.
    pub(super) parameters: Vec<Value>,
    /// Points of the ground: name and coordinates (m).
    pub(super) ground: Vec<Value>,
}

/// The state behind the page.
struct State {
    /// Number of the last change.
    version: u64,
    /// Number of the newest draft, and its text.
    draft: u64,
    text: Arc<str>,
    /// Text of the file; `None` if the file is missing or is not a text.
    disk: Option<Arc<str>>,
    /// Version at which the text of the file last changed.
    disk_since: u64,
    outcome: Outcome,
    page_since: u64,
    /// The last pages, with their versions. The browser may still be loading an older one.
    pages: Vec<(u64, Arc<String>)>,
}

/// Number of pages that are kept.
const PAGES: usize = 3;

/// The state, shared by all threads.
pub(super) struct Desk {
    pub(super) file: PathBuf,
    state: Mutex<State>,
    changed: Condvar,
}

/// How much a stage tells about a draft.
fn rank(stage: &str) -> usize {
    ["read", "moving", "solved", "judged", "wrong"].iter().position(|own| *own == stage).unwrap_or(0)
}

/// Longest time for which a request waits for a change.
const PATIENCE: Duration = Duration::from_secs(20);

impl Desk {
    /// A desk with the text of the file as its first draft.
    pub(super) fn of(file: PathBuf, text: String) -> Desk {
        let text: Arc<str> = text.into();
        let disk = Some(Arc::clone(&text));
        let outcome = Outcome { stage: "read", ..Outcome::default() };
        let state =
            State { version: 1, draft: 1, text, disk, disk_since: 1, outcome, page_since: 0, pages: Vec::new() };
        Desk { file, state: Mutex::new(state), changed: Condvar::new() }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // No code that holds the lock can panic half-way through a change.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn change(&self, change: impl FnOnce(&mut State)) -> u64 {
        let mut state = self.state();
        state.version += 1;
        change(&mut state);
        self.changed.notify_all();
        state.draft
    }

    /// Takes the text of the file as the newest draft; `None` if the file is missing.
    pub(super) fn saw(&self, disk: Option<String>) {
        let disk: Option<Arc<str>> = disk.map(Into::into);
        if self.state().disk == disk {
            return;
        }
        self.change(|state| {
            state.disk_since = state.version;
            if let Some(text) = &disk {
                (state.draft, state.text) = (state.draft + 1, Arc::clone(text));
            }
            state.disk = disk;
        });
    }

    /// Takes a text from the page as the newest draft, and returns the number of the draft.
    pub(super) fn put(&self, text: &str) -> u64 {
        if *self.state().text == *text {
            return self.state().draft;
        }
        self.change(|state| (state.draft, state.text) = (state.draft + 1, text.into()))
    }

    /// Waits for a draft with a number above `after` for which `is_ready` holds.
    pub(super) fn next_draft(&self, after: u64, is_ready: impl Fn(&Outcome) -> bool) -> (u64, Arc<str>) {
        let waits = |state: &mut State| state.draft <= after || !is_ready(&state.outcome);
        let state = self.changed.wait_while(self.state(), waits).unwrap_or_else(PoisonError::into_inner);
        (state.draft, Arc::clone(&state.text))
    }

    /// Shows results, unless a newer draft or more is known.
    pub(super) fn publish(&self, outcome: Outcome) {
        let mut state = self.state();
        let known = (state.outcome.draft, rank(state.outcome.stage));
        if state.draft == outcome.draft && (outcome.draft, rank(outcome.stage)) > known {
            state.version += 1;
            (state.page_since, state.outcome) = (state.version, outcome);
            let page = (state.version, Arc::clone(&state.outcome.page));
            state.pages.insert(0, page);
            state.pages.truncate(PAGES);
            self.changed.notify_all();
        }
    }

    /// The newest results.
    pub(super) fn outcome(&self) -> Outcome {
        self.state().outcome.clone()
    }

    /// The page of the version `since`, if it is one of the last ones.
    pub(super) fn page(&self, since: u64) -> Option<Arc<String>> {
        let state = self.state();
        state.pages.iter().find(|(own, _)| *own == since).map(|(_, page)| Arc::clone(page))
    }

    /// Waits for a change after the version `after`, or for a while, and returns the state for the page.
    pub(super) fn told(&self, after: u64) -> Value {
        let waits = |state: &mut State| state.version <= after;
        let (state, _) =
            self.changed.wait_timeout_while(self.state(), PATIENCE, waits).unwrap_or_else(PoisonError::into_inner);
        let outcome = &state.outcome;
        json!({
            "version": state.version,
            "draft": state.draft,
            "shown": outcome.draft,
            "stage": outcome.stage,
            "errors": outcome.errors,
            "verdict": outcome.verdict,
            "parameters": outcome.parameters,
            "ground": outcome.ground,
            "page": (!outcome.page.is_empty()).then_some(state.page_since),
            "isMissing": state.disk.is_none(),
            "isKept": state.disk.as_ref() == Some(&state.text),
            "text": (state.disk_since > after).then(|| state.disk.as_deref().unwrap_or(&state.text)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_of_older_drafts_are_dropped() {
        let desk = Desk::of("a.toml".into(), "one".into());
        let of =
            |draft| Outcome { draft, stage: "moving", page: Arc::new(format!("page {draft}")), ..Outcome::default() };
        desk.publish(of(1));
        assert_eq!(desk.told(0)["page"], 2);
        assert_eq!(desk.put("two"), 2);
        assert_eq!(desk.put("two"), 2);
        desk.publish(of(1));
        assert_eq!(desk.outcome().draft, 1);
        assert_eq!(desk.next_draft(1, |_| true).1.as_ref(), "two");
        desk.publish(of(2));
        let told = desk.told(0);
        assert_eq!((&told["shown"], &told["isKept"], &told["text"]), (&json!(2), &json!(false), &json!("one")));
        desk.saw(None);
        assert_eq!(desk.told(0)["isMissing"], true);
        desk.saw(Some("three".into()));
        assert_eq!(desk.told(0)["text"], "three");
        assert_eq!(desk.next_draft(2, |_| true).0, 3);
    }
}
