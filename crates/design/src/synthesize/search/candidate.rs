//! A candidate of the search, and the conversion from fractions of the bounds to dimensions.

use std::f64::consts::TAU;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::Rng;

use crate::synthesize::task::{Task, TaskNumber, Variable};
use linkage::mechanism::GroupKind;

/// A candidate and its cost.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Candidate {
    /// The variables as fractions of the ranges between their bounds: 0 is the lower bound, 1 the upper bound.
    pub(super) shares: Vec<f64>,
    /// Sense of the output that counts as forward: +1 or -1.
    pub(super) forward: f64,
    pub(super) cost: f64,
    /// Number of the candidate. Of two candidates with equal cost, the one with the lower number is kept.
    pub(super) number: usize,
}

/// A number from 0 to 1: the upper 53 bits of a random draw.
pub(super) fn even(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// Values (SI) of variables that are given as fractions of the ranges between their bounds.
pub(super) fn values(task: &Task, shares: &[f64]) -> Vec<f64> {
    let value = |(share, variable): (&f64, &Variable)| of_share(*share, variable);
    shares.iter().zip(&task.variables).map(value).collect()
}

#[inline]
pub(super) fn of_share(share: f64, variable: &Variable) -> f64 {
    let [low, high] = variable.bounds;
    low + share * (high - low)
}

/// The variable that is the crank's zero, if its bounds span a full turn and there is no higher group.
/// This variable is periodic, because it only shifts the motion along the crank angle.
pub(super) fn free_zero(task: &Task) -> Option<usize> {
    let TaskNumber::Free(index) = task.zero else { return None };
    let [low, high] = task.variables[index].bounds;
    let closed_form = task.case.structure.groups.iter().all(|group| group.kind != GroupKind::Higher);
    (closed_form && (high - low - TAU).abs() < 1e-9).then_some(index)
}
