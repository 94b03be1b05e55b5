//! Wraps a solver or an engine, and changes its input and its results.

use super::{Engine, Settings, StandIn, Statics};
use crate::case::Case;
use crate::error::Result;
use crate::solver::{Progress, Provision, Solver, State, Visit};
use crate::trajectory::Channel;

/// The changes that [`Wrapped`] makes to the input and the results of a solver or an engine.
pub trait Hook: Clone + Send + Sync + 'static {
    /// The case that is solved in place of `case`; `None` if `case` itself is solved.
    ///
    /// # Errors
    /// An error if there is no case to solve. After an error the solver is not called.
    fn case(&self, case: &Case) -> Result<Option<Case>> {
        let _ = case;
        Ok(None)
    }

    /// Changes a state before it is returned. `case` is the requested case, `row` the row of its grid.
    fn answer(&self, case: &Case, row: usize, state: &mut State);

    /// The hook that replaces this hook when the engine's settings change from `from` to `to`.
    #[must_use]
    fn with(&self, from: Settings, to: Settings) -> Self {
        let _ = (from, to);
        self.clone()
    }
}

/// A solver or an engine with a [`Hook`]. Apart from the hook it behaves like the wrapped solver or engine.
#[derive(Clone, Debug)]
pub struct Wrapped<H, S: ?Sized> {
    /// The changes to the input and the results.
    pub hook: H,
    /// The wrapped solver or engine.
    pub inner: Box<S>,
}

impl<H: Hook, S: Solver + ?Sized> Solver for Wrapped<H, S> {
    fn name(&self) -> &'static str {
        self.inner.name()
    }

    fn provides(&self, channel: &Channel) -> Provision {
        self.inner.provides(channel)
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        let changed = self.hook.case(case)?;
        let mut answer = |row: usize, state: &State| {
            let mut state = state.clone();
            self.hook.answer(case, row, &mut state);
            visit(row, &state)
        };
        self.inner.sweep(changed.as_ref().unwrap_or(case), &mut answer, progress)
    }
}

impl<H: Hook> StandIn for Wrapped<H, dyn Engine> {
    fn original(&self) -> &dyn Engine {
        self.inner.as_ref()
    }

    fn renewed(&self, settings: Settings) -> Box<dyn Engine> {
        let hook = self.hook.with(self.inner.settings(), settings);
        Box::new(Wrapped { hook, inner: self.inner.with(settings) })
    }

    fn own_statics(&self, case: &Case) -> Option<Statics> {
        let (changed, hook) = (self.hook.case(case).ok()?, self.hook.clone());
        let mut inner = self.inner.statics(changed.as_ref().unwrap_or(case))?;
        Some(Box::new(move |case, row, state| {
            inner(changed.as_ref().unwrap_or(case), row, state)?;
            // The hook changes motion and forces.
            // The motion of this state was already changed by an earlier call of the hook.
            // The motion is therefore restored, and only the change of the forces is kept.
            let motion = (state.motions.clone(), state.angles.clone());
            hook.answer(case, row, state);
            (state.motions, state.angles) = motion;
            Ok(())
        }))
    }
}
