//! Random search over lengths and pivots, and refinement of the best candidates.
//!
//! Candidates are drawn uniformly within their bounds.
//! Every block of candidates has a separate random stream (ChaCha, by Bernstein).
//! The result therefore depends on the seed and not on the number of threads.
//! An evolution strategy refines the best candidates, with one parent, one child and the one-fifth rule (Rechenberg
//! 1973).
//! This strategy can cross kinks and edges of the cost.
//! After the evolution strategy, linear approximation within a trust region refines the result (COBYLA, Powell 1994).

mod refine;

use crate::sentences;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;

use super::achieved::fine_turns;
use super::evaluate::Evaluator;
use super::rating::Rater;
use super::redraw::round_values;
use crate::synthesize::task::Task;
use linkage::error::{Error, ErrorKind, Result};
use linkage::solver::Progress;
use linkage::threads::{cores, made};
use refine::{Candidate, even, free_zero, of_share, values};

/// Number of evenly spaced crank angles at which the cost of a random candidate is computed.
const COARSE: usize = 72;
/// Candidates per random stream.
const BLOCK: usize = 4096;
/// Number of blocks between two calls of `progress`.
/// This number is constant, so that the candidates that are kept do not depend on the number of threads.
const ROUND: usize = 16;
/// Largest number of threads.
const MOST_THREADS: usize = 256;
/// Fraction of the progress bar for the random candidates.
const RANDOM_SHARE: f64 = 0.5;
/// Shifts of the crank's zero are tried in steps of this many rows.
/// Afterwards, the shifts around the best shift are tried row by row.
const STRIDE: usize = 3;

/// A random candidate is dropped if its stroke, acceleration or transmission sine violates a limit by more than this
/// factor.
/// Refinement would hardly repair such candidates.
const NEAR: f64 = 1.5;

/// Result of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchResult {
    /// Values of the variables (SI), in the order of [`Task::variables`].
    pub values: Vec<f64>,
    /// Sense of the output that counts as forward: +1 or -1.
    pub forward: f64,
    /// Cost of the best candidate: a sum of squares of fractions of the stroke.
    pub cost: f64,
    /// Cost of the best candidate before refinement, on a coarser grid than that of `cost`.
    pub random_cost: f64,
    /// Number of random candidates, and number of candidates that assemble over the whole turn and nearly keep the
    /// limits.
    pub candidates: [usize; 2],
    /// Costs of all refined candidates, ascending.
    pub refined: Vec<f64>,
}

/// Searches for the dimensions of a task with `threads` threads; 0 means one thread for each core.
/// `progress` is called with values from 0 to 1.
///
/// # Errors
/// The errors of [`Task::check`]; [`ErrorKind::Numeric`] if no candidate assembles over the whole turn and nearly keeps
/// the limits.
pub fn search(task: &Task, threads: usize, progress: Progress) -> Result<SearchResult> {
    task.check()?;
    let threads = if threads == 0 { cores() } else { threads.min(MOST_THREADS) };
    let effort = task.effort;
    let blocks: Vec<usize> = (0..effort.candidates.div_ceil(BLOCK)).collect();
    let (mut kept, mut assembled) = (Vec::new(), 0);
    let rounds = blocks.chunks(ROUND);
    let count = rounds.len();
    for (round, blocks) in rounds.enumerate() {
        let found = made(blocks, threads, |&block| Random::new(task).block(block), |_| {});
        for (best, own) in found {
            kept.extend(best);
            assembled += own;
        }
        keep(&mut kept, effort.refined);
        progress(RANDOM_SHARE * (round + 1) as f64 / count as f64);
    }
    let Some(random_cost) = kept.first().map(|best| best.cost) else { return Err(none(task)) };
    let mut refined = Vec::new();
    let total = kept.len();
    for chunk in kept.chunks(ROUND) {
        refined.extend(made(chunk, threads, |candidate| refine::refine(task, candidate), |_| {}));
        progress(RANDOM_SHARE + (1.0 - RANDOM_SHARE) * refined.len() as f64 / total as f64);
    }
    let count = refined.len();
    keep(&mut refined, count);
    let Some(best) = refined.iter().find(|candidate| holds(task, candidate)) else { return Err(none(task)) };
    Ok(SearchResult {
        values: values(task, &best.shares),
        forward: best.forward,
        cost: best.cost,
        random_cost,
        candidates: [effort.candidates, assembled],
        refined: refined.iter().map(|candidate| candidate.cost).collect(),
    })
}

/// Whether a candidate with rounded dimensions can be followed over the whole turn in the fine steps in which results
/// are measured. In larger steps, a higher group may change its branch unnoticed.
fn holds(task: &Task, candidate: &Candidate) -> bool {
    let values = round_values(task, &values(task, &candidate.shares));
    Evaluator::new(task).run(&values, task.zero.value(&values), &fine_turns()).is_ok()
}

fn none(task: &Task) -> Error {
    let message = sentences::none_of_candidates_can_be_assembled(&task.effort.candidates);
    Error::new(ErrorKind::Numeric, message).help(sentences::DRAW_MORE_CANDIDATES_NARROW_THE_BOUNDS)
}

/// Keeps the `count` candidates of lowest cost, in order.
/// Of two candidates with equal cost, the candidate that was drawn first comes first.
fn keep(candidates: &mut Vec<Candidate>, count: usize) {
    candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.number.cmp(&b.number)));
    candidates.truncate(count);
}

/// Draws candidates and computes their costs.
struct Random<'a> {
    task: &'a Task,
    evaluator: Evaluator<'a>,
    rater: Rater<'a>,
    zero: Option<usize>,
    values: Vec<f64>,
}

impl<'a> Random<'a> {
    fn new(task: &'a Task) -> Self {
        Random {
            task,
            evaluator: Evaluator::new(task),
            rater: Rater::even(&task.timing, COARSE),
            zero: free_zero(task),
            values: vec![0.0; task.variables.len()],
        }
    }

    /// The best candidates of a block, and the number of its candidates that assemble and nearly keep the limits.
    fn block(&mut self, block: usize) -> (Vec<Candidate>, usize) {
        let effort = &self.task.effort;
        let mut rng = ChaCha8Rng::seed_from_u64(effort.seed);
        rng.set_stream(block as u64);
        let (mut best, mut assembled): (Vec<Candidate>, usize) = (Vec::new(), 0);
        let mut shares = vec![0.0; self.task.variables.len()];
        for number in block * BLOCK..((block + 1) * BLOCK).min(effort.candidates) {
            shares.iter_mut().for_each(|share| *share = even(&mut rng));
            let worst = match best.len() < effort.refined {
                true => f64::INFINITY,
                false => best.last().map_or(f64::INFINITY, |last| last.cost),
            };
            let Some((cost, forward)) = self.rate(&mut shares) else { continue };
            assembled += 1;
            if cost < worst {
                best.push(Candidate { shares: shares.clone(), forward, cost, number });
                keep(&mut best, effort.refined);
            }
        }
        (best, assembled)
    }

    /// Cost of a candidate, and the sense of its output that counts as forward.
    /// If the crank's zero is free, this function chooses the zero.
    /// `None` if the candidate cannot be assembled, or is far outside the limits.
    fn rate(&mut self, shares: &mut [f64]) -> Option<(f64, f64)> {
        if let Some(zero) = self.zero {
            shares[zero] = 0.0;
        }
        for ((value, share), variable) in self.values.iter_mut().zip(shares.iter()).zip(&self.task.variables) {
            *value = of_share(*share, variable);
        }
        let zero = self.task.zero.value(&self.values);
        self.evaluator.run(&self.values, zero, &self.rater.turns).ok()?;
        let span = self.rater.take(&self.evaluator.curve);
        let [least, most] = self.task.stroke;
        let (sine, acceleration) = (self.evaluator.sine, self.evaluator.acceleration);
        let is_near = NEAR * span >= least && span <= NEAR * most && acceleration <= NEAR * self.task.acceleration;
        if !(span > 0.0 && is_near && NEAR * sine >= self.task.transmission.sin()) {
            return None;
        }
        let excess = self.rater.excess(self.task, sine, acceleration);
        let senses: &[f64] = match self.task.forward {
            Some(sense) if sense > 0.0 => &[1.0],
            Some(_) => &[-1.0],
            None => &[1.0, -1.0],
        };
        let mut best = (f64::INFINITY, 1.0, 0);
        for &sense in senses {
            let mut consider = |shift: usize| {
                let cost = self.rater.cost(shift, sense);
                if cost < best.0 {
                    best = (cost, sense, shift);
                }
            };
            if self.zero.is_none() {
                consider(0);
                continue;
            }
            (0..COARSE).step_by(STRIDE).for_each(&mut consider);
        }
        if let Some(zero) = self.zero {
            let (_, sense, middle) = best;
            for near in (1..STRIDE).flat_map(|off| [middle + off, middle + COARSE - off]) {
                let cost = self.rater.cost(near % COARSE, sense);
                if cost < best.0 {
                    best = (cost, sense, near % COARSE);
                }
            }
            shares[zero] = (self.task.turning() * best.2 as f64 / COARSE as f64).rem_euclid(1.0);
        }
        Some((best.0 + excess, best.1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_candidates_are_kept_in_the_order_of_drawing() {
        let candidate = |cost, number| Candidate { shares: Vec::new(), forward: 1.0, cost, number };
        let mut all = vec![candidate(2.0, 0), candidate(1.0, 7), candidate(1.0, 3), candidate(f64::NAN, 1)];
        keep(&mut all, 3);
        assert_eq!(all.iter().map(|one| one.number).collect::<Vec<_>>(), [3, 7, 0]);
    }

    #[test]
    fn random_numbers_are_uniform_and_repeatable() {
        // The seed of a task must determine its result in every version of the library.
        // The test therefore compares the draws with stored numbers.
        let draw = || {
            let mut rng = ChaCha8Rng::seed_from_u64(5);
            (0..10_000).map(|_| even(&mut rng)).collect::<Vec<_>>()
        };
        let found = draw();
        assert_eq!(found, draw());
        assert_eq!(found[..2], [0.201_249_703_347_803_68, 0.715_180_539_823_381_7]);
        let mean = found.iter().sum::<f64>() / 1e4;
        assert!((mean - 0.5).abs() < 0.01 && found.iter().all(|u| (0.0..1.0).contains(u)), "{mean}");
    }
}
