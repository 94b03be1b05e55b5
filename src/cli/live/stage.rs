//! What is shown to all viewers.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use recording::Reel;

/// What is shown to all viewers.
pub(super) struct Stage {
    /// What viewers call the server.
    pub name: String,
    shown: Mutex<Shown>,
}

/// What is shown, and how often that has changed.
#[derive(Clone, Default)]
pub(super) struct Shown {
    /// Number of changes.
    pub changes: u64,
    /// What is shown; nothing yet at the start.
    pub reel: Option<Arc<Reel>>,
}

impl Stage {
    /// A stage on which nothing is shown.
    pub(super) fn of(name: String) -> Stage {
        Stage { name, shown: Mutex::default() }
    }

    /// What is shown now.
    pub(super) fn shown(&self) -> Shown {
        self.lock().clone()
    }

    /// Shows this from now on.
    pub(super) fn show(&self, reel: Reel) {
        let mut shown = self.lock();
        *shown = Shown { changes: shown.changes + 1, reel: Some(Arc::new(reel)) };
    }

    fn lock(&self) -> MutexGuard<'_, Shown> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
