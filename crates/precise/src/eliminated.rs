//! Gaussian elimination for several right-hand sides, and the implementations of `Scalar` for `f64` and `Long`.

use std::f64::consts::TAU;

use super::Long;
use super::scalar::Scalar;

/// A square matrix after the elimination, with the factors of the elimination below the diagonal.
#[derive(Clone, Debug)]
pub struct Eliminated<S> {
    rows: Vec<Vec<S>>,
    /// Entry k is the number of the row that was exchanged with row k.
    pivots: Vec<usize>,
}

impl<S: Scalar> Eliminated<S> {
    /// Eliminates with the largest pivot of each column; `None` if the matrix is singular.
    pub(crate) fn of(mut rows: Vec<Vec<S>>) -> Option<Self> {
        let count = rows.len();
        let mut pivots = Vec::with_capacity(count);
        for k in 0..count {
            let size = |row: &usize| rows[*row][k].value().abs();
            let pivot = (k..count).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            rows.swap(k, pivot);
            pivots.push(pivot);
            let lead = rows[k][k];
            if !(lead.value().abs() > 0.0) {
                return None;
            }
            let (above, below) = rows.split_at_mut(k + 1);
            let own = &above[k];
            for row in below {
                if row[k] == S::ZERO {
                    continue;
                }
                let factor = row[k] / lead;
                row[k] = factor;
                for (entry, own) in row[k + 1..].iter_mut().zip(&own[k + 1..]).filter(|(_, own)| **own != S::ZERO) {
                    *entry = *entry - factor * *own;
                }
            }
        }
        Some(Eliminated { rows, pivots })
    }

    /// The solution with this right-hand side.
    pub(crate) fn solved(&self, right: &[S]) -> Vec<S> {
        let columns: Vec<[S; 1]> = right.iter().map(|own| [*own]).collect();
        self.all_solved(columns).into_iter().map(|[own]| own).collect()
    }

    /// The solutions with several right-hand sides, which are the columns of `right`.
    pub(crate) fn all_solved<const N: usize>(&self, mut right: Vec<[S; N]>) -> Vec<[S; N]> {
        let count = self.rows.len();
        for (k, &pivot) in self.pivots.iter().enumerate() {
            right.swap(k, pivot);
        }
        for k in 0..count {
            let own = right[k];
            for (right, row) in right[k + 1..].iter_mut().zip(&self.rows[k + 1..]) {
                take(right, row[k], &own);
            }
        }
        for k in (0..count).rev() {
            let mut sum = right[k];
            for (right, factor) in right[k + 1..].iter().zip(&self.rows[k][k + 1..]) {
                take(&mut sum, *factor, right);
            }
            right[k] = sum.map(|own| own / self.rows[k][k]);
        }
        right
    }
}

/// Subtracts `factor` times `other` from `from`.
fn take<S: Scalar, const N: usize>(from: &mut [S; N], factor: S, other: &[S; N]) {
    if factor == S::ZERO {
        return;
    }
    for (own, other) in from.iter_mut().zip(other) {
        *own = *own - factor * *other;
    }
}

impl Scalar for f64 {
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;
    const TURN: f64 = TAU;
    const SETTLED: f64 = 1e-14;
    const ROUNDING: f64 = 1e-9;

    type Factors = Eliminated<f64>;

    fn of(value: f64) -> f64 {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn sqrt(self) -> f64 {
        self.sqrt()
    }

    fn sin_cos(self) -> (f64, f64) {
        self.sin_cos()
    }

    fn factors(rows: Vec<Vec<f64>>) -> Option<Eliminated<f64>> {
        Eliminated::of(rows)
    }

    fn solution(factors: &Eliminated<f64>, right: &[f64]) -> Vec<f64> {
        factors.solved(right)
    }
}

impl Scalar for Long {
    const ZERO: Long = Long::ZERO;
    const ONE: Long = Long::ONE;
    const TURN: Long = Long::TURN;
    const SETTLED: f64 = 1e-28;
    const ROUNDING: f64 = 1e-20;

    type Factors = Eliminated<Long>;

    fn of(value: f64) -> Long {
        Long::of(value)
    }

    fn value(self) -> f64 {
        self.rounded()
    }

    fn sqrt(self) -> Long {
        self.sqrt()
    }

    fn sin_cos(self) -> (Long, Long) {
        self.sin_cos()
    }

    fn factors(rows: Vec<Vec<Long>>) -> Option<Eliminated<Long>> {
        Eliminated::of(rows)
    }

    fn solution(factors: &Eliminated<Long>, right: &[Long]) -> Vec<Long> {
        factors.solved(right)
    }
}
