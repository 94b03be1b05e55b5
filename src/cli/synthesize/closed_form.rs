//! `linkproof synthesize crank-rocker` and `slider-crank`.

use crate::sentences;
use std::f64::consts::TAU;
use std::path::Path;

use super::proven::proven;
use crate::cli::number;
use crate::cli::outputs::{Outputs, results};
use crate::report::closed_form::{self as report, Told};
use design::synthesize::DraftContents;
use design::synthesize::crank_rocker::{self, CrankRocker};
use design::synthesize::slider_crank::{Given, SliderCrank};
use linkage::error::Result;
use linkage::math::Vec2;
use scenario::Scenario;

/// Destination of the results, and the scenario's data other than dimensions.
#[derive(Debug, clap::Args)]
struct Target {
    #[command(flatten)]
    outputs: Outputs<ClosedForms>,
    /// Speed of the crank in the scenario, in turns per minute, counter-clockwise positive
    #[arg(long, value_name = "RPM", default_value = "60", allow_hyphen_values = true, value_parser = number::not_zero)]
    rpm: f64,
    /// Mass per metre of the links in the scenario, which are uniform bars
    #[arg(long, value_name = "KG_PER_M", default_value = "1", allow_hyphen_values = true, value_parser = number::positive)]
    bar_kg_per_m: f64,
}

impl Target {
    fn sheet(&self, name: &str, title: &str, comment: String) -> DraftContents {
        let name = named(&self.outputs, name);
        DraftContents { name, title: title.into(), comment, speed: self.rpm * TAU / 60.0, bar: self.bar_kg_per_m }
    }
}

/// The name of a scenario: the name of its file, or `name` if the scenario is not written to a file.
pub(super) fn named(outputs: &Outputs<ClosedForms>, name: &str) -> String {
    let stem = outputs.first(ClosedForms::Scenario).and_then(Path::file_stem);
    stem.map(|stem| stem.to_string_lossy()).filter(|stem| stem != "-").map_or(name.into(), |stem| stem.into())
}

/// Proves a scenario, then writes the results. `tell` makes the report from the verdict.
/// An invalid scenario name is reported before a file is written.
pub(super) fn deliver(outputs: &Outputs<ClosedForms>, scenario: &str, tell: impl FnOnce(&str) -> Told) -> Result<()> {
    outputs.of(ClosedForms::Scenario).try_for_each(|to| Scenario::parse(scenario, to).map(|_| ()))?;
    let told = tell(&proven(scenario, outputs.first(ClosedForms::Scenario).unwrap_or(Path::new("-")))?);
    let result = |form| match form {
        ClosedForms::Scenario => scenario.to_string(),
        ClosedForms::Json => told.json.clone(),
    };
    outputs.deliver(|form| Ok(result(form)), |_| told.text.clone())
}

results! { ClosedForms {
    Scenario = "the scenario",
    Json = "the dimensions",
} }

/// Two numbers separated by a comma.
pub(super) fn pair(text: &str) -> std::result::Result<[f64; 2], String> {
    numbers(text, sentences::TWO_NUMBERS_WITH_A_COMMA)
}

/// `N` numbers separated by commas; `expected` describes them.
pub(super) fn numbers<const N: usize>(text: &str, expected: &str) -> std::result::Result<[f64; N], String> {
    let numbers: Vec<f64> =
        text.split(',').map(|part| number::decimal(part, expected)).collect::<std::result::Result<_, _>>()?;
    <[f64; N]>::try_from(numbers).map_err(|_| format!("expected {expected}"))
}

#[derive(Debug, clap::Args)]
pub(super) struct CrankRockerArgs {
    /// Pivot of the crank
    #[arg(long, value_name = "X,Y", default_value = "0,0", value_parser = pair, allow_hyphen_values = true)]
    crank_pivot_mm: [f64; 2],
    /// Pivot of the rocker
    #[arg(long, value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    pivot_mm: [f64; 2],
    /// Length of the rocker
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = number::positive)]
    rocker_mm: f64,
    /// Angle of the rocker in one extreme position, counter-clockwise from x
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = number::finite)]
    extreme_deg: f64,
    /// Swing: angle from the first extreme position to the other one, counter-clockwise positive
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = number::finite)]
    swing_deg: f64,
    #[command(flatten)]
    target: Target,
}

pub(super) fn crank_rocker(args: &CrankRockerArgs) -> Result<()> {
    let place = |[x, y]: [f64; 2]| Vec2::new(x / 1e3, y / 1e3);
    let wish = crank_rocker::CrankRockerSpec {
        crank_pivot: place(args.crank_pivot_mm),
        rocker_pivot: place(args.pivot_mm),
        rocker: args.rocker_mm / 1e3,
        extreme: args.extreme_deg.to_radians(),
        swing: args.swing_deg.to_radians(),
    };
    let found = CrankRocker::of(wish)?;
    let comment = sentences::linkproof_synthesize_crank_rocker_crank(
        &args.crank_pivot_mm[0],
        &args.crank_pivot_mm[1],
        &args.pivot_mm[0],
        &args.pivot_mm[1],
        &args.rocker_mm,
        &args.extreme_deg,
        &args.swing_deg,
    );
    let sheet = args.target.sheet("crank_rocker_found", sentences::CRANK_ROCKER_FROM_TWO_EXTREME, comment);
    deliver(&args.target.outputs, &found.scenario(&sheet), |proof| report::crank_rocker(&found, wish.rocker, proof))
}

#[derive(Debug, clap::Args)]
#[command(group = clap::ArgGroup::new("given").required(true).args(["rod_mm", "time_ratio"]))]
pub(super) struct SliderCrankArgs {
    /// Stroke of the slider
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = number::positive)]
    stroke_mm: f64,
    /// Distance of the slider's line from the crank's pivot
    #[arg(long, value_name = "MM", default_value = "0", allow_hyphen_values = true, value_parser = number::finite)]
    offset_mm: f64,
    /// Length of the rod
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = number::positive)]
    rod_mm: Option<f64>,
    /// Time ratio: duration of the slower stroke divided by the duration of the faster stroke
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = number::finite)]
    time_ratio: Option<f64>,
    #[command(flatten)]
    target: Target,
}

pub(super) fn slider_crank(args: &SliderCrankArgs) -> Result<()> {
    let (given, told) = match (args.rod_mm, args.time_ratio) {
        (Some(rod), _) => (Given::Rod(rod / 1e3), format!("--rod-mm {rod}")),
        (None, Some(ratio)) => (Given::TimeRatio(ratio), format!("--time-ratio {ratio}")),
        (None, None) => unreachable!("the parser asks for one of the two"),
    };
    let found = SliderCrank::of(args.stroke_mm / 1e3, args.offset_mm / 1e3, given)?;
    let comment = sentences::linkproof_synthesize_slider_crank_stroke(&args.stroke_mm, &args.offset_mm, &told);
    let sheet = args.target.sheet("slider_crank_found", sentences::SLIDER_CRANK_FROM_STROKE_AND_OFFSET, comment);
    deliver(&args.target.outputs, &found.scenario(&sheet), |proof| report::slider_crank(&found, proof))
}
