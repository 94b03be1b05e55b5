//! `linkproof plan`.

use crate::sentences;
use std::path::PathBuf;

use super::advice;
use super::engine_args::side;
use super::instant::InstantArgs;
use super::load::plain;
use super::outputs::{Outputs, results};
use crate::report::plan as report;
use analytic::range::explained;
use design::draw;
use design::plan::{Plans, SingularPoint, state_at};
use linkage::case::When;
use linkage::error::{Error, ErrorKind, Result};
use prover::run::Reference;

#[derive(Debug, clap::Args)]
#[command(after_help = include_str!("help/plan.txt").trim_ascii_end())]
pub(super) struct Args {
    /// Scenario file; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    instant: InstantArgs,
    /// Show only the vectors of this point, or of this link with its points; may be given several times
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    only: Vec<String>,
    /// Analytic solver
    #[arg(long, value_name = "SOLVER", default_value = "assur", value_parser = side())]
    with: Reference,
    #[command(flatten)]
    outputs: Outputs<PlanResults>,
}

results! { PlanResults {
    Json = "all vectors",
    Svg = "kinematic diagram and both plans, to scale",
} }

/// Largest number of points of a link.
/// The limit is needed because the number of relative vectors grows with the square of the number of points.
const POINTS: usize = 100;

pub(super) fn plan(args: &Args) -> Result<()> {
    let scenario = plain(&args.file)?;
    let is_free = scenario.case.is_free();
    let scenario = scenario.nominal();
    let case = &scenario.case;
    if let Some(link) = case.mechanism.links().iter().find(|link| link.points.len() > POINTS) {
        let (name, count) = (&link.name, link.points.len());
        let message = sentences::has_points_and_a_plan_has_a_vector(&name, &count, &POINTS);
        return Err(Error::new(ErrorKind::Input, message).help(sentences::LEAVE_OUT_POINTS_THAT_THE_PLAN));
    }
    let crank = case.crank();
    let when = args.instant.of(crank.input).unwrap_or(When::Crank(crank.start));
    let solver = args.with.solver();
    let state = state_at(case, solver, when).map_err(|error| args.instant.blamed(explained(case, error)))?;
    let plans = Plans::of(case, solver, &state, when.grid(crank).inputs[0]);
    let plans =
        if args.only.is_empty() { plans } else { plans.only(&args.only).map_err(|error| error.key("--only"))? };
    let singular: Vec<Result<SingularPoint>> = case
        .structure
        .groups
        .iter()
        .filter_map(|group| SingularPoint::of(case, group, &state.motions).transpose())
        .collect();
    let result = |form| {
        Ok(match form {
            PlanResults::Svg => draw::plans(&plans, &scenario.name, &scenario.title),
            PlanResults::Json => report::json(&scenario, &plans, &singular, advice::told),
        })
    };
    args.outputs.deliver(result, |width| report::text(&scenario, is_free, &plans, &singular, advice::told, width))
}
