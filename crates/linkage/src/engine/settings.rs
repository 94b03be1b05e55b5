//! Settings of an engine.

use std::fmt;

use crate::case::Case;
use crate::math::KeepNan;

crate::words! {
    /// A method for reactions and balancing moment.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Route: name {
        /// Newton-Euler equations, with accelerations from centred second differences of the engine's positions.
        Differences = "differences",
        /// Values that the engine reports during the run, such as impulses or multipliers.
        Native = "native",
        /// Values that the engine reports for a tiny additional step.
        /// The additional step starts from a state of the engine's trajectory.
        Probe = "probe",
    }
}

impl fmt::Display for Route {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Settings of an engine. Every setting that the engine uses influences the results.
/// [`told`](super::Engine::told) lists these settings, apart from the step size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Time step (s) of an engine with a fixed step; relative accuracy of an engine that controls its error.
    pub resolution: f64,
    /// Iteration sweeps over all constraints per step; 0 in an engine that does not iterate.
    pub sweeps: usize,
    /// Number of substeps into which the engine itself divides a step.
    pub substeps: usize,
    /// The method for reactions and balancing moment.
    pub route: Route,
    /// Number of Richardson extrapolations to a vanishing time step; 0 for a plain run.
    /// With `n` extrapolations, runs at h, h / 2, ..., h / 2^n are combined. The `n` leading error terms then cancel.
    pub extrapolated: usize,
}

/// Up to this number of moving links, a step costs about as much as on a four-bar.
const SMALL: f64 = 6.0;

/// Work of a step on a case, as a multiple of the work of a step on a four-bar.
/// The work grows with the number of links, because the mass matrix of a multibody is full.
/// Costs were measured on chains of 21, 61 and 201 moving links, relative to a four-bar.
/// A step costs 12, 250 and 5000 times as much. A sweep costs 12, 100 and 800 times as much.
#[must_use]
pub fn size_of_step(case: &Case) -> f64 {
    let moving = case.mechanism.links().len().saturating_sub(1) as f64;
    (moving / SMALL).larger(1.0).powi(2)
}

/// Work of one sweep, as a fraction of the work of a step without sweeps.
/// Measured on a four-bar: about twenty sweeps cost as much as the rest of the step.
const SWEEP: f64 = 0.05;

impl Settings {
    /// Work of a plain run per second of motion. The unit is a step without sweeps.
    /// The work is computed from the settings, not timed.
    #[must_use]
    pub fn work(&self) -> f64 {
        // All sweeps are done in every substep.
        self.substeps.max(1) as f64 * (1.0 + SWEEP * self.sweeps as f64) / self.resolution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_proportional_to_substeps() {
        let one = Settings { resolution: 0.5, sweeps: 20, substeps: 1, route: Route::Native, extrapolated: 0 };
        assert_eq!((one.work(), Settings { substeps: 7, ..one }.work()), (4.0, 28.0));
    }

    #[test]
    fn routes_are_found_by_their_names() {
        for route in Route::ALL {
            assert_eq!(
                (Route::named(route.name()), format!("{route:>6}")),
                (Some(route), format!("{:>6}", route.name()))
            );
        }
        assert_eq!(Route::named("guess"), None);
    }
}
