//! Runs that several engines share.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::{Engine, Settings};
use crate::case::Case;
use crate::error::Result;
use crate::solver::{Progress, State, Visit};

/// States by row of the grid.
type States = Vec<Option<State>>;

/// The case of the kept runs.
#[derive(Debug, Default)]
pub(super) struct Shared {
    kept: Mutex<Kept>,
}

#[derive(Debug, Default)]
struct Kept {
    runs: Vec<Run>,
    /// Runs of one engine on one case at different settings. Each is made once, and kept as long as an engine still
    /// expects it.
    case: Option<Case>,
}

#[derive(Debug)]
struct Run {
    settings: Settings,
    /// How many more times it will be requested.
    expected: usize,
    states: Option<Arc<States>>,
}

impl Shared {
    /// Announces one more request for a run at these settings.
    pub(super) fn expect(&self, settings: Settings) {
        let runs = &mut self.kept().runs;
        match runs.iter_mut().find(|run| run.settings == settings) {
            Some(run) => run.expected += 1,
            None => runs.push(Run { settings, expected: 1, states: None }),
        }
    }

    /// As [`Solver::sweep`](crate::solver::Solver::sweep) of the engine. Uses the kept states of its run on this case,
    /// if any.
    ///
    /// # Errors
    /// Those of the engine and of the visitor.
    pub(super) fn sweep(&self, engine: &dyn Engine, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        let (kept, again) = self.ask(engine.settings(), case);
        if let Some(states) = kept {
            for row in case.grid.ascending() {
                states[row].as_ref().map_or(Ok(()), |state| visit(row, state))?;
            }
            progress(1.0);
            return Ok(());
        }
        if !again {
            return engine.sweep(case, visit, progress);
        }
        let mut states: States = vec![None; case.grid.len()];
        let mut keep = |row: usize, state: &State| {
            states[row] = Some(state.clone());
            visit(row, state)
        };
        engine.sweep(case, &mut keep, progress)?;
        if let Some(run) = self.kept().runs.iter_mut().find(|run| run.settings == engine.settings()) {
            run.states = Some(Arc::new(states));
        }
        Ok(())
    }

    /// The kept states of a run at these settings, and whether it is expected again after this request.
    fn ask(&self, settings: Settings, case: &Case) -> (Option<Arc<States>>, bool) {
        let mut kept = self.kept();
        let Kept { runs, case: own } = &mut *kept;
        if !runs.is_empty() && own.as_ref() != Some(case) {
            runs.iter_mut().for_each(|run| run.states = None);
            *own = Some(case.clone());
        }
        let Some(run) = runs.iter_mut().find(|run| run.settings == settings) else { return (None, false) };
        run.expected = run.expected.saturating_sub(1);
        match run.expected {
            0 => (run.states.take(), false),
            _ => (run.states.clone(), true),
        }
    }

    /// The kept runs. A thread that panicked while it held the lock left either a whole run or none.
    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
