//! The simulating side: engines behind one trait, checked by the conformance tests.

pub mod bodies;
mod extrapolated;
mod kept;
mod rows;
mod settings;
mod stand_in;
mod wrapped;

pub use extrapolated::Extrapolated;
pub use kept::{CachedEngine, plain_runs};
pub use rows::Rows;
pub use settings::{Route, Settings, size_of_step};
pub use stand_in::StandIn;
pub use wrapped::{Hook, Wrapped};

use std::sync::Arc;

use crate::case::Case;
use crate::error::Result;
use crate::solver::{Progress, Solver, State};
use crate::trajectory::ChannelKind;

/// Writes the forces that belong to the motion of a state, at a row of the grid, into that state.
pub type Statics = Box<dyn FnMut(&Case, usize, &mut State) -> Result<()>>;

/// An engine: a solver that integrates numerically, with settings that decide its accuracy.
///
/// Whoever stands for another engine is a [`StandIn`]. To change what an engine answers, take [`Wrapped`].
pub trait Engine: Solver {
    /// Name and version of the software behind it.
    fn version(&self) -> String;

    /// Its settings.
    fn settings(&self) -> Settings;

    /// The same engine with other settings. It ignores settings that it does not have: see [`Engine::told`].
    fn with(&self, settings: Settings) -> Box<dyn Engine>;

    /// The same engine at another resolution, otherwise unchanged.
    fn at(&self, resolution: f64) -> Box<dyn Engine> {
        self.with(Settings { resolution, ..self.settings() })
    }

    /// Whether [`Settings::resolution`] is an accuracy that the engine keeps by choosing its own steps, instead of a
    /// time step.
    fn controls_error(&self) -> bool;

    /// Available routes to reactions and balancing moment, the cheapest first.
    fn routes(&self) -> &'static [Route];

    /// Routes by which the engine itself says what it exerts on a case, the cheapest first. Empty for an engine whose
    /// usual route is such a one.
    fn own_routes(&self, case: &Case) -> &'static [Route];

    /// The fewest and the most sweeps worth trying for a case; `None` for an engine that does not iterate.
    /// Both are 1 where the iteration has nothing to converge to.
    fn sweeps(&self, case: &Case) -> Option<[usize; 2]>;

    /// Reactions and balancing moments of a motion by the engine's route, if they follow from the motion alone; `None`
    /// if they come from the engine itself. An extrapolated motion then has the forces that belong to it.
    fn statics(&self, case: &Case) -> Option<Statics>;

    /// The states of a whole run. An engine that keeps its runs hands out the one that it has.
    ///
    /// # Errors
    /// Those of [`Solver::sweep`].
    fn rows(&self, case: &Case, progress: Progress) -> Result<Arc<Rows>> {
        Rows::of_solver(self, case, progress)
    }

    /// Steps that a run of a prescribed motion takes beyond either end of its grid.
    fn overrun(&self) -> f64;

    /// Order of convergence expected of a channel of a case, with the present route and extrapolation.
    fn formal_order(&self, case: &Case, channel: &ChannelKind) -> f64;

    /// Bound on the rounding noise of a channel on the grid of a case, in the channel's unit.
    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64;

    /// Whether the factors in [`Engine::noise`] were measured. If not, they were chosen.
    fn is_noise_measured(&self) -> bool;

    /// Settings that influence the result, by name, for display.
    fn told(&self) -> Vec<(&'static str, String)>;
}
