//! The common first step of every command: a scenario from a file, and names to choose from.

use std::path::Path;

use super::grid::GridArgs;
use super::number;
use crate::scenario::{Asked, Scenario};
use linkage::error::{Error, ErrorKind, Result};

/// Another start than that of the file.
#[derive(Clone, Debug, clap::Args)]
#[group(skip)]
pub(super) struct StartArgs {
    /// Start a group in another assembly mode than the file states, or in the configuration with that number in
    /// `inspect --modes`; published numbers belong to the file's own modes and are then left out. May be given for
    /// several groups
    #[arg(long, value_name = "LINK,LINK=MODE")]
    pub(super) mode: Vec<String>,
    /// Crank angle at t = 0 in degrees, measured as in the scenario, instead of the `crank` of its `[start]`; published
    /// numbers stay if the start lies on the file's own branch
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = number::finite)]
    pub(super) start_crank_deg: Option<f64>,
    /// Number of a parameter, by its key in `[parameters]`; may be given several times
    #[arg(long, value_name = "KEY=NUMBER", value_parser = setting)]
    pub(super) set: Vec<(String, f64)>,
}

impl StartArgs {
    /// Reads a scenario with this start, on the grid given, else on its own.
    pub(super) fn load(&self, file: &Path, grid: &GridArgs) -> Result<Scenario> {
        self.load_and_add(file, grid, false)
    }

    /// The same; parameters that are set and that the file does not have are added, if they may be.
    pub(super) fn load_and_add(&self, file: &Path, grid: &GridArgs, adds_parameters: bool) -> Result<Scenario> {
        let crank = self.start_crank_deg.map(f64::to_radians);
        let asked = Asked {
            modes: self.mode.clone(),
            crank,
            without_grid: grid.told().is_some(),
            set: self.set.clone(),
            adds_parameters,
        };
        grid.on(as_asked(file, &asked)?)
    }
}

/// The scenario with only the channels that `words` ask for; as it is, without words.
pub(super) fn only(scenario: Scenario, words: &[String]) -> Result<Scenario> {
    if words.is_empty() { Ok(scenario) } else { scenario.only(words).map_err(|error| error.key("--only")) }
}

/// Reads `KEY=NUMBER`.
fn setting(text: &str) -> std::result::Result<(String, f64), String> {
    let (key, value) = text.split_once('=').ok_or("expected KEY=NUMBER, such as a_mm=30")?;
    Ok((key.trim().into(), number::decimal(value, "a finite number behind the `=`, such as a_mm=30")?))
}

/// Reads a scenario and starts its groups in the given `modes`.
pub(super) fn load(file: &Path, modes: &[String]) -> Result<Scenario> {
    as_asked(file, &Asked { modes: modes.to_vec(), ..Asked::default() })
}

fn as_asked(file: &Path, asked: &Asked) -> Result<Scenario> {
    Scenario::load_as(file, asked).map_err(|error| of_mode(asked, error))
}

/// An error that has no place in the file is one of the modes asked for.
pub(super) fn of_mode(asked: &Asked, error: Error) -> Error {
    let is_asked = !asked.modes.is_empty() && error.place().is_none() && error.kind() != ErrorKind::Io;
    if is_asked { error.key("--mode") } else { error }
}

/// Names of the analytic solvers, the default first.
pub(super) fn reference_names() -> Vec<&'static str> {
    analytic::all().iter().map(|solver| solver.name()).collect()
}
