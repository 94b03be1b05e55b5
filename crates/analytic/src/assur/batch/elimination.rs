//! Linear systems of fixed order for several poses at once, by LU decomposition with partial pivoting.
//!
//! Every pose has its own row order: if a lower row has the larger pivot in one pose, the two rows are exchanged for
//! this pose only.

use super::lanes::{Choice, Lanes, Window};
use pulp::Simd;

/// Factored systems of order `N`.
#[derive(Clone, Copy)]
pub(super) struct Factors<S: Simd, const N: usize> {
    rows: [[Lanes<S>; N]; N],
    /// Inverses of the diagonal.
    inverse: [Lanes<S>; N],
    /// For each step k, in order: the poses in which row k was exchanged with a lower row.
    exchanges: [[Choice<S>; N]; N],
    pub(super) determinant: Lanes<S>,
}

/// Number of columns in the working memory for the factors of a system of order `n`.
pub(super) const fn columns(n: usize) -> usize {
    n * n + n + n * (n - 1) / 2
}

impl<S: Simd, const N: usize> Factors<S, N> {
    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "rows and columns are named as in the formula")]
    pub(super) fn of(mut rows: [[Lanes<S>; N]; N], one: Lanes<S>) -> Self {
        let (mut determinant, mut inverse, mut exchanges) = (one, [one; N], [[one.exceeds(one); N]; N]);
        for k in 0..N {
            for row in k + 1..N {
                let exchange = rows[row][k].abs().exceeds(rows[k][k].abs());
                for column in 0..N {
                    (rows[k][column], rows[row][column]) = exchange.exchanged(rows[k][column], rows[row][column]);
                }
                determinant = exchange.of(-determinant, determinant);
                exchanges[k][row] = exchange;
            }
            determinant = determinant * rows[k][k];
            inverse[k] = rows[k][k].inverse();
            for row in k + 1..N {
                let factor = rows[row][k] * inverse[k];
                rows[row][k] = factor;
                for column in k + 1..N {
                    rows[row][column] = rows[row][column] - rows[k][column] * factor;
                }
            }
        }
        Factors { rows, inverse, exchanges, determinant }
    }

    /// Solves A x = b.
    #[inline(always)]
    pub(super) fn solve(&self, b: [Lanes<S>; N]) -> [Lanes<S>; N] {
        let mut x = b;
        for k in 0..N {
            for row in k + 1..N {
                (x[k], x[row]) = self.exchanges[k][row].exchanged(x[k], x[row]);
            }
        }
        for row in 1..N {
            for k in 0..row {
                x[row] = x[row] - self.rows[row][k] * x[k];
            }
        }
        for row in (0..N).rev() {
            for k in row + 1..N {
                x[row] = x[row] - self.rows[row][k] * x[k];
            }
            x[row] = x[row] * self.inverse[row];
        }
        x
    }

    /// Solves A^T x = b.
    #[inline(always)]
    pub(super) fn solve_transposed(&self, b: [Lanes<S>; N]) -> [Lanes<S>; N] {
        let mut x = b;
        for row in 0..N {
            x[row] = x[row] * self.inverse[row];
            for k in row + 1..N {
                x[k] = x[k] - self.rows[row][k] * x[row];
            }
        }
        for row in (0..N).rev() {
            for k in 0..row {
                x[k] = x[k] - self.rows[row][k] * x[row];
            }
        }
        for k in (0..N).rev() {
            for row in (k + 1..N).rev() {
                (x[k], x[row]) = self.exchanges[k][row].exchanged(x[k], x[row]);
            }
        }
        x
    }

    /// Writes the factors to the working memory, from `column` on.
    #[inline(always)]
    pub(super) fn keep(&self, work: Window<S>, mut column: usize) {
        let mut put = |lanes: Lanes<S>| {
            work.put(column, lanes);
            column += 1;
        };
        let (one, zero) = (Lanes::splat(self.determinant.on, 1.0), Lanes::splat(self.determinant.on, 0.0));
        for k in 0..N {
            self.rows[k].into_iter().for_each(&mut put);
            put(self.inverse[k]);
            for row in k + 1..N {
                put(self.exchanges[k][row].of(one, zero));
            }
        }
    }

    /// Reads the factors from the working memory. The determinant is not stored, so the determinant of the result has
    /// no meaning.
    #[inline(always)]
    pub(super) fn kept(work: Window<S>, mut column: usize) -> Self {
        let (one, zero) = (Lanes::splat(work.on, 1.0), Lanes::splat(work.on, 0.0));
        let none = zero.exceeds(one);
        let mut factors =
            Factors { rows: [[one; N]; N], inverse: [one; N], exchanges: [[none; N]; N], determinant: one };
        let mut get = || {
            column += 1;
            work.get(column - 1)
        };
        for k in 0..N {
            for entry in &mut factors.rows[k] {
                *entry = get();
            }
            factors.inverse[k] = get();
            for row in k + 1..N {
                factors.exchanges[k][row] = get().exceeds(zero);
            }
        }
        factors
    }
}
