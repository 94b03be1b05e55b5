//! Options of a proof.

use super::settle::{self, Free};
use crate::engines::{self, EngineName};
use linkage::engine::{Engine, Route, Settings};
use linkage::error::{Error, ErrorKind, Result};
use linkage::solver::Solver;
use scenario::Scenario;

/// An analytic side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reference {
    /// Side 1: Assur groups, dyads in closed form.
    #[default]
    Assur,
    /// Side 2: the whole mechanism by Newton and Lagrange multipliers.
    Newton,
}

impl Reference {
    /// Both sides, the default first.
    pub const ALL: [Reference; 2] = [Reference::Assur, Reference::Newton];

    /// Name, as on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.solver().name()
    }

    /// The side called `name`.
    #[must_use]
    pub fn named(name: &str) -> Option<Reference> {
        Reference::ALL.into_iter().find(|side| side.name() == name)
    }

    /// The solver of this side.
    #[must_use]
    pub fn solver(self) -> &'static dyn Solver {
        match self {
            Reference::Assur => &analytic::AssurSolver,
            Reference::Newton => &analytic::NewtonSolver,
        }
    }
}

/// Options of a proof.
///
/// An option that is not given is taken from the scenario. If the scenario does not state it, the proof finds step,
/// sweeps and extrapolation; of substeps, route and accuracy the engine's default applies. With a given step nothing is
/// extrapolated unless asked for. Numbers are checked when the proof begins.
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
/// assert_eq!(options.engines.len(), 2);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Analytic side whose trajectory is the reference; the other side checks it.
    pub reference: Reference,
    /// Engines. If empty: the scenario's engine, or else the default one.
    pub engines: Vec<EngineName>,
    /// Time step (s) of engines with a fixed step.
    pub step: Option<f64>,
    /// Relative accuracy of engines that control their error.
    pub accuracy: Option<f64>,
    /// Sweeps of the iteration in a step.
    pub sweeps: Option<usize>,
    /// Number of substeps into which an engine divides a step.
    pub substeps: Option<usize>,
    /// Route by which reactions and balancing moment are computed.
    pub route: Option<Route>,
    /// How often the engine's state is extrapolated to step zero: 1 combines runs at the step and at half of it.
    pub extrapolated: Option<usize>,
    /// Work allowed for finding settings that are not given, in steps without sweeps; the default is enough for most.
    pub budget: Option<f64>,
    /// Memory allowed (bytes); by default 4e9. A run that is estimated to need more does not begin.
    pub memory: Option<f64>,
}

/// An engine with its settings, and those that the proof may change.
pub struct Chosen {
    pub(crate) engine: Box<dyn Engine>,
    pub(crate) free: Free,
    /// What is free where the engine's own forces are judged besides; `None` if a route is given, which alone counts
    /// then.
    pub(crate) own_forces: Option<Free>,
    pub(crate) budget: f64,
}

impl Chosen {
    /// The same with `around` the engine, and with its own forces or without.
    pub(crate) fn with_engine(self, around: &dyn Fn(Box<dyn Engine>) -> Box<dyn Engine>, own_forces: bool) -> Self {
        Chosen { engine: around(self.engine), own_forces: self.own_forces.filter(|_| own_forces), ..self }
    }
}

impl Options {
    /// Adds an engine.
    #[must_use]
    pub fn engine(mut self, engine: EngineName) -> Self {
        self.engines.push(engine);
        self
    }

    /// Options that give all settings of an engine. `None` if it is none of those that this project has.
    pub fn exactly(engine: &dyn Engine) -> Option<Self> {
        let Settings { resolution, sweeps, substeps, route, extrapolated } = engine.settings();
        let options = Options::default().engine(EngineName::named(engine.name())?).route(route);
        let options = if sweeps > 0 { options.sweeps(sweeps) } else { options };
        Some(match engine.controls_error() {
            true => options.accuracy(resolution),
            false => options.step(resolution).substeps(substeps).extrapolated(extrapolated),
        })
    }

    /// Adds every engine that this build has; they run side by side.
    #[must_use]
    pub fn every_engine(mut self) -> Self {
        self.engines = EngineName::ALL.into_iter().filter(|engine| engine.is_built()).collect();
        self
    }

    /// Sets the analytic side whose trajectory is the reference.
    #[must_use]
    pub fn reference(mut self, side: Reference) -> Self {
        self.reference = side;
        self
    }

    /// Sets the time step (s) of engines with a fixed step.
    #[must_use]
    pub fn step(mut self, step: f64) -> Self {
        self.step = Some(step);
        self
    }

    /// Sets the relative accuracy of engines that control their error.
    #[must_use]
    pub fn accuracy(mut self, accuracy: f64) -> Self {
        self.accuracy = Some(accuracy);
        self
    }

    /// Sets the sweeps of the iteration in a step.
    #[must_use]
    pub fn sweeps(mut self, sweeps: usize) -> Self {
        self.sweeps = Some(sweeps);
        self
    }

    /// Sets the number of substeps into which an engine divides a step.
    #[must_use]
    pub fn substeps(mut self, substeps: usize) -> Self {
        self.substeps = Some(substeps);
        self
    }

    /// Sets the route by which reactions and balancing moment are computed.
    #[must_use]
    pub fn route(mut self, route: Route) -> Self {
        self.route = Some(route);
        self
    }

    /// Sets how often the engine's state is extrapolated to step zero.
    #[must_use]
    pub fn extrapolated(mut self, times: usize) -> Self {
        self.extrapolated = Some(times);
        self
    }

    /// Sets the work allowed for finding settings that are not given, in steps without sweeps.
    #[must_use]
    pub fn budget(mut self, steps: f64) -> Self {
        self.budget = Some(steps);
        self
    }

    /// Sets the memory allowed (bytes).
    #[must_use]
    pub fn memory(mut self, bytes: f64) -> Self {
        self.memory = Some(bytes);
        self
    }

    /// The engines with their settings.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if an engine or a route of the scenario is not known, or if a number cannot be a setting;
    /// [`ErrorKind::Unsupported`] for an engine that this build does not have.
    pub fn set_engines(&self, scenario: &Scenario) -> Result<Vec<Box<dyn Engine>>> {
        let step = self.step.or(scenario.dt).unwrap_or_else(|| engines::usual_step(&scenario.case));
        self.engines_at(scenario, step)
    }

    /// The engines of a proof. Settings that neither the options nor the scenario give are free.
    ///
    /// # Errors
    /// Those of [`Options::set_engines`].
    pub fn chosen(&self, scenario: &Scenario) -> Result<Vec<Chosen>> {
        let given = self.step.or(scenario.dt);
        let own = &scenario.engine;
        let free = Free {
            step: given.is_none(),
            sweeps: self.sweeps.or(own.sweeps).is_none(),
            // Extrapolation takes finer steps: a step that is given is kept to.
            extrapolated: given.is_none() && self.extrapolated.or(own.extrapolated).is_none(),
        };
        let is_routed = self.route.is_some() || own.route.is_some();
        // Runs at coarser steps can be extrapolated without a finer step than the one that is given.
        let extrapolated = self.extrapolated.or(own.extrapolated).is_none();
        let own_forces = (!is_routed).then_some(Free { extrapolated, ..free });
        let budget = self.budget.unwrap_or(settle::BUDGET);
        let engines = self.engines_at(scenario, given.unwrap_or_else(|| engines::coarse_step(&scenario.case)))?;
        Ok(engines.into_iter().map(|engine| Chosen { engine, free, own_forces, budget }).collect())
    }

    fn engines_at(&self, scenario: &Scenario, step: f64) -> Result<Vec<Box<dyn Engine>>> {
        let own = &scenario.engine;
        let chosen = match (self.engines.as_slice(), &own.name) {
            ([], None) => vec![EngineName::Rapier.with_step(step)?],
            ([], Some(name)) => vec![named(name, step).map_err(|error| error.key("engine.name"))?],
            (names, _) => names.iter().map(|engine| engine.with_step(step)).collect::<Result<_>>()?,
        };
        let several = chosen.len() > 1;
        chosen.into_iter().map(|engine| self.set(engine, scenario, several)).collect()
    }

    /// An engine with the settings asked for. With `several` engines side by side, an engine that does not know a route
    /// keeps its own.
    fn set(&self, engine: Box<dyn Engine>, scenario: &Scenario, several: bool) -> Result<Box<dyn Engine>> {
        let (own, defaults) = (&scenario.engine, engine.settings());
        let resolution = match engine.controls_error() {
            true => self.accuracy.unwrap_or(defaults.resolution),
            false => defaults.resolution,
        };
        let count = |asked: Option<usize>, own: Option<usize>, default: usize, what: &str| match asked.or(own) {
            Some(0) => Err(Error::new(ErrorKind::Input, format!("found 0 {what}, but an engine needs at least one"))
                .help("give a whole number greater than zero")),
            // An engine that does not iterate does not use sweeps.
            Some(_) if default == 0 => Ok(0),
            Some(number) => Ok(number),
            None => Ok(default),
        };
        let own_route = || own.route.as_deref().map(route_named).transpose();
        let route = match self.route.map_or_else(own_route, |route| Ok(Some(route)))? {
            Some(asked) if engine.routes().contains(&asked) => asked,
            Some(asked) if !several => {
                let offered = engine.routes().iter().map(|route| route.name());
                return Err(unknown(&format!("route of engine {}", engine.name()), asked.name(), offered));
            }
            Some(_) | None => defaults.route,
        };
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

fn route_named(name: &str) -> Result<Route> {
    Route::named(name).ok_or_else(|| unknown("route to reactions", name, Route::ALL.iter().map(|route| route.name())))
}

/// The engine named in a scenario file.
fn named(name: &str, step: f64) -> Result<Box<dyn Engine>> {
    match EngineName::named(name) {
        Some(engine) => engine.with_step(step),
        None => Err(unknown("engine", name, EngineName::ALL.iter().map(|engine| engine.name()))),
    }
}

fn unknown<'a>(what: &str, asked: &str, known: impl Iterator<Item = &'a str>) -> Error {
    let known: Vec<&str> = known.collect();
    Error::new(ErrorKind::Input, format!("there is no {what} called \"{asked}\""))
        .help(format!("choose one of: {}", known.join(", ")))
}
