//! Refinement of one candidate: an evolution strategy across kinks and edges, then COBYLA.
//! A candidate is given by its variables, as fractions of the ranges between their bounds.

use std::cell::RefCell;
use std::f64::consts::TAU;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use cobyla::{RhoBeg, minimize};

use crate::synthesize::evaluate::Evaluator;
use crate::synthesize::rating::{Rater, STEP};
use crate::synthesize::task::{Task, TaskNumber, Variable};
use linkage::mechanism::GroupKind;

/// Smallest cost of a candidate that cannot be assembled over the whole turn.
/// The cost rises to twice this value if no pose can be assembled.
const BROKEN: f64 = 100.0;
/// Fraction of the allowed evaluations that the evolution strategy may use.
const EVOLUTION: f64 = 0.5;
/// First step size of the evolution strategy, as a fraction of the range between the bounds.
/// If the step size falls below `LAST`, the strategy restarts with the first step size.
const FIRST: f64 = 0.05;
const LAST: f64 = 1e-5;
/// Factor by which the step size grows after a success.
/// After a failure, the step size is divided by the fourth root of this factor.
/// The step size is therefore stationary if one trial in five succeeds.
const GROWTH: f64 = 1.5;
/// Probability that a variable changes from parent to child.
const CHANGED: f64 = 0.4;
/// Initial step sizes of the successive runs of COBYLA. Each run starts from the best candidate so far.
const RADII: [f64; 4] = [3e-2, 1e-2, 3e-3, 1e-3];
/// A run of COBYLA ends if the relative change of the cost is below this limit.
const SETTLED: f64 = 1e-7;

/// Computes the cost of a candidate. The candidate is given by its variables, as fractions of the ranges between their
/// bounds.
/// The crank angles at which the output is computed include the ends of all phases.
struct Bench<'a> {
    task: &'a Task,
    evaluator: Evaluator<'a>,
    rater: Rater<'a>,
    forward: f64,
    best: Vec<f64>,
    cost: f64,
}

impl Bench<'_> {
    /// Addition to the cost for limits that the last candidate violates.
    fn excess(&self) -> f64 {
        self.rater.excess(self.task, self.evaluator.sine, self.evaluator.acceleration)
    }

    fn cost(&mut self, shares: &[f64]) -> f64 {
        let values = values(self.task, shares);
        let zero = self.task.zero.value(&values);
        let cost = match self.evaluator.run(&values, zero, &self.rater.turns) {
            Err(reached) => BROKEN * (2.0 - reached),
            Ok(()) if !(self.rater.take(&self.evaluator.curve) > 0.0) => BROKEN,
            Ok(()) => self.rater.cost(0, self.forward) + self.excess(),
        };
        if cost < self.cost {
            self.cost = cost;
            self.best.copy_from_slice(shares);
        }
        cost
    }
}

/// The candidate after refinement.
pub(super) fn refine(task: &Task, candidate: &Candidate) -> Candidate {
    let mut bench = Bench {
        task,
        evaluator: Evaluator::new(task),
        rater: Rater::fitted(&task.timing, STEP),
        forward: candidate.forward,
        best: candidate.shares.clone(),
        cost: f64::INFINITY,
    };
    bench.cost(&candidate.shares);
    let zero = free_zero(task);
    let evolving = (task.effort.evaluations as f64 * EVOLUTION) as usize;
    evolve(&mut bench, zero, evolving, candidate.number);
    approximate(&mut bench, zero, task.effort.evaluations - evolving);
    if let Some(zero) = zero {
        bench.best[zero] = bench.best[zero].rem_euclid(1.0);
    }
    Candidate { shares: bench.best, cost: bench.cost, poses: bench.evaluator.poses, ..*candidate }
}

/// Evolution strategy with one parent and one child. The better of the two becomes the parent.
fn evolve(bench: &mut Bench, zero: Option<usize>, evaluations: usize, number: usize) {
    let mut rng = ChaCha8Rng::seed_from_u64(bench.task.effort.seed);
    // Every candidate has a separate random stream. The blocks of random candidates use streams with smaller numbers.
    rng.set_stream((1 << 40) + number as u64);
    let mut child = bench.best.clone();
    let mut step = FIRST;
    for _ in 0..evaluations {
        child.copy_from_slice(&bench.best);
        for (index, share) in child.iter_mut().enumerate() {
            if even(&mut rng) < CHANGED {
                // The sum of four uniform numbers is approximately normal, with the variance 1 / 3. The factor raises
                // the variance to 1.
                let normal = (0..4).map(|_| even(&mut rng) - 0.5).sum::<f64>() * 3f64.sqrt();
                *share += step * normal;
                if zero != Some(index) {
                    *share = share.clamp(0.0, 1.0);
                }
            }
        }
        let before = bench.cost;
        step *= if bench.cost(&child) < before { GROWTH } else { GROWTH.powf(-0.25) };
        if step < LAST {
            step = FIRST;
        }
    }
}

/// Runs COBYLA from the best candidate so far, with decreasing initial steps.
fn approximate(bench: &mut Bench, zero: Option<usize>, evaluations: usize) {
    let each = evaluations / RADII.len();
    // If the limit of evaluations were zero, COBYLA would run without a limit. COBYLA is therefore not called in this
    // case.
    if each == 0 {
        return;
    }
    let count = bench.best.len();
    let start = bench.best.clone();
    let bounds: Vec<(f64, f64)> = (0..count)
        .map(|index| if zero == Some(index) { (start[index] - 0.5, start[index] + 0.5) } else { (0.0, 1.0) })
        .collect();
    for radius in RADII {
        let from = bench.best.clone();
        let shared = RefCell::new(&mut *bench);
        let objective = |shares: &[f64], _: &mut ()| shared.borrow_mut().cost(shares);
        let none: [fn(&[f64], &mut ()) -> f64; 0] = [];
        let stop = cobyla::StopTols { ftol_rel: SETTLED, ..cobyla::StopTols::default() };
        // The return value of COBYLA is not needed, because the best candidate is recorded during the run.
        let _ = minimize(objective, &from, &bounds, &none, (), each, RhoBeg::All(radius), Some(stop));
    }
}

/// A candidate and its cost.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::synthesize) struct Candidate {
    /// The variables as fractions of the ranges between their bounds: 0 is the lower bound, 1 the upper bound.
    pub(in crate::synthesize) shares: Vec<f64>,
    /// Sense of the output that counts as forward: +1 or -1.
    pub(in crate::synthesize) forward: f64,
    pub(in crate::synthesize) cost: f64,
    /// Number of the candidate. Of two candidates with equal cost, the one with the lower number is kept.
    pub(in crate::synthesize) number: usize,
    /// Number of poses that the refinement of the candidate solved.
    pub(in crate::synthesize) poses: u64,
}

/// A number from 0 to 1: the upper 53 bits of a random draw.
pub(super) fn even(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// Values (SI) of variables that are given as fractions of the ranges between their bounds.
pub(in crate::synthesize) fn values(task: &Task, shares: &[f64]) -> Vec<f64> {
    let value = |(share, variable): (&f64, &Variable)| of_share(*share, variable);
    shares.iter().zip(&task.variables).map(value).collect()
}

#[inline]
pub(in crate::synthesize) fn of_share(share: f64, variable: &Variable) -> f64 {
    let [low, high] = variable.bounds;
    low + share * (high - low)
}

/// A value as a fraction of the range between the bounds.
pub(in crate::synthesize) fn share_of(value: f64, variable: &Variable) -> f64 {
    let [low, high] = variable.bounds;
    if high > low { (value - low) / (high - low) } else { 0.0 }
}

/// Index of the variable that is the crank's zero, if this variable only shifts the motion along the crank angle and is
/// therefore periodic.
/// `None` if the zero is fixed, if its bounds do not span a full turn, if the mechanism has a higher group, or if the
/// task has precision points.
pub(in crate::synthesize) fn free_zero(task: &Task) -> Option<usize> {
    let TaskNumber::Free(index) = task.zero else { return None };
    let [low, high] = task.variables[index].bounds;
    let only_shifts = task.points.is_empty();
    let closed_form = task.case.structure.groups.iter().all(|group| group.kind != GroupKind::Higher);
    (only_shifts && closed_form && (high - low - TAU).abs() < 1e-9).then_some(index)
}
