//! Arguments that choose engines and their settings, common to several commands.

use clap::builder::PossibleValuesParser;

use super::{number, output};
use linkage::case::Case;
use linkage::engine::{Engine, Route};
use linkage::error::Result;
use prover::engines::EngineName;
use prover::proof::{Options, Reference, memory};
use scenario::Scenario;

/// Stands for every engine of this build, in place of a name.
const ALL: &str = "all";

/// Why a name that came through the parser is found: nothing is dropped in silence.
const KNOWN: &str = "the argument parser knows all names";

/// The engines and their settings.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct EngineArgs {
    /// Engine, or `all` to run every one side by side. May be given several times [default: the scenario's, else the
    /// first]
    #[arg(long, value_name = "ENGINE", value_parser = PossibleValuesParser::new(names_and_all()))]
    pub(super) engine: Vec<String>,
    #[command(flatten)]
    settings: SettingArgs,
    /// Work allowed for finding the settings that are not given, in steps without sweeps [default: 2e7, of `tune` 5e6]
    #[arg(long, value_name = "STEPS", allow_hyphen_values = true, value_parser = number::positive)]
    budget: Option<f64>,
    #[command(flatten)]
    pub(super) memory: MemoryArgs,
}

/// Memory that a run may take.
#[derive(Clone, Copy, Debug, clap::Args)]
#[group(skip)]
pub(super) struct MemoryArgs {
    /// Memory allowed in GB, for everything that runs at a time; a run that is estimated to need more does not begin
    #[arg(long, value_name = "GB", default_value = "4", allow_hyphen_values = true, value_parser = number::positive)]
    memory: f64,
}

/// Memory (bytes) from which a run tells what it needs before it begins.
const TOLD: f64 = 5e8;

impl MemoryArgs {
    /// Memory allowed (bytes).
    pub(super) fn bytes(self) -> f64 {
        self.memory * 1e9
    }

    /// Tells what a run needs, if that is much and allowed.
    pub(super) fn tell(self, case: &Case, needed: f64) {
        if needed >= TOLD && needed <= self.bytes() {
            output::note(&memory::told(case, needed));
        }
    }
}

/// The settings of an engine. What is not given is the scenario's, else found by the proof or the engine's own.
#[derive(Clone, Debug, clap::Args)]
#[group(skip)]
pub(super) struct SettingArgs {
    /// Time step of the engine in seconds [default: the scenario's, else `run` finds it, and others take a quarter of a
    /// degree of the crank or less]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = number::positive)]
    dt: Option<f64>,
    /// Relative accuracy of an engine that chooses its own steps [default: its tightest]
    #[arg(long, value_name = "ACCURACY", allow_hyphen_values = true, value_parser = number::positive)]
    accuracy: Option<f64>,
    /// Sweeps of the engine's iteration in a step [default: the scenario's, else `run` finds them, and others take the
    /// engine's]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = number::count)]
    sweeps: Option<usize>,
    /// Number of substeps into which the engine divides a step
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = number::count)]
    substeps: Option<usize>,
    /// Route by which reactions and balancing moment are computed
    #[arg(long, value_name = "ROUTE", value_parser = PossibleValuesParser::new(Route::ALL.map(Route::name)))]
    route: Option<String>,
    /// Combine runs at the step and at halves of it, so that the leading errors cancel: once if no number is given
    /// [default: the scenario's, else `run` finds it unless the step is given, and others do not extrapolate]
    #[arg(long, value_name = "TIMES", num_args = 0..=1, default_missing_value = "1", require_equals = true)]
    extrapolate: Option<usize>,
}

impl EngineArgs {
    /// The options of a proof with these arguments.
    pub(super) fn options(&self, reference: &str) -> Options {
        let mut options = Options::default().reference(Reference::named(reference).expect(KNOWN));
        options.engines =
            self.engine.iter().filter(|name| *name != ALL).map(|name| EngineName::named(name).expect(KNOWN)).collect();
        if self.engine.iter().any(|name| name == ALL) {
            options = options.every_engine();
        }
        self.settings.set(&mut options);
        options.budget = self.budget;
        options.memory = Some(self.memory.bytes());
        options
    }
}

impl SettingArgs {
    /// Writes the settings given to the options of a proof.
    fn set(&self, options: &mut Options) {
        options.step = self.dt;
        options.accuracy = self.accuracy;
        options.sweeps = self.sweeps;
        options.substeps = self.substeps;
        options.route = self.route.as_deref().map(|name| Route::named(name).expect(KNOWN));
        options.extrapolated = self.extrapolate;
    }

    /// The engine called `name` with these settings, else the scenario's, else its own.
    ///
    /// # Errors
    /// Those of settings that an engine cannot have.
    pub(super) fn engine(&self, name: &str, scenario: &Scenario) -> Result<Box<dyn Engine>> {
        let mut options = Options::default().engine(EngineName::named(name).expect(KNOWN));
        self.set(&mut options);
        Ok(options.set_engines(scenario)?.remove(0))
    }

    /// The first option given. An analytic solver has none of them.
    pub(super) fn given(&self) -> Option<&'static str> {
        let SettingArgs { dt, accuracy, sweeps, substeps, route, extrapolate } = self;
        let options = [
            ("--dt", dt.is_some()),
            ("--accuracy", accuracy.is_some()),
            ("--sweeps", sweeps.is_some()),
            ("--substeps", substeps.is_some()),
            ("--route", route.is_some()),
            ("--extrapolate", extrapolate.is_some()),
        ];
        options.into_iter().find_map(|(option, is_given)| is_given.then_some(option))
    }
}

/// Names of all engines. An engine that this build lacks reports the feature it needs.
pub(super) fn engine_names() -> Vec<&'static str> {
    EngineName::ALL.map(EngineName::name).to_vec()
}

fn names_and_all() -> Vec<&'static str> {
    [engine_names(), vec![ALL]].concat()
}
