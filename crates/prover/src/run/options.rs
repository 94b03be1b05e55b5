//! Options of a proof.

use super::each_side::Reference;
use super::settle;
use crate::engines::{self, EngineName};
use crate::sentences;
use linkage::case::Case;
use linkage::engine::{Engine, Route, Settings};
use linkage::error::{Error, ErrorKind, Result};
use scenario::{EngineSetting, EngineSettings, Scenario};

/// Defines one method for each setting. The method sets the setting.
macro_rules! setters {
    ($($(#[$doc:meta])* $name:ident: $kind:ty,)*) => {$(
        $(#[$doc])*
        pub fn $name(mut self, value: $kind) -> Self {
            self.settings.$name = EngineSetting::of(value);
            self
        }
    )*};
}

/// Options of a proof.
///
/// An option that is not given is taken from the scenario.
/// If neither the options nor the scenario give the step, the sweeps or the extrapolation, the proof finds this
/// setting.
/// If neither the options nor the scenario give the substeps, the route or the accuracy, the engine's default is used.
/// If a step is given, runs are extrapolated only if extrapolation is requested.
/// The numbers in the options are checked when the proof begins.
///
/// ```
/// use linkproof::Options;
/// use linkproof::parts::{EngineName, Reference, Route};
///
/// let options = Options::default()
///     .engine(EngineName::Rapier)
///     .engine(EngineName::Impulse)
///     .reference(Reference::Newton)
///     .route(Route::Probe)
///     .step(5e-4);
/// assert_eq!(options.settings.engines.value().unwrap().len(), 2);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[must_use]
pub struct Options {
    /// Analytic side whose trajectory is the reference. The second analytic side checks this trajectory.
    pub reference: Reference,
    /// Engines and their settings. Settings that are not given in the options are taken from the scenario or found by
    /// the proof.
    pub settings: EngineSettings,
    /// Work allowed to find the settings that are not given. The unit is a step without sweeps. The default is enough
    /// for most cases.
    pub budget: Option<f64>,
    /// Memory allowed (bytes); by default 4e9. A run does not begin if its estimated memory exceeds this limit.
    pub memory: Option<f64>,
}

/// An engine, its given settings, and the work allowed to find the other settings.
pub struct Chosen {
    pub(crate) engine: Box<dyn Engine>,
    /// Given settings. If the route is given, only this route is judged. If the route is free, the engine's own forces
    /// are judged too.
    pub(crate) given: EngineSettings,
    pub(crate) budget: f64,
}

impl Chosen {
    /// This choice with the engine that `around` returns for the present engine.
    pub(crate) fn with_engine(self, around: &dyn Fn(Box<dyn Engine>) -> Box<dyn Engine>) -> Self {
        Chosen { engine: around(self.engine), ..self }
    }

    /// This choice with the engine's present route as given route. Forces that the engine itself exerts are then not
    /// judged.
    pub(crate) fn by_motion_alone(mut self) -> Self {
        self.given.route = EngineSetting::of(self.engine.settings().route);
        self
    }
}

impl Options {
    /// Adds an engine.
    pub fn engine(mut self, engine: EngineName) -> Self {
        let mut engines = self.settings.engines.value().cloned().unwrap_or_default();
        engines.push(engine);
        self.settings.engines = EngineSetting::of(engines);
        self
    }

    /// Options that give all settings of an engine. `None` if the engine does not belong to this project.
    pub fn exactly(engine: &dyn Engine) -> Option<Self> {
        let settings = EngineSettings::exactly(engine);
        (!settings.engines.is_free()).then(|| Options { settings, ..Options::default() })
    }

    /// Adds every engine of this build. The engines are all judged in one proof.
    pub fn every_engine(mut self) -> Self {
        let built = EngineName::ALL.into_iter().filter(|engine| engines::is_built(*engine));
        self.settings.engines = EngineSetting::of(built.collect());
        self
    }

    /// Sets the analytic side whose trajectory is the reference.
    pub fn reference(mut self, side: Reference) -> Self {
        self.reference = side;
        self
    }

    setters! {
        /// Sets the time step (s) of engines with a fixed step.
        step: f64,
        /// Sets the relative accuracy of engines that control their error.
        accuracy: f64,
        /// Sets the number of sweeps of the iteration in a step.
        sweeps: usize,
        /// Sets the number of substeps into which an engine divides a step.
        substeps: usize,
        /// Sets the route by which reactions and balancing moment are computed.
        route: Route,
        /// Sets how many times the engine's state is extrapolated to a step size of zero.
        extrapolated: usize,
    }

    /// Sets the work allowed to find the settings that are not given. The unit is a step without sweeps.
    pub fn budget(mut self, steps: f64) -> Self {
        self.budget = Some(steps);
        self
    }

    /// Sets the memory allowed (bytes).
    pub fn memory(mut self, bytes: f64) -> Self {
        self.memory = Some(bytes);
        self
    }

    /// Number of engines that these options give, at least 1.
    #[must_use]
    pub fn engine_count(&self) -> usize {
        self.settings.engines.value().map_or(1, |engines| engines.len().max(1))
    }

    /// The engines with their settings.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if a number cannot be a setting, or if an engine does not have the route;
    /// [`ErrorKind::Unsupported`] for an engine that this build does not have.
    pub fn set_engines(&self, scenario: &Scenario) -> Result<Vec<Box<dyn Engine>>> {
        let chosen = self.chosen_at(&scenario.engine, engines::usual_step(&scenario.case))?;
        Ok(chosen.into_iter().map(|chosen| chosen.engine).collect())
    }

    /// The engines for the proof of a case.
    /// A setting is free if neither the options nor the scenario's settings `own` give it.
    ///
    /// # Errors
    /// The errors of [`Options::set_engines`].
    pub fn chosen(&self, own: &EngineSettings, case: &Case) -> Result<Vec<Chosen>> {
        self.chosen_at(own, engines::coarse_step(case))
    }

    /// The engines at the time step `step` (s), unless another step is given.
    fn chosen_at(&self, own: &EngineSettings, step: f64) -> Result<Vec<Chosen>> {
        let given = self.settings.or(own);
        let engines = given.engines.value().map_or(&[][..], Vec::as_slice);
        let engines = if engines.is_empty() { &EngineName::ALL[..1] } else { engines };
        let chosen = |&name: &EngineName| {
            let engine = engines::with_step(name, given.step.get().unwrap_or(step));
            let engine = engine.map_err(|error| given.engines.blamed(error))?;
            let budget = self.budget.unwrap_or(settle::BUDGET);
            Ok(Chosen { engine: set(engine, &given, engines.len() > 1)?, given: given.clone(), budget })
        };
        engines.iter().map(chosen).collect()
    }
}

/// An engine with the given settings.
/// If `several` engines are judged, an engine without the given route keeps its default route.
fn set(engine: Box<dyn Engine>, given: &EngineSettings, several: bool) -> Result<Box<dyn Engine>> {
    let defaults = engine.settings();
    let resolution = match engine.controls_error() {
        true => given.accuracy.get().unwrap_or(defaults.resolution),
        false => defaults.resolution,
    };
    let count = |own: &EngineSetting<usize>, default: usize, what: &str| match own.get() {
        Some(0) => {
            let error = Error::new(ErrorKind::Input, sentences::found_but_an_engine_needs(&what));
            Err(own.blamed(error.help(sentences::GIVE_A_WHOLE_NUMBER_GREATER)))
        }
        // An engine without iteration ignores sweeps.
        Some(_) if default == 0 => Ok(0),
        Some(number) => Ok(number),
        None => Ok(default),
    };
    let route = match given.route.get() {
        Some(asked) if engine.routes().contains(&asked) => asked,
        Some(asked) if !several => {
            let offered: Vec<&str> = engine.routes().iter().map(|route| route.name()).collect();
            let message = sentences::there_is_no_route_of_engine(&engine.name(), &asked.name());
            let error = Error::new(ErrorKind::Input, message).help(sentences::choose_one_of(&offered.join(", ")));
            return Err(given.route.blamed(error));
        }
        Some(_) | None => defaults.route,
    };
    let settings = Settings {
        resolution,
        sweeps: count(&given.sweeps, defaults.sweeps, "sweeps")?,
        substeps: count(&given.substeps, defaults.substeps, "substeps")?,
        route,
        extrapolated: given.extrapolated.get().unwrap_or(defaults.extrapolated),
    };
    Ok(if settings == defaults { engine } else { engine.with(settings) })
}
