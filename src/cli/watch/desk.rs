//! What the page shows: the draft, the text of the file, and what is known about the draft.

use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::cli::advice;
use crate::report::watch::{DraftStage, Outcome, Shown, state};
use scenario::Scenario;

/// Longest time for which a request waits for a change.
const PATIENCE: Duration = Duration::from_secs(20);
/// Longest time for which solver and proof leave the processor to the browser, which draws the first picture.
const DRAWING: Duration = Duration::from_millis(100);
/// If the proof takes longer than this, the curves are shown first, without a verdict. Otherwise the page with the
/// verdict shows them, and the time for a page without a verdict is saved.
const SOON: Duration = Duration::from_millis(500);
/// A new draft is sent together with its first results if these come within this time.
const TOGETHER: Duration = Duration::from_millis(40);

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
    /// Version at which the page last changed.
    page_since: u64,
    /// Newest version that a browser has drawn.
    drawn: u64,
    /// The newest draft that was read without mistakes, until its proof begins.
    unproven: Option<(u64, Scenario)>,
}

/// The state, shared by all threads.
pub(super) struct Desk {
    pub(super) file: PathBuf,
    state: Mutex<State>,
    changed: Condvar,
}

impl Desk {
    /// A desk with the text of the file as its first draft.
    pub(super) fn of(file: PathBuf, text: String) -> Desk {
        let text: Arc<str> = text.into();
        let state = State {
            version: 1,
            draft: 1,
            disk: Some(Arc::clone(&text)),
            text,
            disk_since: 1,
            outcome: Outcome::default(),
            page_since: 1,
            drawn: 0,
            unproven: None,
        };
        Desk { file, state: Mutex::new(state), changed: Condvar::new() }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // No code that holds the lock can panic half-way through a change.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until `find` returns a value for the state. `find` is called now and after every change.
    fn wait<T>(&self, mut find: impl FnMut(&mut State) -> Option<T>) -> T {
        let mut found = None;
        let waits = |state: &mut State| {
            found = find(state);
            found.is_none()
        };
        drop(self.changed.wait_while(self.state(), waits).unwrap_or_else(PoisonError::into_inner));
        found.expect("the wait ends when it is found")
    }

    fn change(&self, mut state: MutexGuard<'_, State>, change: impl FnOnce(&mut State)) {
        state.version += 1;
        change(&mut state);
        self.changed.notify_all();
    }

    /// Stores the text of the file (`None` if the file is missing), and takes it as the newest draft unless it equals
    /// the present draft.
    pub(super) fn saw(&self, disk: Option<String>) {
        let disk: Option<Arc<str>> = disk.map(Into::into);
        let state = self.state();
        if state.disk == disk {
            return;
        }
        self.change(state, |state| {
            state.disk_since = state.version;
            if let Some(text) = disk.as_ref().filter(|text| **text != state.text) {
                (state.draft, state.text) = (state.draft + 1, Arc::clone(text));
            }
            state.disk = disk;
        });
    }

    /// Takes a text from the page as the newest draft, and returns the number of the draft.
    pub(super) fn put(&self, text: &str) -> u64 {
        let state = self.state();
        if *state.text == *text {
            return state.draft;
        }
        let draft = state.draft + 1;
        self.change(state, |state| (state.draft, state.text) = (draft, text.into()));
        draft
    }

    /// Waits for a draft with a number above `after`.
    pub(super) fn next_draft(&self, after: u64) -> (u64, Arc<str>) {
        self.wait(|state| (state.draft > after).then(|| (state.draft, Arc::clone(&state.text))))
    }

    /// Stores a draft to be proven. The draft replaces an older draft whose proof has not begun.
    pub(super) fn leave(&self, draft: u64, scenario: Scenario) {
        self.state().unproven = Some((draft, scenario));
        self.changed.notify_all();
    }

    /// Waits for a draft to be proven, and takes it.
    pub(super) fn next_unproven(&self) -> (u64, Scenario) {
        self.wait(|state| state.unproven.take())
    }

    /// Shows results, unless there is a newer draft, or the page already shows later results of the same draft.
    pub(super) fn publish(&self, outcome: Outcome) {
        let state = self.state();
        let is_news = (outcome.draft, outcome.stage) > (state.outcome.draft, state.outcome.stage);
        if state.draft == outcome.draft && is_news {
            self.change(state, |state| {
                if !Arc::ptr_eq(&state.outcome.page, &outcome.page) {
                    state.page_since = state.version;
                }
                state.outcome = outcome;
            });
        }
    }

    /// Waits, at most for the time `DRAWING`, until a browser has drawn the page of a draft. A newer draft ends the
    /// wait.
    pub(super) fn wait_for_drawing(&self, draft: u64) {
        let is_open = |state: &mut State| state.draft == draft && state.drawn < state.page_since;
        drop(self.changed.wait_timeout_while(self.state(), DRAWING, is_open));
    }

    /// Waits for the verdict of a draft for a while. Returns whether the page needs the curves before the verdict: the
    /// draft is still the newest one and is not proven.
    pub(super) fn needs_curves(&self, draft: u64) -> bool {
        let is_open = |state: &mut State| {
            state.draft == draft && (state.outcome.draft, state.outcome.stage) < (draft, DraftStage::Proven)
        };
        let waited = self.changed.wait_timeout_while(self.state(), SOON, is_open);
        is_open(&mut waited.unwrap_or_else(PoisonError::into_inner).0)
    }

    /// The newest results about a draft; `None` if there is a newer draft.
    pub(super) fn outcome(&self, draft: u64) -> Option<Outcome> {
        Some(self.state().outcome.clone()).filter(|outcome| outcome.draft == draft)
    }

    /// Waits, at most for the time `PATIENCE`, for a version above `after`. The browser has drawn the version `after`.
    /// Returns the state for the page.
    pub(super) fn told(&self, after: u64) -> String {
        let mut now = self.state();
        now.drawn = now.drawn.max(after);
        self.changed.notify_all();
        let is_old = |state: &mut State| state.version <= after;
        let now = self.changed.wait_timeout_while(now, PATIENCE, is_old);
        let (now, _) = now.unwrap_or_else(PoisonError::into_inner);
        let is_unsolved = |state: &mut State| state.outcome.draft < state.draft;
        let now = self.changed.wait_timeout_while(now, TOGETHER, is_unsolved);
        let (now, _) = now.unwrap_or_else(PoisonError::into_inner);
        let shown = Shown {
            version: now.version,
            draft: now.draft,
            is_page_new: now.page_since > after,
            is_missing: now.disk.is_none(),
            is_kept: now.disk.as_ref() == Some(&now.text),
            text: (now.disk_since > after).then(|| now.disk.as_deref().unwrap_or(&now.text)),
        };
        state(&shown, &now.outcome, advice::told)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_of_older_drafts_are_dropped() {
        let desk = Desk::of("a.toml".into(), "one".into());
        let tells = |parts: &[&str]| {
            let told = desk.told(0);
            assert!(parts.iter().all(|part| told.contains(part)), "{parts:?}: {told}");
        };
        let of = |draft, stage| Outcome { draft, stage, page: Arc::new(format!("{draft}")), ..Outcome::default() };
        desk.publish(of(1, DraftStage::Solved));
        tells(&["\"page\":\"1\""]);
        assert!(desk.told(1).contains("\"page\":\"1\""));
        desk.publish(of(1, DraftStage::Moving));
        tells(&["\"stage\":\"solved\""]);
        assert_eq!(desk.put("two"), 2);
        assert_eq!(desk.put("two"), 2);
        desk.publish(of(1, DraftStage::Judged));
        assert!(desk.outcome(2).is_none() && desk.outcome(1).unwrap().stage == DraftStage::Solved);
        assert_eq!(desk.next_draft(1).1.as_ref(), "two");
        desk.publish(of(2, DraftStage::Moving));
        tells(&["\"shown\":2", "\"isKept\":false", "\"text\":\"one\""]);
        // A page is sent only once: a later answer has no page.
        let version = desk.state().version - 1;
        desk.saw(None);
        assert!(desk.told(version).contains("\"page\":\"2\"") && desk.told(version + 1).contains("\"page\":null"));
        tells(&["\"isMissing\":true"]);
        // If the text of the file becomes equal to the draft, there is no new draft.
        desk.saw(Some("two".into()));
        tells(&["\"draft\":2", "\"isKept\":true"]);
        desk.saw(Some("three".into()));
        tells(&["\"text\":\"three\""]);
        assert_eq!(desk.next_draft(2).0, 3);
    }
}
