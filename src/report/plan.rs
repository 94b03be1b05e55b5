//! Velocity and acceleration plans at one crank angle.

use crate::sentences;
use serde_json::json;

use super::pretty::{list, pretty};
use crate::plain::Tell;
use crate::plain::cells::{trimmed, worded};
use design::draw::significant;
use design::plan::{Plans, SingularPoint, VectorPlan};
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::KeepNan;
use prover::numbers::{self, input_told};
use scenario::Scenario;

/// Rounding error of a plan, as a fraction of its largest vector.
const ROUNDING: f64 = 1e-12;

/// A number with four digits; a number below the rounding error is shown as zero.
fn known(value: f64, largest: f64) -> String {
    significant(if value.abs() > ROUNDING * largest { value } else { 0.0 })
}

/// The plans as text.
/// `singular`: the singular points of groups of class IV, or the reason why a singular point was not found.
/// `is_free`: whether forces determine the motion; the plans then show the nominal motion.
/// `tell` puts the advice into words; `width` is the number of columns of the text.
pub(crate) fn text(
    scenario: &Scenario,
    is_free: bool,
    plans: &Plans,
    singular: &[Result<SingularPoint>],
    tell: Tell,
    width: Option<usize>,
) -> String {
    let mut text = sentences::scenario_at(&scenario.name, &input_told(scenario.case.told(plans.crank), 4));
    if is_free {
        let (input, speed) = (scenario.case.crank().input, significant(scenario.case.crank().top_speed()));
        let way = if input.period().is_some() { "turning" } else { "moving" };
        let moves = format!("{} {way}", input.word());
        say!(text, sentences::the_motion_is_free_these(&moves, &speed, &input.unit()));
    }
    say!(text, sentences::kinematic_diagram_mu_mm(&plans.scheme.scale));
    let links = &plans.scheme.links;
    let [fastest, steepest] = links.iter().fold([0.0; 2], |[omega, alpha]: [f64; 2], link| {
        [omega.larger(link.omega.abs()), alpha.larger(link.alpha.abs())]
    });
    for link in links {
        let (omega, alpha) = (known(link.omega, fastest), known(link.alpha, steepest));
        say!(text, sentences::omega_rad_alpha_rad(&link.number, &link.name, &omega, &alpha));
    }
    for plan in [&plans.velocity, &plans.acceleration] {
        let (word, symbol, unit) = (plan.quantity.word(), plan.quantity.symbol(), numbers::shown(plan.quantity.unit()));
        say!(text, sentences::plan_pole_mu_mm(&word, &plan.quantity.pole(), &symbol, &plan.scale, &unit));
        let largest = plan.vectors.iter().map(|vector| vector.value.norm()).fold(0.0, f64::larger);
        let header = format!("vector | from, to | {unit}> | x> | y> | mm> | meaning");
        let rows = plan.vectors.iter().map(|vector| {
            let (ends, value) = (format!("{}, {}", vector.from, vector.to), vector.value);
            let [size, x, y] = [value.norm(), value.x, value.y].map(|part| known(part, largest));
            let paper = numbers::fixed(plan.paper(vector), 2);
            [vector.name.clone(), ends, size, x, y, paper, vector.meaning.clone()]
        });
        say!(text, "{}", trimmed(worded(&header, width).add_rows(rows)));
    }
    for found in singular {
        match found {
            Ok(point) => singular_text(&mut text, &scenario.case, point),
            Err(error) => say!(text, sentences::singular_point(&error.line_by(tell))),
        };
    }
    text
}

fn singular_text(text: &mut String, case: &Case, point: &SingularPoint) {
    let shown = |v: linkage::math::Vec2| format!("({}, {})", significant(v.x), significant(v.y));
    say!(text, sentences::singular_point_of_the_class(&point.lines(), &shown(point.at)));
    say!(text, sentences::on_both_base_links(&shown(point.velocity)));
    let [first, second] = point.accelerations;
    say!(text, sentences::a_on_the_first_on_the_second(&shown(first), &shown(second)));
    for (link, omega, alpha) in point.links {
        let (name, omega, alpha) = (&case.mechanism.links()[link].name, significant(omega), significant(alpha));
        say!(text, sentences::omega_rad_alpha_rad(&link, &name, &omega, &alpha));
    }
}

/// The plans as JSON, schema 1. The arguments are those of [`text`].
pub(crate) fn json(scenario: &Scenario, plans: &Plans, singular: &[Result<SingularPoint>], tell: Tell) -> String {
    let plan = |plan: &VectorPlan| {
        let vectors = list(&plan.vectors, |vector| {
            json!({
                "name": vector.name, "from": vector.from, "to": vector.to, "x": vector.value.x, "y": vector.value.y,
                "size": vector.value.norm(), "paper_mm": plan.paper(vector), "link": vector.link.index(), "meaning": vector.meaning,
            })
        });
        let points = list(&plan.tips, |tip| json!({"letter": tip.letter, "x": tip.at.x, "y": tip.at.y}));
        json!({
            "unit": plan.quantity.unit(), "pole": plan.quantity.pole(), "scale_per_mm": plan.scale,
            "points": points, "vectors": vectors,
        })
    };
    let scheme = &plans.scheme;
    let links = list(
        &scheme.links,
        |link| json!({"number": link.number.index(), "name": link.name, "omega_rad_s": link.omega, "alpha_rad_s2": link.alpha}),
    );
    let points = list(&scheme.points, |(name, at)| json!({"name": name, "x_m": at.x, "y_m": at.y}));
    let singular = list(singular, |found| match found {
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
        Err(error) => json!({"error": error.line_by(tell)}),
    });
    pretty(&json!({
        "schema": 1, "scenario": scenario.name, scenario.case.crank().input.key(): plans.crank,
        "diagram": {"scale_m_per_mm": scheme.scale, "links": links, "points": points},
        "velocity": plan(&plans.velocity), "acceleration": plan(&plans.acceleration), "singular_points": singular,
    }))
}
