//! What can be set on an engine.

/// A way to reactions and balancing moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Route {
    /// Newton and Euler's equations on centred second differences of the engine's own positions.
    Differences,
    /// What the engine itself reports of the running trajectory: impulses, multipliers.
    Native,
    /// What the engine reports of one tiny step that starts on its own trajectory.
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

/// Settings of an engine. All influence results; an engine says in [`told`](super::Engine::told) what it makes of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Time step (s) of an engine with a fixed step; relative accuracy of one that controls its error.
    pub resolution: f64,
    /// Sweeps of the iteration over all constraints in a step; 0 in an engine that does not iterate.
    pub sweeps: usize,
    /// Parts that the engine itself divides a step into.
    pub substeps: usize,
    /// The way to reactions and balancing moment.
    pub route: Route,
    /// Whether the state is combined from runs at the step and at half of it, so that the leading error drops out.
    pub extrapolated: bool,
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
