//! `linkproof diagram`.

use std::path::PathBuf;

use super::engine_args::side;
use super::load::plain;
use super::number;
use super::outputs::{Outputs, results};
use crate::report::diagram as report;
use analytic::range::explained;
use design::diagram::{MotionCurve, MotionDiagram};
use design::draw;
use linkage::error::Result;
use prover::run::Reference;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/diagram.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Position or angle, named as in `linkproof list --channels`
    #[arg(long, value_name = "NAME")]
    channel: String,
    /// Number of equal divisions of one crank turn, or of the stroke of a slide
    #[arg(long, value_name = "N", default_value_t = 12, allow_hyphen_values = true, value_parser = number::count)]
    divisions: usize,
    /// Analytic solver
    #[arg(long, value_name = "SOLVER", default_value = "assur", value_parser = side())]
    with: Reference,
    #[command(flatten)]
    outputs: Outputs<DiagramResults>,
}

results! { DiagramResults {
    Json = "errors and points",
    Svg = "the three diagrams",
    Csv = "the points",
} }

pub(super) fn diagram(args: &Args) -> Result<()> {
    let scenario = plain(&args.file)?.nominal();
    let solver = args.with.solver();
    let course = MotionCurve::named(&scenario.case, &args.channel)?;
    let diagram = MotionDiagram::of(&scenario.case, solver, &course, args.divisions)
        .map_err(|error| explained(&scenario.case, error))?;
    let result = |form| {
        Ok(match form {
            DiagramResults::Svg => draw::motion(&diagram, &scenario.name),
            DiagramResults::Csv => report::points(&diagram),
            DiagramResults::Json => report::json(&scenario, &diagram),
        })
    };
    args.outputs.deliver(result, |_| report::text(&scenario, &diagram))
}
