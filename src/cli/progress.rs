//! A progress bar that appears only when the work takes long enough.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_millis(700);

/// Bar on standard error (only on a terminal), from 0 to 1.
#[derive(Debug)]
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

    /// Sets the finished share of the work.
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
