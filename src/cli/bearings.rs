//! `linkproof bearings`.

use crate::sentences;
use std::path::PathBuf;

use super::load::nominal;
use super::number;
use super::outputs::{Outputs, results};
use crate::report::bearings::{self as report, Journals};
use analytic::range::explained;
use design::bearings;
use linkage::error::{Error, ErrorKind, Result};

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/bearings.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Lever arm of the reaction, in mm
    #[arg(long, value_name = "MM", default_value = "10", allow_hyphen_values = true, value_parser = number::finite)]
    lever_mm: f64,
    /// Bending stress that the journals may carry, in MPa
    #[arg(long, value_name = "MPA", default_value = "200", allow_hyphen_values = true, value_parser = number::finite)]
    stress_mpa: f64,
    #[command(flatten)]
    outputs: Outputs<BearingResults>,
}

results! { BearingResults {
    Json = "reactions and journals",
} }

pub(super) fn bearings(args: &Args) -> Result<()> {
    for (name, value) in [("--lever-mm", args.lever_mm), ("--stress-mpa", args.stress_mpa)] {
        if !(value > 0.0 && value.is_finite()) {
            let error = Error::new(ErrorKind::Input, format!("{name} is {value}"));
            return Err(error.help(sentences::GIVE_A_NUMBER_ABOVE_ZERO));
        }
    }
    let scenario = nominal(&args.file, sentences::BEARINGS_OF_A_FREE_MOTION)?;
    let peaks = bearings::over_range(&scenario.case).map_err(|error| explained(&scenario.case, error))?;
    let journals = Journals { lever_mm: args.lever_mm, stress_mpa: args.stress_mpa };
    let json = |_| Ok(report::json(journals, &scenario, &peaks));
    args.outputs.deliver(json, |width| report::text(journals, &scenario, &peaks, width))
}
