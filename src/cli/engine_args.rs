//! Arguments that choose engines and their settings, common to several commands.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Arg, ArgMatches, Command, FromArgMatches};

use super::{number, output};
use linkage::case::Case;
use linkage::engine::{Engine, Route};
use linkage::error::Error;
use prover::engines::EngineName;
use prover::run::{Options, Reference, memory};
use scenario::engine::{ROWS, SettingRow, Slot};
use scenario::{EngineSetting, EngineSettings, Scenario, SettingOrigin};

type Result<T, E = Error> = std::result::Result<T, E>;

/// Which engines run.
#[derive(Clone, Copy, Debug)]
pub(super) enum Which {
    /// Every engine of this build.
    All,
    /// This engine.
    One(EngineName),
}

impl Which {
    /// The name that means every engine of this build.
    const ALL: &'static str = "all";

    fn parser() -> impl TypedValueParser<Value = Which> {
        word(engine_names().chain([Which::ALL]), |word| match word {
            Which::ALL => Some(Which::All),
            name => EngineName::named(name).map(Which::One),
        })
    }
}

/// The engines and their settings.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct EngineArgs {
    /// Engine, or `all` to run every engine. May be given several times [default: the scenario's engine, else the
    /// first]
    #[arg(long, value_name = "ENGINE", value_parser = Which::parser())]
    pub(super) engine: Vec<Which>,
    #[command(flatten)]
    settings: SettingArgs,
    /// Work allowed for finding the settings that are not given; the unit is an engine step without sweeps [default:
    /// 2e7, of `tune` 5e6]
    #[arg(long, value_name = "STEPS", allow_hyphen_values = true, value_parser = number::positive)]
    budget: Option<f64>,
    #[command(flatten)]
    pub(super) memory: MemoryArgs,
}

/// Memory that a run may use.
#[derive(Clone, Copy, Debug, clap::Args)]
#[group(skip)]
pub(super) struct MemoryArgs {
    /// Memory allowed in GB for everything that runs at the same time; a run does not begin if it would need more
    #[arg(long, value_name = "GB", default_value = "4", allow_hyphen_values = true, value_parser = number::positive)]
    memory: f64,
}

/// If a run needs more memory than this constant (bytes), the command reports the needed memory in advance.
const TOLD: f64 = 5e8;

impl MemoryArgs {
    /// Memory allowed (bytes).
    pub(super) fn bytes(self) -> f64 {
        self.memory * 1e9
    }

    /// Reports the memory that a run needs, if this memory is large but within the limit.
    pub(super) fn tell(self, case: &Case, needed: f64) {
        if needed >= TOLD && needed <= self.bytes() {
            output::note(&memory::told(case, needed));
        }
    }
}

/// The settings of an engine: one argument for each row of [`ROWS`].
/// If a setting is not given, the scenario's setting applies.
/// If the scenario lacks the setting too, a proof searches for it; a run without a proof takes the engine's default.
#[derive(Clone, Debug)]
pub(super) struct SettingArgs {
    settings: EngineSettings,
    /// The first option that the user gave.
    first: Option<&'static str>,
}

impl clap::Args for SettingArgs {
    fn augment_args(command: Command) -> Command {
        ROWS.iter().filter_map(argument).fold(command, Command::arg)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for SettingArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut own = EngineSettings::default();
        for row in ROWS {
            match (row.slot)(&mut own) {
                Slot::Engines(_) => {}
                Slot::Positive(number) => *number = given(matches, row),
                Slot::Count(number) | Slot::Times(number) => *number = given(matches, row),
                Slot::Route(route) => *route = given(matches, row),
            }
        }
        let first = ROWS.iter().find(|row| argument(row).is_some() && matches.contains_id(row.argument));
        Ok(SettingArgs { settings: own, first: first.map(|row| row.argument) })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The command-line argument for a row of settings.
/// `None` for the row that names the engines, because each command defines that argument separately.
fn argument(row: &'static SettingRow) -> Option<Arg> {
    let own = Arg::new(row.argument).long(row.argument).value_name(row.value).help(row.help);
    Some(match (row.slot)(&mut EngineSettings::default()) {
        Slot::Engines(_) => return None,
        Slot::Positive(_) => own.value_parser(number::positive).allow_hyphen_values(true),
        Slot::Count(_) => own.value_parser(number::count).allow_hyphen_values(true),
        Slot::Route(_) => own.value_parser(word(Route::ALL.map(Route::name), Route::named)),
        Slot::Times(_) => {
            own.value_parser(number::times).num_args(0..=1).default_missing_value("1").require_equals(true)
        }
    })
}

fn given<T: Clone + Send + Sync + 'static>(matches: &ArgMatches, row: &SettingRow) -> EngineSetting<T> {
    let value = matches.get_one::<T>(row.argument).cloned();
    value.map_or(EngineSetting::Free, |value| EngineSetting::Given(value, SettingOrigin::Argument(row.argument)))
}

/// A parser that accepts only these words and converts each to its value.
pub(super) fn word<T: Clone + Send + Sync + 'static>(
    words: impl IntoIterator<Item = &'static str>,
    named: impl Fn(&str) -> Option<T> + Clone + Send + Sync + 'static,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(words).map(move |word| named(&word).expect("the parser knows all words"))
}

impl EngineArgs {
    /// The options of a proof that result from these arguments.
    pub(super) fn options(&self, reference: Reference) -> Options {
        let mut options = Options::default().reference(reference);
        options.settings = self.settings.settings.clone();
        for which in &self.engine {
            options = match which {
                Which::All => options.every_engine(),
                Which::One(engine) => options.engine(*engine),
            };
        }
        options.budget = self.budget;
        options.memory = Some(self.memory.bytes());
        options
    }
}

impl SettingArgs {
    /// An engine with these settings; missing settings come from the scenario, or else from the engine's defaults.
    ///
    /// # Errors
    /// An error is returned if the engine does not support one of the settings.
    pub(super) fn engine(&self, engine: EngineName, scenario: &Scenario) -> Result<Box<dyn Engine>> {
        let options = Options { settings: self.settings.clone(), ..Options::default() };
        Ok(options.engine(engine).set_engines(scenario)?.remove(0))
    }

    /// The first of these options that the user gave; analytic solvers accept none of these options.
    pub(super) fn given(&self) -> Option<String> {
        self.first.map(|name| format!("--{name}"))
    }
}

/// Names of all engines. If the user chooses an engine that this build lacks, the error names the feature needed.
pub(super) fn engine_names() -> impl Iterator<Item = &'static str> {
    EngineName::ALL.into_iter().map(EngineName::name)
}

/// Parses the name of an analytic side.
pub(super) fn side() -> impl TypedValueParser<Value = Reference> {
    word(Reference::ALL.map(Reference::name), Reference::named)
}
