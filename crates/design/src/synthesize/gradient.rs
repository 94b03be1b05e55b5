//! Refinement of a candidate with exact derivatives: sequential quadratic programming.
//!
//! The derivatives of all quantities come from dual numbers ([`precise`]), and not from difference quotients with a
//! step width.
//! The programme is solved by SLSQP (Kraft, A software package for sequential quadratic programming, DFVLR-FB 88-28,
//! 1988).

mod dimensions;
mod gaps;
mod programme;
mod rows;
mod sloped;
mod wishes;

use std::f64::consts::{PI, TAU};

use basin::{Executor, SelectedFirstOrderState, Slsqp, State};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use precise::CaseNumbers;

use super::rating::{Rater, STEP};
use super::search::{Candidate, free_zero};
use super::target::at_speed;
use super::task::Task;
use crate::sentences;
use programme::Programme;
use rows::{Order, Rows};
use wishes::Wishes;

/// In the cost of a candidate, weight of the largest violation of a limit. The largest deviation has the weight 1.
const VIOLATION: f64 = 10.0;
/// Accuracy at which the optimiser ends. The accuracy applies to the deviation, to the constraints, and to the
/// variables as fractions of their ranges.
const ACCURACY: f64 = 1e-9;
/// Upper limit of the unknown deviation (fraction of the stroke). The unknown levels of the output in dwells are
/// between minus this value and this value.
const MOST_DEVIATION: f64 = 100.0;

/// Checks that the derivatives of a task's mechanism are known.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a mechanism with friction or transmissions, and if a transmission angle is limited in
/// a group with driven joints.
pub(super) fn check(task: &Task) -> Result<()> {
    let unsupported = |message: String| {
        Err(Error::new(ErrorKind::Unsupported, message).key("search.refinement").help(sentences::REFINE_BY_EVOLUTION))
    };
    if let Err(error) = CaseNumbers::<f64>::of(&at_speed(&task.case, task.case.crank().top_speed().abs())?) {
        return unsupported(sentences::no_gradients(&error.message()));
    }
    if task.transmission > 0.0 && task.case.structure.groups.iter().any(|group| !group.is_rigid()) {
        return unsupported(sentences::no_gradients(&sentences::A_GROUP_HAS_DRIVEN_JOINTS));
    }
    Ok(())
}

/// The candidate after refinement. The cost of a candidate is the largest deviation plus ten times the largest
/// violation of a limit.
pub(super) fn refine(task: &Task, candidate: &Candidate) -> Candidate {
    let frame = match task.timing.phases() {
        [] => Rater::even(&task.timing, (TAU / STEP).round() as usize),
        _ => Rater::fitted(&task.timing, STEP),
    };
    let wishes = Wishes::of(task, candidate.forward, &frame);
    let mut best = Candidate { cost: f64::INFINITY, ..candidate.clone() };
    let Ok(mut rows) = Rows::new(task, frame.turns.clone()) else { return best };
    if let Some((shares, cost)) = descent(task, &wishes, &mut rows, &candidate.shares) {
        (best.shares, best.cost) = (shares, cost);
    }
    best.poses = rows.poses;
    best
}

/// Runs the optimiser from a candidate. Returns the candidate or the result, whichever has the lower cost, with this
/// cost.
/// `None` if the candidate cannot be assembled.
fn descent<'a>(task: &'a Task, wishes: &Wishes<'a>, rows: &mut Rows<'a>, shares: &[f64]) -> Option<(Vec<f64>, f64)> {
    let turns = rows.turns_near(shares)?;
    let cost = |rows: &mut Rows, shares: &[f64], turns: &[f64]| {
        let found = rows.at(shares, turns, Order::Values)?;
        let point = wishes.start(&found, shares, turns);
        let constraints = wishes.constraints(&found, &point);
        let violation = constraints.iter().fold(0.0, |most: f64, own| most.larger(own.value));
        Some((point[wishes.deviation()] + VIOLATION * violation, point, constraints.len()))
    };
    let (before, start, count) = cost(rows, shares, &turns)?;
    let zero = free_zero(task);
    let bound = |index: usize| match index {
        index if zero == Some(index) => (start[index] - 0.5, start[index] + 0.5),
        index if index < wishes.deviation() => (0.0, 1.0),
        index if index == wishes.deviation() => (0.0, MOST_DEVIATION),
        index if wishes.is_turn(index) => (start[index] - PI, start[index] + PI),
        _ => (-MOST_DEVIATION, MOST_DEVIATION),
    };
    let (lower, upper) = (0..start.len()).map(bound).unzip();
    let programme = Programme::new(wishes, rows, [lower, upper], count);
    let optimiser = Slsqp::new().with_absolute_accuracy_tolerance(ACCURACY);
    let steps = task.effort.evaluations as u64;
    let run = Executor::new(programme, optimiser, SelectedFirstOrderState::new(start)).max_iter(steps).run();
    let Ok(run) = run else { return Some((shares.to_vec(), before)) };
    let point = run.state.param();
    let mut reached = wishes.shares(point).to_vec();
    if let Some(zero) = zero {
        reached[zero] = reached[zero].rem_euclid(1.0);
    }
    let after = cost(rows, &reached, &wishes.turns(point)).map_or(f64::INFINITY, |(cost, ..)| cost);
    Some(if after < before { (reached, after) } else { (shares.to_vec(), before) })
}

#[cfg(test)]
mod tests;
