//! Solvers and engines with one fault.

use super::kinds::{At, Kind, Plant};
use linkage::case::Case;
use linkage::engine::{Engine, Route, Settings, Statics};
use linkage::error::{Error, ErrorKind, Result};
use linkage::solver::{Progress, Provision, Solver, State, Visit};
use linkage::trajectory::{Channel, ChannelKind};

/// A kind of fault with its size.
#[derive(Clone, Copy)]
pub(super) struct Fault {
    pub(super) kind: &'static Kind,
    pub(super) size: f64,
}

impl Fault {
    /// The case with the fault in it; `None` where it has no such part. The same case for a fault in answers.
    pub(super) fn case(self, case: &Case) -> Option<Case> {
        match self.kind.plant {
            Plant::Case(change) => change(case, self.size),
            Plant::Answer(_) => Some(case.clone()),
        }
    }

    fn answered(self, case: &Case, row: usize, state: &State) -> State {
        let mut state = state.clone();
        match self.kind.plant {
            Plant::Case(_) => {}
            Plant::Answer(change) => {
                // What has no such part stays as it is.
                let _ = change(At { case, row }, &mut state, self.size);
            }
        }
        state
    }
}

/// A solver, or an engine, with a fault.
pub(super) struct Planted<S: ?Sized> {
    pub(super) fault: Fault,
    pub(super) inner: Box<S>,
}

impl<S: ?Sized> Planted<S> {
    fn case(&self, case: &Case) -> Result<Case> {
        let message = || format!("the case with the fault {} cannot be put together", self.fault.kind.name);
        self.fault.case(case).ok_or_else(|| Error::new(ErrorKind::Geometry, message()))
    }
}

impl<S: Solver + ?Sized> Solver for Planted<S> {
    fn name(&self) -> &'static str {
        self.inner.name()
    }

    fn provides(&self, channel: &Channel) -> Provision {
        self.inner.provides(channel)
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        match self.fault.kind.plant {
            Plant::Case(_) => self.inner.sweep(&self.case(case)?, visit, progress),
            Plant::Answer(_) => {
                let mut wrong = |row: usize, state: &State| visit(row, &self.fault.answered(case, row, state));
                self.inner.sweep(case, &mut wrong, progress)
            }
        }
    }
}

impl Engine for Planted<dyn Engine> {
    fn version(&self) -> String {
        self.inner.version()
    }

    fn settings(&self) -> Settings {
        self.inner.settings()
    }

    fn with(&self, settings: Settings) -> Box<dyn Engine> {
        Box::new(Planted { fault: self.fault, inner: self.inner.with(settings) })
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
        let wrong = self.case(case).ok()?;
        let (mut inner, fault) = (self.inner.statics(&wrong)?, self.fault);
        Some(Box::new(move |case, state, t| {
            match fault.kind.plant {
                Plant::Case(_) => inner(&wrong, state, t),
                Plant::Answer(_) => {
                    // The motion has the fault already; the forces get it here.
                    let motion = (state.motions.clone(), state.angles.clone());
                    inner(case, state, t)?;
                    let row = case.grid.times.iter().position(|own| *own == t).unwrap_or(0);
                    *state = fault.answered(case, row, state);
                    (state.motions, state.angles) = motion;
                    Ok(())
                }
            }
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
