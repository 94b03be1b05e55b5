//! Settings of an engine.

/// A route to reactions and balancing moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Route {
    /// Newton-Euler equations on centred second differences of the engine's own positions.
    Differences,
    /// Values that the engine itself reports for the running trajectory: impulses, multipliers.
    Native,
    /// Values that the engine reports for one tiny step that starts on its own trajectory.
    Probe,
}

impl Route {
    /// All routes.
    pub const ALL: [Route; 3] = [Route::Differences, Route::Native, Route::Probe];

    /// Name, as on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Route::Differences => "differences",
            Route::Native => "native",
            Route::Probe => "probe",
        }
    }

    /// The route called `name`.
    #[must_use]
    pub fn named(name: &str) -> Option<Route> {
        Route::ALL.into_iter().find(|route| route.name() == name)
    }
}

/// Settings of an engine. All influence results. An engine lists in [`told`](super::Engine::told) those that it uses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Time step (s) of an engine with a fixed step; relative accuracy of an engine that controls its error.
    pub resolution: f64,
    /// Iteration sweeps over all constraints in a step; 0 in an engine that does not iterate.
    pub sweeps: usize,
    /// Number of parts into which the engine itself divides a step.
    pub substeps: usize,
    /// The route to reactions and balancing moment.
    pub route: Route,
    /// How often the state is extrapolated to step zero: `n` combines runs at h, h / 2, ..., h / 2^n, so that the `n`
    /// leading errors cancel. 0 for a plain run.
    pub extrapolated: usize,
}

/// Work of a sweep, in units of the work of a step without sweeps: measured on a four-bar, where the sweeps of a step
/// cost as much as its rest at about twenty of them.
const SWEEP: f64 = 0.05;

impl Settings {
    /// Work of a plain run over one second of the motion, in steps without sweeps. It is counted, not timed.
    #[must_use]
    pub fn work(&self) -> f64 {
        (1.0 + SWEEP * self.sweeps as f64) / self.resolution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn routes_are_found_by_their_names() {
        for route in Route::ALL {
            assert_eq!(Route::named(route.name()), Some(route));
        }
        assert_eq!(Route::named("guess"), None);
    }
}
