//! A solver or an engine that stands for another one and changes what it answers.

use super::{Engine, Route, Settings, Statics};
use crate::case::Case;
use crate::error::Result;
use crate::solver::{Progress, Provision, Solver, State, Visit};
use crate::trajectory::{Channel, ChannelKind};

/// What a [`Wrapped`] solver or engine does differently from the one it stands for.
pub trait Hook: Clone + Send + Sync + 'static {
    /// The case that is solved instead of `case`; `None` if it is `case` itself.
    ///
    /// # Errors
    /// Where there is no such case: nothing is solved then.
    fn case(&self, case: &Case) -> Result<Option<Case>> {
        let _ = case;
        Ok(None)
    }

    /// Changes a state on its way out. `case` is the one that was asked, `row` the row of its grid.
    fn answer(&self, case: &Case, row: usize, state: &mut State);

    /// The hook of the same engine when its settings change.
    #[must_use]
    fn with(&self, from: Settings, to: Settings) -> Self {
        let _ = (from, to);
        self.clone()
    }
}

/// A solver, or an engine, with a [`Hook`]. In everything else it is the one that it stands for.
#[derive(Clone, Debug)]
pub struct Wrapped<H, S: ?Sized> {
    /// What it does differently.
    pub hook: H,
    /// What it stands for.
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

impl<H: Hook> Engine for Wrapped<H, dyn Engine> {
    fn version(&self) -> String {
        self.inner.version()
    }

    fn settings(&self) -> Settings {
        self.inner.settings()
    }

    fn with(&self, settings: Settings) -> Box<dyn Engine> {
        let hook = self.hook.with(self.inner.settings(), settings);
        Box::new(Wrapped { hook, inner: self.inner.with(settings) })
    }

    fn controls_error(&self) -> bool {
        self.inner.controls_error()
    }

    fn routes(&self) -> &'static [Route] {
        self.inner.routes()
    }

    fn own_routes(&self, case: &Case) -> &'static [Route] {
        self.inner.own_routes(case)
    }

    fn sweeps(&self, case: &Case) -> Option<[usize; 2]> {
        self.inner.sweeps(case)
    }

    fn statics(&self, case: &Case) -> Option<Statics> {
        let (changed, hook) = (self.hook.case(case).ok()?, self.hook.clone());
        let mut inner = self.inner.statics(changed.as_ref().unwrap_or(case))?;
        Some(Box::new(move |case, row, state| {
            inner(changed.as_ref().unwrap_or(case), row, state)?;
            // The motion is changed already; the forces are changed here.
            let motion = (state.motions.clone(), state.angles.clone());
            hook.answer(case, row, state);
            (state.motions, state.angles) = motion;
            Ok(())
        }))
    }

    fn overrun(&self) -> f64 {
        self.inner.overrun()
    }

    fn formal_order(&self, case: &Case, channel: &ChannelKind) -> f64 {
        self.inner.formal_order(case, channel)
    }

    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64 {
        self.inner.noise(case, channel)
    }

    fn is_noise_measured(&self) -> bool {
        self.inner.is_noise_measured()
    }

    fn told(&self) -> Vec<(&'static str, String)> {
        self.inner.told()
    }
}
