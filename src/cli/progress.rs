//! A progress bar that appears only when the work takes long enough.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// If the work takes less time than this, no bar is shown.
const PATIENCE: Duration = Duration::from_millis(700);

/// Bar on standard error (only on a terminal), from 0 to 1.
pub(super) struct Bar {
    what: String,
    since: Instant,
    bar: Option<ProgressBar>,
}

impl Bar {
    /// A bar for the work called `what`.
    pub(super) fn new(what: &str) -> Self {
        Bar { what: what.into(), since: Instant::now(), bar: None }
    }

    /// Sets the finished fraction of the work.
    pub(super) fn at(&mut self, part: f64) {
        if self.bar.is_none() && self.since.elapsed() > PATIENCE {
            let style = ProgressStyle::with_template("{msg} {wide_bar} {percent:>3} % {eta:>4}");
            let bar = ProgressBar::new(1000).with_message(self.what.clone());
            self.bar = Some(bar.with_style(style.expect("the template is fixed")));
        }
        if let Some(bar) = &self.bar {
            bar.set_position((part * 1000.0) as u64);
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// One bar for parallel work on several files.
pub(super) struct Shared(Mutex<(Bar, Vec<f64>)>);

impl Shared {
    /// A bar for the work called `what`, on `files` files.
    pub(super) fn new(what: &str, files: usize) -> Self {
        Shared(Mutex::new((Bar::new(what), vec![0.0; files])))
    }

    /// Sets the finished fraction of the work on a file.
    pub(super) fn at(&self, file: usize, part: f64) {
        let (bar, parts) = &mut *self.0.lock().unwrap_or_else(PoisonError::into_inner);
        parts[file] = part;
        bar.at(parts.iter().sum::<f64>() / parts.len() as f64);
    }

    /// Hides the bar while `print` runs, so that the bar and the printed text do not mix.
    pub(super) fn hidden<R>(&self, print: impl FnOnce() -> R) -> R {
        let shown = self.0.lock().unwrap_or_else(PoisonError::into_inner).0.bar.clone();
        match shown {
            Some(bar) => bar.suspend(print),
            None => print(),
        }
    }
}
