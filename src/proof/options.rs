//! What to prove a scenario with.

use super::unknown;
use crate::scenario::Scenario;
use linkage::engine::{Engine, Route, Settings};
use linkage::error::{Error, ErrorKind, Result};
use linkage::solver::Solver;

/// What to prove a scenario with. What is not given is the scenario's own, and what that does not say is the engine's default.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Analytic solver whose trajectory is the reference; the other one checks it.
    pub reference: String,
    /// Names of engines, or `all`; the scenario's, or the default one, if there is none.
    pub engines: Vec<String>,
    /// Time step (s) of engines with a fixed step.
    pub step: Option<f64>,
    /// Accuracy of engines that control their error.
    pub accuracy: Option<f64>,
    /// Sweeps of the iteration in a step.
    pub sweeps: Option<usize>,
    /// Parts that an engine itself divides a step into.
    pub substeps: Option<usize>,
    /// The way to reactions and balancing moment.
    pub route: Option<String>,
    /// Whether the engine's state is combined from two steps.
    pub extrapolated: Option<bool>,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            reference: "assur".into(),
            engines: Vec::new(),
            step: None,
            accuracy: None,
            sweeps: None,
            substeps: None,
            route: None,
            extrapolated: None,
        }
    }
}

impl Options {
    /// The options that ask for one engine, and nothing else.
    #[must_use]
    pub fn of_engine(name: &str) -> Self {
        Options { engines: vec![name.into()], ..Options::default() }
    }

    /// The analytic solver.
    pub(super) fn reference(&self) -> Result<&'static dyn Solver> {
        let known = || analytic::all().into_iter().map(|solver| solver.name());
        analytic::named(&self.reference).ok_or_else(|| unknown("analytic solver", &self.reference, known()))
    }

    /// The engines with their settings.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if an engine or a route is not known, or if a number cannot be a setting.
    pub fn engines(&self, scenario: &Scenario) -> Result<Vec<Box<dyn Engine>>> {
        let own = &scenario.engine;
        let step = self.step.unwrap_or(scenario.dt);
        let known = crate::engines::all(step);
        let chosen = match (self.engines.as_slice(), &own.name) {
            ([], None) => known.into_iter().take(1).collect(),
            ([], Some(name)) => vec![named(name, step).map_err(|error| error.key("engine.name"))?],
            ([one], _) if one == "all" => known,
            (names, _) => names.iter().map(|name| named(name, step)).collect::<Result<_>>()?,
        };
        let several = chosen.len() > 1;
        chosen.into_iter().map(|engine| self.set(engine, scenario, several)).collect()
    }

    /// An engine with the settings asked for. Of `several` engines side by side those that do not know a route keep their own.
    fn set(&self, engine: Box<dyn Engine>, scenario: &Scenario, several: bool) -> Result<Box<dyn Engine>> {
        let (own, defaults) = (&scenario.engine, engine.settings());
        let resolution = match engine.controls_error() {
            true => self.accuracy.unwrap_or(defaults.resolution),
            false => defaults.resolution,
        };
        let count = |asked: Option<usize>, own: Option<usize>, default: usize, what: &str| match asked.or(own) {
            Some(0) => Err(Error::new(ErrorKind::Input, format!("found 0 {what}, but an engine needs at least one"))
                .help("give a whole number greater than zero")),
            // An engine that does not iterate has no use for them.
            Some(_) if default == 0 => Ok(0),
            Some(number) => Ok(number),
            None => Ok(default),
        };
        let mut route = defaults.route;
        if let Some(name) = self.route.as_ref().or(own.route.as_ref()) {
            let asked = Route::named(name)
                .ok_or_else(|| unknown("route to reactions", name, Route::ALL.iter().map(|route| route.name())))?;
            match engine.routes().contains(&asked) {
                true => route = asked,
                false if several => {}
                false => {
                    let offered = engine.routes().iter().map(|route| route.name());
                    return Err(unknown(&format!("route of engine {}", engine.name()), name, offered));
                }
            }
        }
        let settings = Settings {
            resolution,
            sweeps: count(self.sweeps, own.sweeps, defaults.sweeps, "sweeps")?,
            substeps: count(self.substeps, own.substeps, defaults.substeps, "substeps")?,
            route,
            extrapolated: self.extrapolated.or(own.extrapolated).unwrap_or(defaults.extrapolated),
        };
        Ok(if settings == defaults { engine } else { engine.with(settings) })
    }
}

fn named(name: &str, step: f64) -> Result<Box<dyn Engine>> {
    crate::engines::named(name, step).ok_or_else(|| {
        let known = crate::engines::all(step);
        unknown("engine", name, known.iter().map(|engine| engine.name()).chain(["all"]))
    })
}
