//! Velocity and acceleration plans, row by row: the vectors of `linkproof plan`, for the script of a page.

use serde_json::{Value, json};

use super::markup::column;
use super::placed::Placed;
use crate::report::pretty::list;
use design::plan::{Planner, Quantity, VectorPlan};
use linkage::case::Case;
use linkage::solver::State;

/// Approximate number of single-precision values that the plans add to a row.
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
    json!({
        "letters": list(planner.letters(), |(name, letter)| json!([name, letter])),
        "plans": list(quantities(placed), |quantity| course(quantity, &planner, &states)),
    })
}

/// The plan of one quantity at all rows.
/// A plan has fewer vectors if a component vanishes, so every row states which vectors it has.
fn course(quantity: Quantity, planner: &Planner, states: &[State]) -> Value {
    let plans: Vec<VectorPlan> = states.iter().map(|state| planner.plan(quantity, state)).collect();
    let mut layouts: Vec<&VectorPlan> = Vec::new();
    let mut which: Vec<usize> = Vec::new();
    for plan in &plans {
        let place = layouts.iter().position(|own| has_same_layout(own, plan)).unwrap_or(layouts.len());
        if place == layouts.len() {
            layouts.push(plan);
        }
        which.push(place);
    }
    let most = layouts.iter().map(|own| own.tips.len()).max().unwrap_or(0);
    let tips = list(0..most, |tip| {
        let at = |axis: usize| plans.iter().map(move |own| own.tips.get(tip).map_or(0.0, |tip| tip.at[axis]));
        [0, 1].map(|axis| column(at(axis))).into()
    });
    json!({
        "word": quantity.word(), "symbol": quantity.symbol(), "pole": quantity.pole(), "unit": quantity.unit(),
        "layouts": list(&layouts, |own| layout(own)), "which": (layouts.len() != 1).then_some(which), "tips": tips,
    })
}

fn has_same_layout(one: &VectorPlan, other: &VectorPlan) -> bool {
    let [tips, others] = [one, other].map(|own| own.tips.iter().map(|tip| &tip.letter));
    let [vectors, other_vectors] =
        [one, other].map(|own| own.vectors.iter().map(|own| (&own.name, &own.from, &own.to)));
    tips.eq(others) && vectors.eq(other_vectors)
}

fn layout(plan: &VectorPlan) -> Value {
    let tips = list(&plan.tips, |tip| json!([tip.letter, tip.kind.word()]));
    let place = |letter: &str| plan.tips.iter().position(|tip| tip.letter == letter);
    let vectors = list(&plan.vectors, |vector| {
        json!([
            vector.name,
            vector.part.word(),
            place(&vector.from),
            place(&vector.to),
            vector.link.index(),
            vector.meaning
        ])
    });
    json!({ "tips": tips, "vectors": vectors })
}
