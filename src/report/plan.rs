//! Velocity and acceleration plans at one crank angle.

use crate::sentences;
use serde_json::{Value, json};

use super::pretty::{list, pretty};
use crate::plain::Tell;
use crate::plain::cells::{trimmed, worded};
use design::draw::{scale_shown, significant, toward};
use design::plan::singular::{AssurAcceleration, AssurTrial};
use design::plan::{CentreSheet, PlanTurn, Plans, SingularPoint, VectorPlan};
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::centre::MotionCentre;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::LinkId;
use prover::numbers::{self, input_told};
use scenario::Scenario;

/// Rounding error of a plan, as a fraction of its largest vector.
const ROUNDING: f64 = 1e-12;

/// A number with four digits; a number below the rounding error is shown as zero.
fn known(value: f64, largest: f64) -> String {
    significant(if value.abs() > ROUNDING * largest { value } else { 0.0 })
}

/// The plans as text.
/// `singular`: for each group of class III or IV, its singular point or the reason why the point does not exist.
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
    say!(text, sentences::kinematic_diagram_mu_mm(&scale_shown(plans.scheme.scale)));
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
        say!(text, sentences::plan_pole_mu_mm(&word, &plan.quantity.pole(), &symbol, &scale_shown(plan.scale), &unit));
        if plan.turn != PlanTurn::Upright {
            say!(text, sentences::turned_by_deg_on_paper(&plan.turn.word()));
        }
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
    if let Some(sheet) = &plans.centres {
        centres_text(&mut text, sheet, width);
    }
    text
}

/// A vector as text.
fn shown(vector: Vec2) -> String {
    format!("({}, {})", significant(vector.x), significant(vector.y))
}

fn singular_text(text: &mut String, case: &Case, point: &SingularPoint) {
    let class = if point.class == 3 { "III" } else { "IV" };
    say!(text, sentences::singular_point_of_the_class(&class, &point.lines(), &shown(point.at)));
    match &point.acceleration {
        AssurAcceleration::Known(found) => {
            say!(text, sentences::on_the_base_link(&shown(point.velocity), &shown(found.at)));
        }
        AssurAcceleration::FalsePositions(found) => {
            say!(text, sentences::on_both_base_links(&shown(point.velocity)));
            let [first, second] = [0, 1].map(|side| shown(point.accelerations[side]));
            say!(text, sentences::a_on_the_first_on_the_second(&first, &second));
            for (alpha, trial) in &found.trials {
                say!(text, sentences::false_position(&found.driver, &significant(*alpha), &shown(trial.at)));
            }
            let alpha = significant(found.alphas[0]);
            say!(text, sentences::lines_of_positions_meet(&shown(found.at), &found.driver, &alpha));
        }
    }
    for &(link, omega, alpha) in &point.links {
        let (name, omega, alpha) = (&case.mechanism.links()[link].name, significant(omega), significant(alpha));
        say!(text, sentences::omega_rad_alpha_rad(&link, &name, &omega, &alpha));
    }
}

/// The instant centres and acceleration centres as text.
fn centres_text(text: &mut String, sheet: &CentreSheet, width: Option<usize>) {
    say!(text, sentences::INSTANT_CENTRES_OF_ALL_PAIRS);
    let cells = |place: MotionCentre| match place {
        MotionCentre::At(at) => [at.x, at.y].map(significant),
        MotionCentre::AtInfinity(direction) => ["infinity".into(), toward(direction)],
        MotionCentre::Nowhere => [sentences::NOWHERE.into(), "-".into()],
        MotionCentre::Everywhere => [sentences::EVERYWHERE.into(), "-".into()],
    };
    let instant = sheet.instant().map(|centre| {
        let [x, y] = cells(centre.place);
        [format!("P{}", centre.numbers()), x, y, centre.told()]
    });
    let acceleration = sheet.acceleration().map(|(link, place)| {
        let [x, y] = cells(place);
        [format!("π{link}"), x, y, sentences::acceleration_centre_of_link(&link)]
    });
    let table = worded("centre | x, m> | y, m> | found by", width).add_rows(instant.chain(acceleration)).clone();
    say!(text, "{}", trimmed(&table));
    let worst = sheet.instant().map(|centre| centre.slip).fold(0.0, f64::larger);
    say!(text, sentences::largest_relative_velocity_at_a_centre(&significant(worst)));
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
            "turned_deg": plan.turn.degrees(), "points": points, "vectors": vectors,
        })
    };
    let scheme = &plans.scheme;
    let links = list(
        &scheme.links,
        |link| json!({"number": link.number.index(), "name": link.name, "omega_rad_s": link.omega, "alpha_rad_s2": link.alpha}),
    );
    let points = list(&scheme.points, |(name, at)| json!({"name": name, "x_m": at.x, "y_m": at.y}));
    let singular = list(singular, |found| match found {
        Ok(point) => singular_json(&scenario.case, point),
        Err(error) => json!({"error": error.line_by(tell)}),
    });
    let mut document = json!({
        "schema": 1, "scenario": scenario.name, scenario.case.crank().input.key(): plans.crank,
        "diagram": {"scale_m_per_mm": scheme.scale, "links": links, "points": points},
        "velocity": plan(&plans.velocity), "acceleration": plan(&plans.acceleration), "singular_points": singular,
    });
    if let Some(sheet) = &plans.centres {
        document["instant_centres"] = list(sheet.instant(), |centre| {
            let [place, links] = [place_json(centre.place), json!(centre.links.map(LinkId::index))];
            json!({
                "name": format!("P{}", centre.numbers()), "links": links, "place": place, "found": centre.told(),
                "relative_velocity_m_s": centre.slip,
            })
        });
        document["acceleration_centres"] = list(
            sheet.acceleration(),
            |(link, place)| json!({"name": format!("π{link}"), "link": link.index(), "place": place_json(place)}),
        );
    }
    pretty(&document)
}

/// A centre as JSON: its position, its direction as a unit vector if it is at infinity, or a word.
fn place_json(place: MotionCentre) -> Value {
    match place {
        MotionCentre::At(at) => json!({"x_m": at.x, "y_m": at.y}),
        MotionCentre::AtInfinity(direction) => json!({"at_infinity": [direction.x, direction.y]}),
        MotionCentre::Nowhere => json!("nowhere"),
        MotionCentre::Everywhere => json!("everywhere"),
    }
}

fn singular_json(case: &Case, point: &SingularPoint) -> Value {
    let pair = |vector: Vec2| json!([vector.x, vector.y]);
    let links = list(
        &point.links,
        |(link, omega, alpha)| json!({"name": case.mechanism.links()[*link].name, "omega_rad_s": omega, "alpha_rad_s2": alpha}),
    );
    let trial = |found: &AssurTrial| json!({"feet_m_s2": found.feet.map(pair), "a_m_s2": pair(found.at)});
    let construction = match &point.acceleration {
        AssurAcceleration::Known(found) => trial(found),
        AssurAcceleration::FalsePositions(found) => {
            let trials = list(&found.trials, |(alpha, own)| {
                let mut own = trial(own);
                own["alpha_rad_s2"] = json!(alpha);
                own
            });
            json!({
                "link": case.mechanism.links()[found.driver].name, "false_positions": trials,
                "line_of_true_positions_from_m_s2": pair(found.foot), "a_m_s2": pair(found.at),
                "alpha_rad_s2": found.alphas[0],
            })
        }
    };
    json!({
        "class": point.class, "lines": point.lines(), "x_m": point.at.x, "y_m": point.at.y,
        "vx_m_s": point.velocity.x, "vy_m_s": point.velocity.y,
        "accelerations_m_s2": list(&point.accelerations, |own| pair(*own)), "construction": construction,
        "links": links,
    })
}
