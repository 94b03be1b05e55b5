//! The instant of a picture or a plan on the command line.

use linkage::case::When;
use linkage::error::Error;
use linkage::input::Input;

use super::number;

#[derive(Clone, Copy, Debug, Default, clap::Args)]
#[group(skip)]
pub(super) struct InstantArgs {
    /// Crank angle (deg), or slide (mm), measured as in the scenario [default: its value at the start]
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = number::finite)]
    #[arg(alias = "at-crank-deg", conflicts_with = "time")]
    crank_deg: Option<f64>,
    /// Time (s), instead of a crank angle: for drives that reach an angle more than once
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = number::finite)]
    time: Option<f64>,
}

impl InstantArgs {
    /// The instant of a scenario with this input; `None` if the arguments give no instant.
    pub(super) fn of(&self, input: Input) -> Option<When> {
        self.time.map(When::Time).or_else(|| self.crank_deg.map(|value| When::Crank(input.read(value))))
    }

    /// Adds to an error the option that gives the instant; without such an option, the error is unchanged.
    pub(super) fn blamed(&self, error: Error) -> Error {
        match self.told() {
            (option, true) => error.key(option),
            (_, false) => error,
        }
    }

    /// The option that states the instant, and whether the user gave this option.
    pub(super) fn told(&self) -> (&'static str, bool) {
        match self.time {
            Some(_) => ("--time", true),
            None => ("--crank-deg", self.crank_deg.is_some()),
        }
    }
}
