//! Arguments that choose engines and their settings, common to several commands.

use clap::builder::PossibleValuesParser;

use crate::proof::Options;
use linkage::engine::Route;

/// Which engines, and how they are set.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct EngineArgs {
    /// Engine, or `all` to run every one side by side. May be given several times [default: the scenario's, else the first]
    #[arg(long, value_name = "ENGINE", value_parser = PossibleValuesParser::new(names_and_all()))]
    pub(super) engine: Vec<String>,
    /// Time step of the engine in seconds [default: the scenario's]
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(super) dt: Option<f64>,
    /// Relative accuracy of an engine that chooses its own steps [default: its tightest]
    #[arg(long, value_name = "ACCURACY", allow_hyphen_values = true)]
    accuracy: Option<f64>,
    /// Sweeps of the engine's iteration in a step [default: the scenario's, else the engine's]
    #[arg(long, value_name = "N")]
    sweeps: Option<usize>,
    /// Parts that the engine itself divides a step into
    #[arg(long, value_name = "N")]
    substeps: Option<usize>,
    /// The way to reactions and balancing moment
    #[arg(long, value_name = "ROUTE", value_parser = PossibleValuesParser::new(Route::ALL.map(Route::name)))]
    route: Option<String>,
    /// Combine the runs at the step and at half of it, so that the leading error drops out
    #[arg(long)]
    extrapolate: bool,
}

impl EngineArgs {
    /// The options of a proof with these arguments.
    pub(super) fn options(&self, reference: &str) -> Options {
        Options {
            reference: reference.into(),
            engines: self.engine.clone(),
            step: self.dt,
            accuracy: self.accuracy,
            sweeps: self.sweeps,
            substeps: self.substeps,
            route: self.route.clone(),
            extrapolated: self.extrapolate.then_some(true),
        }
    }
}

pub(super) fn engine_names() -> Vec<&'static str> {
    crate::engines::all(1.0).iter().map(|engine| engine.name()).collect()
}

fn names_and_all() -> Vec<&'static str> {
    [engine_names(), vec!["all"]].concat()
}
