//! `linkproof diagram`.

use std::path::PathBuf;

use super::engine_args::side;
use super::load::plain;
use super::{number, output};
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
    /// Number of equal divisions of one crank turn
    #[arg(long, value_name = "N", default_value_t = 12, allow_hyphen_values = true, value_parser = number::count)]
    divisions: usize,
    /// Analytic solver
    #[arg(long, value_name = "SOLVER", default_value = "assur", value_parser = side())]
    with: Reference,
    /// Draw the three diagrams to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target, conflicts_with_all = ["json", "csv"])]
    svg: Option<PathBuf>,
    /// Write errors and points as JSON to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target, conflicts_with = "csv")]
    json: Option<PathBuf>,
    /// Write the points as CSV to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    csv: Option<PathBuf>,
}

pub(super) fn diagram(args: &Args) -> Result<()> {
    let scenario = plain(&args.file)?.nominal();
    let solver = args.with.solver();
    let course = MotionCurve::named(&scenario.case, &args.channel)?;
    let diagram = MotionDiagram::of(&scenario.case, solver, &course, args.divisions)
        .map_err(|error| explained(&scenario.case, error))?;
    if let Some(to) = &args.svg {
        return output::write(&draw::motion(&diagram, &scenario.name), to);
    }
    if let Some(to) = &args.csv {
        return output::write(&report::points(&diagram), to);
    }
    output::either(&args.json, || report::json(&scenario, &diagram), || report::text(&scenario, &diagram))
}
