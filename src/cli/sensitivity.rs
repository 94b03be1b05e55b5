//! `linkproof sensitivity`.

use crate::sentences;
use std::path::PathBuf;

use super::grid::GridArgs;
use super::load::{StartArgs, each_once, setting};
use super::output;
use super::outputs::{Made, Outputs, results};
use crate::report::sensitivity as report;
use crate::report::table_csv;
use analytic::range::explained;
use design::draw;
use design::sensitivity::{KeyTolerance, SensitivityQuestion, sensitivity as solved, stacks};
use linkage::error::{Error, ErrorKind, Result};
use scenario::StartRequest;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/sensitivity.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Figure: max, min, maxabs, range, mean, rms or at=DEG of a channel or of an expression of channels, such as
    /// `max:joint.A.f_N`. Extremes are taken over the instants of the grid. May be given several times
    #[arg(long, required = true, value_name = "FIGURE")]
    figure: Vec<String>,
    /// Number of the file by which to differentiate: a parameter, or a path such as links.crank.mass_kg. May be given
    /// several times [default: the parameters that the mechanism uses; if there are none, its dimensions, masses, and
    /// numbers of laws and loads]
    #[arg(long, value_name = "KEY")]
    by: Vec<String>,
    /// Tolerance of a number of the file, in the unit of its key: the largest deviation in either sense. May be given
    /// several times
    #[arg(long, value_name = "KEY=NUMBER", value_parser = setting)]
    tolerance: Vec<(String, f64)>,
    /// Number of random mechanisms within the tolerances
    #[arg(long, value_name = "N", default_value_t = 300, value_parser = clap::value_parser!(u32).range(10..=100_000))]
    samples: u32,
    /// Seed of the random mechanisms
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// Number of keys in the table of the report; files contain all keys
    #[arg(long, value_name = "N", default_value_t = 10)]
    most: usize,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    start: StartArgs,
    #[command(flatten)]
    outputs: Outputs<SensitivityResults>,
}

results! { SensitivityResults {
    Svg = "tornado diagrams",
    Csv = "all derivatives",
    Json = "derivatives and tolerance stacks",
} }

pub(super) fn sensitivity(args: &Args) -> Result<()> {
    if let Some((key, limit)) = args.tolerance.iter().find(|(_, limit)| !(*limit > 0.0)) {
        let message = sentences::the_tolerance_is_not_above_zero(&key, &limit);
        return Err(Error::new(ErrorKind::Input, message).key("--tolerance").help(sentences::GIVE_A_NUMBER_ABOVE_ZERO));
    }
    each_once(&args.tolerance, "--tolerance")?;
    let tolerances: Vec<KeyTolerance> =
        args.tolerance.iter().map(|(key, limit)| KeyTolerance { key: key.clone(), limit: *limit }).collect();
    let scenario = args.start.load(&args.file, &args.grid)?;
    let question = SensitivityQuestion {
        figures: args.figure.iter().map(|text| text.parse()).collect::<Result<_>>()?,
        keys: args.by.clone(),
        also: tolerances.iter().map(|own| own.key.clone()).collect(),
        asked: args.start.request(&args.grid, StartRequest::default()),
        by_input: args.grid.is_by_input(),
    };
    let found = solved(&scenario, &question).map_err(|error| explained(&scenario.case, error))?;
    let sampled = match tolerances.is_empty() {
        true => Vec::new(),
        false => stacks(&scenario, &question, &found, &tolerances, (args.samples as usize, args.seed))?,
    };
    for (key, part) in &found.left_out {
        output::note(&sentences::is_left_out_because(&key, &part));
    }
    let all = report::Sensitivities {
        scenario: &scenario,
        found: &found,
        tolerances: &tolerances,
        stacks: &sampled,
        samples: args.samples,
        seed: args.seed,
    };
    let make = |own| -> Result<Made> {
        Ok(match own {
            SensitivityResults::Svg => draw::tornado(&found, &tolerances, &scenario.title).into(),
            SensitivityResults::Csv => table_csv::as_csv(report::rows(&all))?.into(),
            SensitivityResults::Json => report::json(&all).into(),
        })
    };
    args.outputs.deliver(make, |width| report::text(&all, args.most, width))
}
