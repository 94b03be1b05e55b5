//! Solvers that replace an engine.
//! This module forwards to the replaced engine all methods that the replacement does not change.

use std::sync::Arc;

use super::{Engine, Route, Rows, Settings, Statics};
use crate::case::Case;
use crate::error::Result;
use crate::solver::{Progress, Solver};
use crate::trajectory::ChannelKind;

/// A solver that replaces an engine and therefore is an engine itself.
/// A stand-in overrides only the methods that it changes.
/// A new method of [`Engine`] must be forwarded in this module; otherwise the code does not compile.
pub trait StandIn: Solver {
    /// The engine that the stand-in replaces.
    fn original(&self) -> &dyn Engine;

    /// [`Engine::with`] of the stand-in.
    fn renewed(&self, settings: Settings) -> Box<dyn Engine>;

    /// [`Engine::settings`] of the stand-in. By default, the settings are those of the original.
    fn own_settings(&self) -> Settings {
        self.original().settings()
    }

    /// [`Engine::rows`] of the stand-in. By default, [`Solver::sweep`] of the stand-in supplies the states.
    ///
    /// # Errors
    /// The errors of [`Solver::sweep`].
    fn own_rows(&self, case: &Case, progress: Progress) -> Result<Arc<Rows>> {
        Rows::of_solver(self, case, progress)
    }

    /// [`Engine::statics`] of the stand-in. By default, the original supplies the function.
    fn own_statics(&self, case: &Case) -> Option<Statics> {
        self.original().statics(case)
    }

    /// [`Engine::formal_order`] of the stand-in. By default, the order is that of the original.
    fn own_order(&self, case: &Case, channel: &ChannelKind) -> f64 {
        self.original().formal_order(case, channel)
    }

    /// [`Engine::noise`] of the stand-in. By default, the noise is that of the original.
    fn own_noise(&self, case: &Case, channel: &ChannelKind) -> f64 {
        self.original().noise(case, channel)
    }

    /// [`Engine::told`] of the stand-in. By default, the list is that of the original.
    fn own_told(&self) -> Vec<(&'static str, String)> {
        self.original().told()
    }
}

impl<T: StandIn> Engine for T {
    fn version(&self) -> String {
        self.original().version()
    }

    fn settings(&self) -> Settings {
        self.own_settings()
    }

    fn with(&self, settings: Settings) -> Box<dyn Engine> {
        self.renewed(settings)
    }

    fn controls_error(&self) -> bool {
        self.original().controls_error()
    }

    fn routes(&self) -> &'static [Route] {
        self.original().routes()
    }

    fn own_routes(&self, case: &Case) -> &'static [Route] {
        self.original().own_routes(case)
    }

    fn sweeps(&self, case: &Case) -> Option<[usize; 2]> {
        self.original().sweeps(case)
    }

    fn statics(&self, case: &Case) -> Option<Statics> {
        self.own_statics(case)
    }

    fn rows(&self, case: &Case, progress: Progress) -> Result<Arc<Rows>> {
        self.own_rows(case, progress)
    }

    fn overrun(&self) -> f64 {
        self.original().overrun()
    }

    fn formal_order(&self, case: &Case, channel: &ChannelKind) -> f64 {
        self.own_order(case, channel)
    }

    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64 {
        self.own_noise(case, channel)
    }

    fn is_noise_measured(&self) -> bool {
        self.original().is_noise_measured()
    }

    fn told(&self) -> Vec<(&'static str, String)> {
        self.own_told()
    }
}
