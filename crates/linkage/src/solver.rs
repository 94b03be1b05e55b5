//! The interface of all solvers, and how they deliver their states.

mod sampler;
mod state;

use crate::sentences;
pub use sampler::Sampler;
pub use state::State;

use crate::case::Case;
use crate::error::{Error, ErrorKind, Result};
use crate::trajectory::{Channel, Trajectory};

/// How a solver obtains a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Provision {
    /// The solver computes the channel, or the engine reports the channel without conversion.
    Computed,
    /// The channel is derived from other results of the engine. The text describes the method.
    Derived(&'static str),
}

/// Function that receives the completed fraction of a long run, from 0 to 1.
pub type Progress<'a> = &'a mut dyn FnMut(f64);

/// Function that receives every state with its row of the grid. If the function returns an error, the run stops.
pub type Visit<'a> = &'a mut dyn FnMut(usize, &State) -> Result<()>;

/// A method that turns a case into a trajectory.
pub trait Solver: Send + Sync {
    /// Short name, as on the command line.
    fn name(&self) -> &'static str;

    /// How this solver obtains `channel`.
    fn provides(&self, channel: &Channel) -> Provision;

    /// Calls `visit` once for every instant of the case's grid, with the row of the instant and the state. The order of
    /// the instants is arbitrary.
    /// Only the parts of the state that the requested channels need are computed; the other parts are undefined.
    ///
    /// # Errors
    /// If the solution cannot stay on the requested branch, an error that gives the crank angle.
    /// An error of `visit` is passed on.
    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()>;

    /// Does the same as [`Solver::sweep`], without progress reports.
    ///
    /// # Errors
    /// The errors of [`Solver::sweep`].
    fn each(&self, case: &Case, visit: Visit) -> Result<()> {
        self.sweep(case, visit, &mut |_| {})
    }

    /// Solves the case: computes all requested channels on the case's grid.
    ///
    /// # Errors
    /// The errors of [`Solver::sweep`], or an error if a result is NaN or infinite.
    fn solve(&self, case: &Case) -> Result<Trajectory> {
        self.solve_with(case, &mut |_| {})
    }

    /// Does the same as [`Solver::solve`], with progress reports: `progress` receives the completed fraction of the
    /// run, from 0 to 1.
    ///
    /// # Errors
    /// The errors of [`Solver::solve`].
    fn solve_with(&self, case: &Case, progress: Progress) -> Result<Trajectory> {
        let mut sampler = Sampler::new(case);
        let mut put = |row: usize, state: &State| {
            sampler.put(case, row, state);
            Ok(())
        };
        self.sweep(case, &mut put, progress)?;
        sampler.finish(case)
    }
}

/// Checks that no requested instant of a free motion lies before t = 0, where the motion starts.
/// A prescribed motion allows any instant.
///
/// # Errors
/// [`ErrorKind::Input`] if an instant lies before t = 0. The error contains this instant.
pub fn check_instants(case: &Case) -> Result<()> {
    match case.grid.times.iter().find(|&&t| t < 0.0) {
        Some(t) if case.is_free() => {
            let message = sentences::the_motion_is_free_from_on_but_an_instant(&t);
            Err(Error::new(ErrorKind::Input, message).key("grid").help(sentences::LET_THE_GRID_GO_BY_TIME_FROM_ON))
        }
        _ => Ok(()),
    }
}
