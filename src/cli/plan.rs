//! `linkproof plan`.

use crate::sentences;
use std::path::PathBuf;

use super::advice;
use super::engine_args::side;
use super::instant::InstantArgs;
use super::load::plain;
use super::outputs::{Made, Outputs, results};
use crate::report::plan as report;
use analytic::range::explained;
use design::draw;
use design::plan::{PlanScale, Plans, SingularPoint, state_at};
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
    /// Scale of a drawing: 1:2 or mu_l=0.001 (m/mm); mu_v=0.02 ((m/s)/mm); mu_a=5 ((m/s²)/mm); the length on paper of
    /// a vector or a side (pa=100mm, v_B=60mm, OA=50mm); or crank (mu_v = omega mu_l, mu_a = omega² mu_l). May be
    /// given several times
    #[arg(long, value_name = "SCALE", allow_hyphen_values = true, value_parser = PlanScale::read)]
    scale: Vec<PlanScale>,
    /// Turn the velocity plan by 90 deg, against the rotation of the driving link
    #[arg(long)]
    turned: bool,
    /// Show the instant centres of all pairs of links, and the acceleration centres
    #[arg(long)]
    centres: bool,
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
/// The limit is needed because the number of relative vectors grows with the square of the number of points of a link.
const POINTS: usize = 100;
/// Largest number of links for which instant centres are shown: the number of centres grows with the square of this
/// number.
const LINKS: usize = 40;

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
    let mut plans = Plans::of(case, solver, &state, when.grid(crank).inputs[0]);
    if args.centres {
        let links = case.mechanism.links().len();
        if links > LINKS {
            let message = sentences::has_links_and_centres_are_shown_for(&scenario.name, &links, &LINKS);
            return Err(Error::new(ErrorKind::Input, message).help(sentences::LEAVE_OUT_CENTRES));
        }
        plans = plans.with_centres(case, &state);
    }
    if !args.only.is_empty() {
        plans = plans.only(&args.only).map_err(|error| error.key("--only"))?;
    }
    plans = plans.scaled(case, &state, &args.scale).map_err(|error| error.key("--scale"))?;
    if args.turned {
        plans = plans.turned();
    }
    let singular = SingularPoint::all(case, &state.motions);
    let result = |form| -> Result<Made> {
        Ok(match form {
            PlanResults::Svg => draw::plans(&plans, &scenario.name, &scenario.title).into(),
            PlanResults::Json => report::json(&scenario, &plans, &singular, advice::told).into(),
        })
    };
    args.outputs.deliver(result, |width| report::text(&scenario, is_free, &plans, &singular, advice::told, width))
}
