//! An engine that stores its runs.
//! See docs/numerics/settings.md.

use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::{Engine, Extrapolated, Rows, Settings, StandIn};
use crate::case::Case;
use crate::error::{Error, Result};
use crate::solver::{Progress, Provision, Solver, State, Visit};
use crate::threads::{cores, side_by_side};
use crate::trajectory::Channel;

/// An engine that stores its runs. If a stored run is requested again, the stored states are returned.
/// Engines that [`Engine::with`] makes from this engine share the stored runs.
/// Engines with Richardson extrapolation also use the shared runs.
/// The store contains the runs of one case. A run of a different case empties the store.
pub struct CachedEngine {
    inner: Box<dyn Engine>,
    store: Arc<Store>,
}

#[derive(Default)]
struct Store(Mutex<Runs>);

#[derive(Default)]
struct Runs {
    case: Option<Case>,
    runs: Vec<Run>,
}

#[derive(Clone)]
struct Run {
    settings: Settings,
    /// States of the run. For a failed run, the states that the run reached before it failed.
    rows: Arc<Rows>,
    failed: Option<Error>,
}

impl Store {
    /// Locks the store. After a panic the poisoned lock can still be used, because only finished runs are stored.
    fn lock(&self) -> MutexGuard<'_, Runs> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn find(&self, settings: Settings, case: &Case) -> Option<Run> {
        let mut all = self.lock();
        if all.case.as_ref() != Some(case) {
            (all.case, all.runs) = (Some(case.clone()), Vec::new());
        }
        all.runs.iter().find(|run| run.settings == settings).cloned()
    }
}

impl CachedEngine {
    /// Wraps an engine in a store. Runs at all settings are stored.
    #[must_use]
    pub fn new(engine: &dyn Engine) -> Self {
        let plain = Settings { extrapolated: 0, ..engine.settings() };
        CachedEngine { inner: engine.with(plain), store: Arc::default() }
    }

    /// Settings of the plain runs (without extrapolation) that engines at `settings` need and that are not stored yet.
    #[must_use]
    pub fn missing(&self, case: &Case, settings: &[Settings]) -> Vec<Settings> {
        let mut missing: Vec<Settings> = Vec::new();
        for plain in settings.iter().copied().flat_map(plain_runs) {
            if !missing.contains(&plain) && self.store.find(plain, case).is_none() {
                missing.push(plain);
            }
        }
        missing
    }

    /// Performs the [missing](CachedEngine::missing) runs, on as many threads as the machine has cores.
    /// The results do not depend on the number of threads. A failed run is stored with its error.
    /// `progress` receives the completed fraction of all these runs.
    pub fn prepare(&self, case: &Case, mut missing: Vec<Settings>, progress: Progress) {
        // The run with the most work starts first, so that the other cores do not wait for this run at the end.
        missing.sort_by(|a, b| b.work().total_cmp(&a.work()));
        let whole: f64 = missing.iter().map(Settings::work).sum();
        let mut parts = vec![0.0f64; missing.len()];
        let work = |index: usize, tell: Progress| drop(self.run(case, missing[index], tell));
        side_by_side(missing.len(), cores(), work, |index, part| {
            parts[index] = part;
            progress(missing.iter().zip(&parts).map(|(run, part)| run.work() * part).sum::<f64>() / whole);
            ControlFlow::Continue(())
        });
    }

    /// Keeps only the stored runs for whose settings `wanted` returns true.
    pub fn retain(&self, wanted: impl Fn(&Settings) -> bool) {
        self.store.lock().runs.retain(|run| wanted(&run.settings));
    }

    /// Performs a plain run and stores it.
    fn run(&self, case: &Case, settings: Settings, progress: Progress) -> Run {
        let engine = self.inner.with(settings);
        let (rows, outcome) = Rows::of_run(case, |visit| engine.sweep(case, visit, progress));
        let run = Run { settings, rows: Arc::new(rows), failed: outcome.err() };
        self.store.lock().runs.push(run.clone());
        run
    }

    /// Returns the stored plain run at this engine's settings. Performs the run if it is missing.
    fn found(&self, case: &Case, progress: Progress) -> Run {
        let settings = self.inner.settings();
        self.store.find(settings, case).unwrap_or_else(|| self.run(case, settings, progress))
    }
}

/// Settings of the plain runs that an engine with `settings` combines.
#[must_use]
pub fn plain_runs(settings: Settings) -> Vec<Settings> {
    let at = |time| settings.resolution * 0.5f64.powi(time);
    (0..=settings.extrapolated as i32)
        .map(|time| Settings { resolution: at(time), extrapolated: 0, ..settings })
        .collect()
}

impl Solver for CachedEngine {
    fn name(&self) -> &'static str {
        self.inner.name()
    }

    fn provides(&self, channel: &Channel) -> Provision {
        self.inner.provides(channel)
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        let run = self.found(case, progress);
        let mut state = State::at_rest(case);
        for row in case.grid.ascending() {
            if run.rows.get(row, &mut state) {
                visit(row, &state)?;
            }
        }
        progress(1.0);
        run.failed.map_or(Ok(()), Err)
    }
}

impl StandIn for CachedEngine {
    fn original(&self) -> &dyn Engine {
        self.inner.as_ref()
    }

    fn renewed(&self, settings: Settings) -> Box<dyn Engine> {
        let plain = self.inner.with(Settings { extrapolated: 0, ..settings });
        let kept = Box::new(CachedEngine { inner: plain, store: Arc::clone(&self.store) });
        match settings.extrapolated {
            times if times > 0 && !self.controls_error() => Box::new(Extrapolated::new(kept, times)),
            _ => kept,
        }
    }

    fn own_rows(&self, case: &Case, progress: Progress) -> Result<Arc<Rows>> {
        let run = self.found(case, progress);
        progress(1.0);
        run.failed.map_or(Ok(run.rows), Err)
    }
}
