//! Engines: numerical simulations behind one trait, checked by the conformance tests.

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

/// Computes the forces for the motion of a state, and writes the forces into the state.
/// The second argument is the state's row in the grid.
pub type Statics = Box<dyn FnMut(&Case, usize, &mut State) -> Result<()>>;

/// An engine: a solver that integrates numerically and whose settings determine its accuracy.
///
/// Implement [`StandIn`] for an engine that replaces another engine. Use [`Wrapped`] to change an engine's results.
pub trait Engine: Solver {
    /// Name and version of the underlying software.
    fn version(&self) -> String;

    /// Settings of the engine.
    fn settings(&self) -> Settings;

    /// Returns this engine with the given settings.
    /// Settings that the engine does not use are ignored. [`Engine::told`] lists the settings in use.
    fn with(&self, settings: Settings) -> Box<dyn Engine>;

    /// Returns this engine at the given resolution. All other settings stay unchanged.
    fn at(&self, resolution: f64) -> Box<dyn Engine> {
        self.with(Settings { resolution, ..self.settings() })
    }

    /// Whether the engine controls its error.
    /// If the engine controls its error, [`Settings::resolution`] is an accuracy, and the engine chooses its time
    /// steps.
    /// For any other engine, [`Settings::resolution`] is the time step.
    fn controls_error(&self) -> bool;

    /// Methods for joint reactions and balancing moment, the cheapest method first.
    fn routes(&self) -> &'static [Route];

    /// Methods by which the engine reports the forces that act in its simulation. The cheapest method comes first.
    /// The list is empty if the engine's default method already reports these forces.
    fn own_routes(&self, case: &Case) -> &'static [Route];

    /// Smallest and largest useful number of sweeps for a case; `None` for an engine that does not iterate.
    /// Both numbers are 1 if one sweep already solves the case.
    fn sweeps(&self, case: &Case) -> Option<[usize; 2]>;

    /// Returns a function that computes reactions and balancing moments from a motion, by the engine's method.
    /// Returns `None` if the motion alone does not determine the forces.
    /// If the result is `None`, the engine must report the forces.
    /// [`Extrapolated`] uses the returned function to compute the forces of the extrapolated motion.
    fn statics(&self, case: &Case) -> Option<Statics>;

    /// Runs the whole case and returns its states.
    /// An engine that stores its runs returns the stored run, if there is one.
    ///
    /// # Errors
    /// The errors of [`Solver::sweep`].
    fn rows(&self, case: &Case, progress: Progress) -> Result<Arc<Rows>> {
        Rows::of_solver(self, case, progress)
    }

    /// Largest number of time steps by which a run of a prescribed motion extends beyond either end of the grid.
    fn overrun(&self) -> f64;

    /// Expected order of convergence of a channel, with the engine's present method and extrapolation.
    fn formal_order(&self, case: &Case, channel: &ChannelKind) -> f64;

    /// Bound on the rounding error of a channel on the grid of a case, in the channel's unit.
    fn noise(&self, case: &Case, channel: &ChannelKind) -> f64;

    /// Whether the bound of [`Engine::noise`] is based on measured rounding errors.
    /// If the result is false, the bound is based on assumed rounding errors.
    fn is_noise_measured(&self) -> bool;

    /// The engine's properties that influence the result, as names and values for display.
    /// The step size is not included.
    fn told(&self) -> Vec<(&'static str, String)>;
}
