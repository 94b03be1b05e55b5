//! `linkproof plan`.

use std::fmt::Write;
use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use serde_json::{Value, json};

use super::load::reference_names;
use super::{advice, output};
use crate::scenario::Scenario;
use analytic::range::explained;
use linkage::case::Case;
use linkage::error::Result;
use workshop::diagram::draw::{self, significant};
use workshop::diagram::plan::state_at;
use workshop::diagram::{Plan, Plans, SingularPoint};

const EXAMPLES: &str = "\
Examples:
  linkproof plan scenarios/crank_rocker.toml --crank-deg 70
  linkproof plan scenarios/fourth_class.toml --svg plans.svg      drawn to scale, at the start
  linkproof plan scenarios/ov7_base.toml --crank-deg -120 --with newton --json -

Letters: a, b, ... are the points A, B, ..., s2 the mass centre of link 2, n1, n2, ... ends of normal parts; a3 is the point of
link 3 under A, which slides on it, k1, k2, ... ends of Coriolis parts; points of the ground lie in the pole (p of velocities, π of accelerations).";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Scenario file
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Crank angle in degrees, as the scenario states it [default: that of the start]
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    crank_deg: Option<f64>,
    /// Analytic solver
    #[arg(long, value_name = "SOLVER", default_value = "assur", value_parser = PossibleValuesParser::new(reference_names()))]
    with: String,
    /// Draw kinematic diagram, velocity and acceleration plan to a file, or to standard output instead of the text with
    /// `-`
    #[arg(long, value_name = "FILE", value_parser = output::target, conflicts_with = "json")]
    svg: Option<PathBuf>,
    /// Write the plans as JSON to a file, or to standard output instead of the text with `-`
    #[arg(long, value_name = "FILE", value_parser = output::target)]
    json: Option<PathBuf>,
}

pub(super) fn plan(args: &Args) -> Result<()> {
    let scenario = Scenario::load(&args.file)?.nominal();
    let case = &scenario.case;
    let crank = args.crank_deg.map_or(case.crank().start, f64::to_radians);
    let solver = analytic::named(&args.with).expect("the argument parser knows all names");
    let state = state_at(case, solver, crank).map_err(|error| explained(case, error))?;
    let plans = Plans::of(case, solver, &state, crank);
    let singular: Vec<Result<SingularPoint>> = case
        .structure
        .groups
        .iter()
        .filter_map(|group| SingularPoint::of(case, group, &state.motions).transpose())
        .collect();
    if let Some(to) = &args.svg {
        return output::write(&draw::plans(&plans, &scenario.name, &scenario.title), to);
    }
    match &args.json {
        Some(to) => {
            let value = as_json(&scenario, &plans, &singular);
            let text = serde_json::to_string_pretty(&value).expect("plain values are always JSON");
            output::write(&format!("{text}\n"), to)
        }
        None => output::print(&as_text(&scenario, &plans, &singular)),
    }
}

fn as_text(scenario: &Scenario, plans: &Plans, singular: &[Result<SingularPoint>]) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "{} at crank angle {:.4} deg", scenario.name, plans.crank.to_degrees());
    let _ = writeln!(text, "kinematic diagram   mu_l = {} m/mm", plans.scheme.scale);
    for link in &plans.scheme.links {
        let (omega, alpha) = (significant(link.omega), significant(link.alpha));
        let _ =
            writeln!(text, "  {} {:14} omega {omega:>10} rad/s   alpha {alpha:>10} rad/s^2", link.number, link.name);
    }
    for plan in [&plans.velocity, &plans.acceleration] {
        let (word, symbol, unit) = (plan.quantity.word(), plan.quantity.symbol(), plan.quantity.unit());
        let _ =
            writeln!(text, "\n{word} plan   pole {}, mu_{symbol} = {} ({unit})/mm", plan.quantity.pole(), plan.scale);
        let _ = writeln!(
            text,
            "  {:10} {:10} {:>10} {:>11} {:>11} {:>8}  meaning",
            "vector",
            "from, to",
            unit,
            format!("x, {unit}"),
            format!("y, {unit}"),
            "mm"
        );
        for vector in &plan.vectors {
            let _ = writeln!(
                text,
                "  {:10} {:10} {:>10} {:>11} {:>11} {:>8.2}  {}",
                vector.name,
                format!("{}, {}", vector.from, vector.to),
                significant(vector.value.norm()),
                significant(vector.value.x),
                significant(vector.value.y),
                plan.paper(vector),
                vector.meaning
            );
        }
    }
    for found in singular {
        let _ = match found {
            Ok(point) => singular_text(&mut text, &scenario.case, point),
            Err(error) => writeln!(text, "\nsingular point: {}", error.line_by(advice::told)),
        };
    }
    text
}

fn singular_text(text: &mut String, case: &Case, point: &SingularPoint) -> std::fmt::Result {
    let shown = |v: linkage::math::Vec2| format!("({}, {})", significant(v.x), significant(v.y));
    writeln!(text, "\nsingular point of the class IV group   S = {} at {} m", point.lines(), shown(point.at))?;
    writeln!(text, "  v_S {} m/s on both base links", shown(point.velocity))?;
    let [first, second] = point.accelerations;
    writeln!(text, "  a_S {} m/s^2 on the first, {} m/s^2 on the second", shown(first), shown(second))?;
    for (link, omega, alpha) in point.links {
        let (name, omega, alpha) = (&case.mechanism.links()[link].name, significant(omega), significant(alpha));
        writeln!(text, "  {link} {name:14} omega {omega:>10} rad/s   alpha {alpha:>10} rad/s^2")?;
    }
    Ok(())
}

fn as_json(scenario: &Scenario, plans: &Plans, singular: &[Result<SingularPoint>]) -> Value {
    let plan = |plan: &Plan| {
        let vectors = plan.vectors.iter().map(|vector| {
            json!({
                "name": vector.name, "from": vector.from, "to": vector.to, "x": vector.value.x, "y": vector.value.y,
                "size": vector.value.norm(), "paper_mm": plan.paper(vector), "link": vector.link, "meaning": vector.meaning,
            })
        });
        let points = plan.tips.iter().map(|tip| json!({"letter": tip.letter, "x": tip.at.x, "y": tip.at.y}));
        json!({
            "unit": plan.quantity.unit(), "pole": plan.quantity.pole(), "scale_per_mm": plan.scale,
            "points": points.collect::<Vec<_>>(), "vectors": vectors.collect::<Vec<_>>(),
        })
    };
    let scheme = &plans.scheme;
    let links = scheme.links.iter().map(
        |link| json!({"number": link.number, "name": link.name, "omega_rad_s": link.omega, "alpha_rad_s2": link.alpha}),
    );
    let points = scheme.points.iter().map(|(name, at)| json!({"name": name, "x_m": at.x, "y_m": at.y}));
    let singular = singular.iter().map(|found| match found {
        Ok(point) => {
            let links = point.links.map(|(link, omega, alpha)| {
                json!({"name": scenario.case.mechanism.links()[link].name, "omega_rad_s": omega, "alpha_rad_s2": alpha})
            });
            let [first, second] = point.accelerations;
            json!({
                "lines": point.lines(), "x_m": point.at.x, "y_m": point.at.y,
                "vx_m_s": point.velocity.x, "vy_m_s": point.velocity.y,
                "accelerations_m_s2": [[first.x, first.y], [second.x, second.y]], "links": links,
            })
        }
        Err(error) => json!({"error": error.line_by(advice::told)}),
    });
    json!({
        "schema": 1, "scenario": scenario.name, "crank_rad": plans.crank,
        "diagram": {"scale_m_per_mm": scheme.scale, "links": links.collect::<Vec<_>>(), "points": points.collect::<Vec<_>>()},
        "velocity": plan(&plans.velocity), "acceleration": plan(&plans.acceleration),
        "singular_points": singular.collect::<Vec<_>>(),
    })
}
