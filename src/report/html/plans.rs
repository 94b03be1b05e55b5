//! Velocity and acceleration plans, row by row: the vectors of `linkproof plan`, for the script of a page.

use serde_json::{Value, json};

use super::markup::column;
use super::placed::Placed;
use design::diagram::{Part, Plan, Planner, Quantity, TipKind};
use linkage::case::Case;
use linkage::solver::State;

/// Numbers in single precision that a row takes, about.
pub(super) fn width(case: &Case, placed: &Placed, row: usize) -> usize {
    let (planner, state) = (Planner::of(&case.mechanism), placed.state(case, row));
    quantities(placed).map(|quantity| 2 * planner.plan(quantity, &state).tips.len()).sum()
}

/// The quantities whose plans can be drawn.
fn quantities(placed: &Placed) -> impl Iterator<Item = Quantity> {
    let known = [(Quantity::Velocity, placed.knows(false)), (Quantity::Acceleration, placed.knows(true))];
    known.into_iter().filter_map(|(quantity, is_known)| is_known.then_some(quantity))
}

/// The plans of all these rows, and the letters of points.
pub(super) fn of(case: &Case, placed: &Placed, rows: &[usize]) -> Value {
    let planner = Planner::of(&case.mechanism);
    let states: Vec<State> = rows.iter().map(|&row| placed.state(case, row)).collect();
    let plans = quantities(placed).map(|quantity| course(quantity, &planner, &states));
    json!({
        "letters": planner.letters().map(|(name, letter)| json!([name, letter])).collect::<Vec<_>>(),
        "plans": plans.collect::<Vec<_>>(),
    })
}

/// The plan of one quantity. Where a part vanishes, a plan has fewer vectors: every row tells its layout.
fn course(quantity: Quantity, planner: &Planner, states: &[State]) -> Value {
    let plans: Vec<Plan> = states.iter().map(|state| planner.plan(quantity, state)).collect();
    let mut layouts: Vec<&Plan> = Vec::new();
    let mut which: Vec<usize> = Vec::new();
    for plan in &plans {
        let place = layouts.iter().position(|own| has_same_layout(own, plan)).unwrap_or(layouts.len());
        if place == layouts.len() {
            layouts.push(plan);
        }
        which.push(place);
    }
    let most = layouts.iter().map(|own| own.tips.len()).max().unwrap_or(0);
    let tips = (0..most).map(|tip| {
        let at =
            |axis: usize| plans.iter().map(|own| own.tips.get(tip).map_or(0.0, |tip| tip.at[axis])).collect::<Vec<_>>();
        json!([column(&at(0)), column(&at(1))])
    });
    let is_one = layouts.len() == 1;
    json!({
        "word": quantity.word(), "symbol": quantity.symbol(), "pole": quantity.pole(), "unit": quantity.unit(),
        "layouts": layouts.iter().map(|own| layout(own)).collect::<Vec<_>>(),
        "which": if is_one { json!(null) } else { json!(which) }, "tips": tips.collect::<Vec<_>>(),
    })
}

fn has_same_layout(one: &Plan, other: &Plan) -> bool {
    let [tips, others] = [one, other].map(|own| own.tips.iter().map(|tip| &tip.letter));
    let [vectors, other_vectors] =
        [one, other].map(|own| own.vectors.iter().map(|own| (&own.name, &own.from, &own.to)));
    tips.eq(others) && vectors.eq(other_vectors)
}

fn layout(plan: &Plan) -> Value {
    let tips = plan.tips.iter().map(|tip| {
        let kind = match tip.kind {
            TipKind::Fixed => "fixed",
            TipKind::Point => "point",
            TipKind::MassCentre => "centre",
            TipKind::Normal | TipKind::Coriolis => "between",
            TipKind::Coincident => "coincident",
        };
        json!([tip.letter, kind])
    });
    let place = |letter: &str| plan.tips.iter().position(|tip| tip.letter == letter);
    let vectors = plan.vectors.iter().map(|vector| {
        let part = match vector.part {
            Part::Absolute => "absolute",
            Part::MassCentre => "centre",
            Part::Relative => "relative",
            Part::Normal => "normal",
            Part::Tangential => "tangential",
            Part::Sliding => "sliding",
            Part::Coriolis => "coriolis",
        };
        json!([vector.name, part, place(&vector.from), place(&vector.to), vector.link.index(), vector.meaning])
    });
    json!({ "tips": tips.collect::<Vec<_>>(), "vectors": vectors.collect::<Vec<_>>() })
}
