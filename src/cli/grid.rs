//! Grids on the command line.

use crate::sentences;
use std::str::FromStr;

use linkage::case::{Case, Grid};
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use scenario::Scenario;
use scenario::grid::{listed, range};

/// The instants of a command, which replace the scenario's grid.
#[derive(Clone, Debug, Default, clap::Args)]
#[group(skip)]
pub(super) struct GridArgs {
    /// Crank angles (deg), or slides (mm), measured as in the scenario, instead of its grid: ranges and single values,
    /// separated by commas
    #[arg(long, value_name = "FROM:TO:STEP", allow_hyphen_values = true, conflicts_with = "times")]
    crank_deg: Option<Values>,
    /// Times in seconds, instead of the scenario's grid: ranges and single values, separated by commas
    #[arg(long, value_name = "FROM:TO:STEP", allow_hyphen_values = true)]
    times: Option<Values>,
}

impl GridArgs {
    /// The scenario on the grid of the arguments, or on the grid of its file if the arguments give no grid.
    pub(super) fn on(&self, scenario: Scenario) -> Result<Scenario> {
        let case = self.case(&scenario.case)?;
        Ok(Scenario { case, ..scenario })
    }

    fn case(&self, case: &Case) -> Result<Case> {
        let crank = case.crank();
        let (grid, help) = match (&self.crank_deg, &self.times) {
            (Some(Values { values, .. }), _) => {
                let cranks = values.iter().map(|value| crank.input.read(*value)).collect();
                let help = match crank.is_free() {
                    true => sentences::GIVE_TIMES_BY_TIMES_FROM_TO_STEP,
                    false => sentences::CHECK_THE_UNIT_AND_SIZE_OF_CRANK,
                };
                (Grid::of_inputs(crank, cranks), help)
            }
            (None, Some(Values { values, .. })) => {
                (Grid::of_times(crank, values.clone()), sentences::CHECK_THE_UNIT_AND_SIZE_OF_TIMES)
            }
            (None, None) => return Ok(case.clone()),
        };
        grid.check(&case.drives).map_err(|message| Error::new(ErrorKind::Input, message).help(help))?;
        case.on(grid)
    }

    /// Whether a given grid consists of inputs and not of times; `None` if no grid is given.
    pub(super) fn is_by_input(&self) -> Option<bool> {
        self.is_given().then_some(self.crank_deg.is_some())
    }

    /// Whether a grid is given.
    pub(super) fn is_given(&self) -> bool {
        self.crank_deg.is_some() || self.times.is_some()
    }

    /// Name (with unit) and text of the values that the arguments give; `input` is the input of the first drive.
    /// `None` if the arguments give no grid.
    pub(super) fn told(&self, input: Input) -> Option<(&'static str, &str)> {
        match &self.crank_deg {
            Some(values) => Some((input.shown_in().1, &values.text)),
            None => self.times.as_ref().map(|values| ("times_s", values.text.as_str())),
        }
    }
}

/// Values and ranges `FROM:TO:STEP` with both ends included, separated by commas.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Values {
    text: String,
    values: Vec<f64>,
}

const EXPECTED: &str = sentences::EXPECTED_FROM_TO_STEP_OR_VALUES;

impl FromStr for Values {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let number = |part: &str| match part.trim().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(_) => Err(sentences::is_not_finite(&part, &EXPECTED)),
            Err(_) => Err(sentences::is_not_a_number(&part, &EXPECTED)),
        };
        let mut values = Vec::new();
        for item in text.split(',') {
            let parts: Vec<&str> = item.split(':').collect();
            match parts.as_slice() {
                [value] => values.extend(range(number(value)?, number(value)?, 1.0)?),
                [from, to, step] => values.extend(range(number(from)?, number(to)?, number(step)?)?),
                _ => return Err(format!("found \"{item}\", {EXPECTED}")),
            }
        }
        Ok(Values { text: text.into(), values: listed(values)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> std::result::Result<Vec<f64>, String> {
        text.parse().map(|found: Values| found.values)
    }

    #[test]
    fn ranges_include_both_ends() {
        assert_eq!(values("0:-90:-30"), Ok(vec![0.0, -30.0, -60.0, -90.0]));
    }

    #[test]
    fn values_and_ranges_may_be_listed() {
        assert_eq!(values("0, 0.1,0.3"), Ok(vec![0.0, 0.1, 0.3]));
        assert_eq!(values("-70"), Ok(vec![-70.0]));
        assert_eq!(values("0:20:10,45,90"), Ok(vec![0.0, 10.0, 20.0, 45.0, 90.0]));
    }

    #[test]
    fn bad_ranges_are_refused_with_a_message() {
        for text in ["0:360", "a:1:2", "0:360:0", "0:360:-1", "0:1:nan", "0:1e99:1e-9", "", "0,,1", "inf", "0:10:5,5"] {
            let message = values(text).unwrap_err();
            assert!(!message.is_empty(), "{text}");
        }
    }
}
