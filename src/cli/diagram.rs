//! `linkproof diagram`.

use crate::sentences;
use std::path::PathBuf;

use super::engine_args::{side, word};
use super::load::nominal;
use super::number;
use super::outputs::{Made, Outputs, results};
use crate::report::diagram as report;
use analytic::range::explained;
use design::diagram::{Construction, ConstructionSort, MotionCurve, MotionDiagram};
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
    /// Show the construction of a method: pole, rays, scale factors, ordinates or areas
    #[arg(long, value_name = "METHOD")]
    #[arg(value_parser = word(ConstructionSort::ALL.map(ConstructionSort::word), ConstructionSort::named))]
    construction: Option<ConstructionSort>,
    /// Analytic solver
    #[arg(long, value_name = "SOLVER", default_value = "assur", value_parser = side())]
    with: Reference,
    #[command(flatten)]
    outputs: Outputs<DiagramResults>,
}

results! { DiagramResults {
    Json = "errors and points",
    Svg = "the three diagrams, or the construction",
    Csv = "the points",
} }

pub(super) fn diagram(args: &Args) -> Result<()> {
    let scenario = nominal(&args.file, sentences::DIAGRAM_OF_A_FREE_MOTION)?;
    let solver = args.with.solver();
    let course = MotionCurve::named(&scenario.case, &args.channel)?;
    let diagram = MotionDiagram::of(&scenario.case, solver, &course, args.divisions)
        .map_err(|error| explained(&scenario.case, error))?;
    let construction = args.construction.map(|sort| Construction::of(&diagram, sort));
    let construction = construction.as_ref();
    let result = |form| -> Result<Made> {
        Ok(match form {
            DiagramResults::Svg => match construction {
                Some(own) => draw::construction(&diagram, own, &scenario.name).into(),
                None => draw::motion(&diagram, &scenario.name).into(),
            },
            DiagramResults::Csv => report::points(&diagram).into(),
            DiagramResults::Json => report::json(&scenario, &diagram, construction).into(),
        })
    };
    args.outputs.deliver(result, |width| report::text(&scenario, &diagram, construction, width))
}
