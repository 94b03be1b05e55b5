//! Random search over lengths and pivots, and refinement of the best candidates.
//!
//! Candidates are drawn uniformly within their bounds.
//! Every block of candidates has a separate random stream (ChaCha, by Bernstein).
//! The result therefore depends on the seed and not on the number of threads.
//! The module `gradient` refines the best candidates with exact derivatives.
//! Without derivatives, two methods refine the best candidates, one after the other.
//! The first is an evolution strategy with one parent, one child and the one-fifth rule (Rechenberg 1973). The
//! evolution strategy can cross kinks and edges of the cost function.
//! The second is linear approximation within a trust region (COBYLA, Powell 1994).

mod refine;

use crate::sentences;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;

use super::achieved::fine_turns;
use super::evaluate::Evaluator;
use super::gradient;
use super::rating::Rater;
use super::redraw::round_values;
use crate::synthesize::task::{PrecisionPoint, Refinement, Task};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::solver::Progress;
use linkage::threads::{cores, made};
use refine::even;
pub(super) use refine::{Candidate, free_zero, of_share, share_of, values};
use std::f64::consts::TAU;

/// Number of evenly spaced crank angles at which the cost of a random candidate is computed.
const COARSE: usize = 72;
/// Number of candidates in a block. Each block has a separate random stream.
const BLOCK: usize = 4096;
/// Number of blocks between two calls of `progress`.
/// This number does not depend on the number of threads, so the threads do not affect which candidates are kept.
const ROUND: usize = 16;
/// Largest number of threads.
const MOST_THREADS: usize = 256;
/// Value of the progress, from 0 to 1, when all random candidates are computed.
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
    /// Cost of the best candidate. With an evolution strategy: a weighted sum of squared fractions of the stroke.
    /// With exact derivatives: the largest deviation plus ten times the largest violation of a limit.
    pub cost: f64,
    /// Cost of the best random candidate before refinement, computed at fewer crank angles than `cost`. NaN if no
    /// random candidate was kept.
    pub random_cost: f64,
    /// Number of random candidates, and number of candidates that assemble over the whole turn and nearly keep the
    /// limits.
    pub candidates: [usize; 2],
    /// Costs of all refined candidates, ascending.
    pub refined: Vec<f64>,
    /// Number of poses solved by the random search and by the refinement.
    pub poses: [u64; 2],
}

/// Searches for the dimensions of a task with `threads` threads; 0 means one thread for each core.
/// `progress` is called with values from 0 to 1.
///
/// # Errors
/// The errors of [`Task::check`]; [`ErrorKind::Unsupported`] for a mechanism whose derivatives are not known;
/// [`ErrorKind::Numeric`] if no candidate both assembles over the whole turn and nearly keeps the limits.
pub fn search(task: &Task, threads: usize, progress: Progress) -> Result<SearchResult> {
    search_from(task, &[], threads, progress)
}

/// Like [`search`], but the results `starts` of other searches are also refined, together with the best random
/// candidates.
///
/// # Errors
/// The errors of [`search`].
pub fn search_from(task: &Task, starts: &[SearchResult], threads: usize, progress: Progress) -> Result<SearchResult> {
    task.check()?;
    if task.effort.refinement == Refinement::Gradients {
        gradient::check(task)?;
    }
    let threads = if threads == 0 { cores() } else { threads.min(MOST_THREADS) };
    let effort = task.effort;
    let blocks: Vec<usize> = (0..effort.candidates.div_ceil(BLOCK)).collect();
    let (mut kept, mut assembled, mut poses) = (Vec::new(), 0, [0; 2]);
    let rounds = blocks.chunks(ROUND);
    let count = rounds.len();
    for (round, blocks) in rounds.enumerate() {
        let found = made(blocks, threads, |&block| Random::new(task).block(block), |_| {});
        for block in found {
            kept.extend(block.best);
            assembled += block.assembled;
            poses[0] += block.poses;
        }
        keep(&mut kept, effort.refined);
        progress(RANDOM_SHARE * (round + 1) as f64 / count as f64);
    }
    let random_cost = kept.first().map_or(f64::NAN, |best| best.cost);
    let start = |(index, start): (usize, &SearchResult)| Candidate {
        shares: start.values.iter().zip(&task.variables).map(|(value, variable)| share_of(*value, variable)).collect(),
        forward: start.forward,
        cost: f64::INFINITY,
        number: effort.candidates + index,
        poses: 0,
    };
    kept.extend(starts.iter().enumerate().map(start));
    let refine = |candidate: &Candidate| match effort.refinement {
        Refinement::Evolution => refine::refine(task, candidate),
        Refinement::Gradients => gradient::refine(task, candidate),
    };
    let mut refined = Vec::new();
    let total = kept.len();
    for chunk in kept.chunks(ROUND) {
        refined.extend(made(chunk, threads, refine, |_| {}));
        progress(RANDOM_SHARE + (1.0 - RANDOM_SHARE) * refined.len() as f64 / total as f64);
    }
    let count = refined.len();
    poses[1] = refined.iter().map(|candidate| candidate.poses).sum();
    keep(&mut refined, count);
    let Some(best) = refined.iter().find(|candidate| holds(task, candidate)) else { return Err(none(task)) };
    Ok(SearchResult {
        values: values(task, &best.shares),
        forward: best.forward,
        cost: best.cost,
        random_cost,
        candidates: [effort.candidates, assembled],
        refined: refined.iter().map(|candidate| candidate.cost).collect(),
        poses,
    })
}

/// Whether a candidate with rounded dimensions can be followed over the whole turn, in the fine steps that are used to
/// measure results.
/// In larger steps, a higher group may change its branch unnoticed.
fn holds(task: &Task, candidate: &Candidate) -> bool {
    let values = round_values(task, &values(task, &candidate.shares));
    Evaluator::new(task).run(&values, task.zero.value(&values), &fine_turns()).is_ok()
}

fn none(task: &Task) -> Error {
    let message = sentences::none_of_candidates_can_be_assembled(&task.effort.candidates);
    Error::new(ErrorKind::Numeric, message).help(sentences::DRAW_MORE_CANDIDATES_NARROW_THE_BOUNDS)
}

/// Keeps the `count` candidates of lowest cost, in order.
/// Candidates with equal cost are kept in the order in which they were drawn.
fn keep(candidates: &mut Vec<Candidate>, count: usize) {
    candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.number.cmp(&b.number)));
    candidates.truncate(count);
}

/// Result of a block of random candidates.
struct Block {
    /// The best candidates, in order.
    best: Vec<Candidate>,
    /// Number of candidates that assemble and nearly keep the limits.
    assembled: usize,
    /// Number of poses solved.
    poses: u64,
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

    /// Draws the candidates of a block.
    fn block(&mut self, block: usize) -> Block {
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
                best.push(Candidate { shares: shares.clone(), forward, cost, number, poses: 0 });
                keep(&mut best, effort.refined);
            }
        }
        Block { best, assembled, poses: self.evaluator.poses }
    }

    /// Cost of a candidate, and the sense of its output that counts as forward.
    /// If the crank's zero is free, this function also chooses the zero and stores it in `shares`.
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
        let has_phases = !self.task.timing.phases().is_empty();
        if has_phases && !(span > 0.0 && is_near) || !(NEAR * sine >= self.task.transmission.sin()) {
            return None;
        }
        let missed: f64 = self.task.points.all().iter().map(|point| self.missed(point)).sum();
        let excess = missed + self.rater.excess(self.task, sine, acceleration);
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

    /// Sum of the squared deviations from a precision point, in the row nearest to the point's crank angle. If this
    /// crank angle is free, the row with the smallest sum is taken.
    fn missed(&self, point: &PrecisionPoint) -> f64 {
        let at = |row: usize| {
            let (place, angle) = self.evaluator.position(row);
            self.task.points.squared_deviation(point, place, angle)
        };
        match point.turn {
            Some(turn) => at((turn.rem_euclid(TAU) / TAU * COARSE as f64).round() as usize),
            None => (0..COARSE).map(at).fold(f64::INFINITY, f64::smaller),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_candidates_are_kept_in_the_order_of_drawing() {
        let candidate = |cost, number| Candidate { shares: Vec::new(), forward: 1.0, cost, number, poses: 0 };
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
