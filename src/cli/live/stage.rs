//! The content that all viewers share.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use recording::Reel;

/// The content that all viewers share.
pub(super) struct Stage {
    /// Name of the server in viewers.
    pub name: String,
    shown: Mutex<Shown>,
}

/// The content, and the number of times that the server has replaced it.
#[derive(Clone, Default)]
pub(super) struct Shown {
    /// Number of changes.
    pub changes: u64,
    /// The content; `None` at the start.
    pub reel: Option<Arc<Reel>>,
}

impl Stage {
    /// A stage without content.
    pub(super) fn of(name: String) -> Stage {
        Stage { name, shown: Mutex::default() }
    }

    /// The present content.
    pub(super) fn shown(&self) -> Shown {
        self.lock().clone()
    }

    /// Replaces the content.
    pub(super) fn show(&self, reel: Reel) {
        let mut shown = self.lock();
        *shown = Shown { changes: shown.changes + 1, reel: Some(Arc::new(reel)) };
    }

    fn lock(&self) -> MutexGuard<'_, Shown> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
