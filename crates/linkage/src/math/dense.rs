//! Dense linear systems. The systems are factored in place, repeatedly and without allocation.

mod fixed;

/// Square system A x = b, solved by LU decomposition with partial pivoting. The storage is reused between poses.
///
/// nalgebra's LU takes its matrix by value, so it would allocate in every pose. nalgebra's LU also cannot solve with
/// the transpose.
#[derive(Clone, Debug)]
pub struct Lu {
    n: usize,
    a: Vec<f64>,
    /// Row exchanges. The general elimination stores the row with which each row was exchanged.
    /// For matrices of order 4 and 6, the original index of each row of the factored matrix is stored.
    pivot: Vec<usize>,
    /// Reciprocals of the diagonal entries of the factored matrix.
    inverse: Vec<f64>,
    swap_sign: f64,
    determinant: f64,
}

impl Lu {
    /// Storage for `n` equations. All coefficients are zero.
    #[must_use]
    pub fn new(n: usize) -> Self {
        Lu { n, a: vec![0.0; n * n], pivot: vec![0; n], inverse: vec![0.0; n], swap_sign: 1.0, determinant: f64::NAN }
    }

    /// Sets all coefficients to zero, ready for the next matrix.
    #[inline]
    pub fn clear(&mut self) {
        self.a.fill(0.0);
    }

    /// Adds `value` to the coefficient in `row`, `column`.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.a[row * self.n + column] += value;
    }

    /// The coefficients of the row `row` and of the next row.
    #[inline]
    pub fn pair_mut(&mut self, row: usize) -> (&mut [f64], &mut [f64]) {
        self.a[row * self.n..][..2 * self.n].split_at_mut(self.n)
    }

    /// Factors the matrix in place. Returns false if the matrix is singular to working precision, or not finite.
    #[must_use]
    pub fn factor(&mut self) -> bool {
        let Lu { n, a, pivot, inverse, swap_sign, determinant } = self;
        let found = match n {
            4 => fixed::factor::<4>(a, pivot, inverse),
            6 => fixed::factor::<6>(a, pivot, inverse),
            _ => factor(a, pivot, inverse),
        };
        (*swap_sign, *determinant) = found.unwrap_or((1.0, f64::NAN));
        found.is_some()
    }

    /// Determinant of the factored matrix.
    #[inline]
    #[must_use]
    pub fn determinant(&self) -> f64 {
        self.determinant
    }

    /// Pivots of the factored matrix in the order of elimination.
    /// The product of the pivots is the determinant, except for the sign.
    pub fn pivots(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.n).map(|k| self.a[k * self.n + k])
    }

    /// Sign of the determinant of the factored matrix, +1 or -1. The sign is correct even if the determinant
    /// underflows.
    #[must_use]
    pub fn determinant_sign(&self) -> f64 {
        (0..self.n).fold(self.swap_sign, |sign, k| sign * self.a[k * self.n + k].signum())
    }

    /// Solves A x = b for the factored matrix; `b` is replaced by `x`.
    pub fn solve(&self, b: &mut [f64]) {
        match self.n {
            4 => fixed::solve::<4>(&self.a, &self.pivot, &self.inverse, b),
            6 => fixed::solve::<6>(&self.a, &self.pivot, &self.inverse, b),
            _ => solve(&self.a, &self.pivot, &self.inverse, b),
        }
    }

    /// Solves A^T x = y for the factored matrix; `y` is replaced by `x`.
    pub fn solve_transposed(&self, y: &mut [f64]) {
        match self.n {
            4 => fixed::solve_transposed::<4>(&self.a, &self.pivot, &self.inverse, y),
            6 => fixed::solve_transposed::<6>(&self.a, &self.pivot, &self.inverse, y),
            _ => solve_transposed(&self.a, &self.pivot, &self.inverse, y),
        }
    }
}

/// Factors a matrix of any order in place. Returns the sign of the row permutation, and the determinant; `None` if the
/// matrix is singular.
fn factor(a: &mut [f64], pivots: &mut [usize], inverse: &mut [f64]) -> Option<(f64, f64)> {
    let n = pivots.len();
    let (mut sign, mut product) = (1.0, 1.0);
    for k in 0..n {
        let (mut best, mut size) = (k, a[k * n + k].abs());
        for (row, entries) in a.chunks_exact(n).enumerate().skip(k + 1) {
            let candidate = entries[k].abs();
            if candidate > size {
                (best, size) = (row, candidate);
            }
        }
        pivots[k] = best;
        if !(size > f64::MIN_POSITIVE && size.is_finite()) {
            return None;
        }
        let (above, below) = a.split_at_mut((k + 1) * n);
        let pivot = &mut above[k * n..];
        if best != k {
            sign = -sign;
            pivot.swap_with_slice(&mut below[(best - k - 1) * n..(best - k) * n]);
        }
        product *= pivot[k];
        inverse[k] = 1.0 / pivot[k];
        for entries in below.chunks_exact_mut(n) {
            let factor = entries[k] * inverse[k];
            entries[k] = factor;
            if factor != 0.0 {
                for (entry, above) in entries[k + 1..].iter_mut().zip(&pivot[k + 1..]) {
                    *entry -= factor * above;
                }
            }
        }
    }
    Some((sign, sign * product))
}

fn solve(a: &[f64], pivots: &[usize], inverse: &[f64], b: &mut [f64]) {
    let n = pivots.len();
    for (k, &pivot) in pivots.iter().enumerate() {
        b.swap(k, pivot);
    }
    for (row, entries) in a.chunks_exact(n).enumerate().skip(1) {
        let (known, rest) = b.split_at_mut(row);
        rest[0] -= entries.iter().zip(known).map(|(a, x)| a * *x).sum::<f64>();
    }
    for (row, entries) in a.chunks_exact(n).enumerate().rev() {
        let (rest, known) = b.split_at_mut(row + 1);
        let sum: f64 = entries[row + 1..].iter().zip(known).map(|(a, x)| a * *x).sum();
        rest[row] = (rest[row] - sum) * inverse[row];
    }
}

fn solve_transposed(a: &[f64], pivots: &[usize], inverse: &[f64], y: &mut [f64]) {
    let n = pivots.len();
    // Forward substitution: each solved unknown is subtracted from all later rows.
    for (row, entries) in a.chunks_exact(n).enumerate() {
        let (solved, rest) = y[row..].split_first_mut().expect("as many numbers as rows");
        *solved *= inverse[row];
        for (y, a) in rest.iter_mut().zip(&entries[row + 1..]) {
            *y -= a * *solved;
        }
    }
    for (row, entries) in a.chunks_exact(n).enumerate().rev() {
        let (rest, solved) = y.split_at_mut(row);
        for (y, a) in rest.iter_mut().zip(entries) {
            *y -= a * solved[0];
        }
    }
    for (k, &pivot) in pivots.iter().enumerate().rev() {
        y.swap(k, pivot);
    }
}

/// Solves two equations A x = b by elimination with partial pivoting.
/// Returns `None` if A is singular to working precision, or not finite.
/// The method is the same as in [`Lu`], but without loops.
/// This function is called often, and loops would cost more than the arithmetic.
#[inline]
#[must_use]
pub fn solve_pair(a: [[f64; 2]; 2], b: [f64; 2]) -> Option<[f64; 2]> {
    let usable = |pivot: f64| pivot.abs() > f64::MIN_POSITIVE && pivot.is_finite();
    let (first, second) = if a[1][0].abs() > a[0][0].abs() { (1, 0) } else { (0, 1) };
    let pivot = a[first][0];
    let factor = a[second][0] / pivot;
    let rest = a[second][1] - factor * a[first][1];
    if !(usable(pivot) && usable(rest)) {
        return None;
    }
    let y = (b[second] - factor * b[first]) / rest;
    Some([(b[first] - a[first][1] * y) / pivot, y])
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn agrees_with_nalgebra(values in prop::collection::vec(-1.0f64..1.0, 36), rhs in prop::collection::vec(-1.0f64..1.0, 6)) {
            let matrix = DMatrix::from_row_slice(6, 6, &values);
            let condition = matrix.clone().svd(false, false).singular_values;
            prop_assume!(condition.min() > 1e-6);
            let mut lu = Lu::new(6);
            for row in 0..6 {
                for column in 0..6 {
                    lu.add(row, column, matrix[(row, column)]);
                }
            }
            prop_assert!(lu.factor());
            prop_assert_eq!(lu.determinant_sign(), matrix.determinant().signum());
            prop_assert!((lu.determinant() - matrix.determinant()).abs() <= 1e-13);
            let b = DVector::from_vec(rhs);
            let bound = 1e-13 * condition.max() / condition.min() * b.norm() / condition.min();
            let (mut x, mut y) = (b.as_slice().to_vec(), b.as_slice().to_vec());
            lu.solve(&mut x);
            lu.solve_transposed(&mut y);
            prop_assert!((DVector::from_vec(x) - matrix.clone().lu().solve(&b).unwrap()).norm() <= bound);
            prop_assert!((DVector::from_vec(y) - matrix.transpose().lu().solve(&b).unwrap()).norm() <= bound);
        }
    }

    proptest! {
        /// The tested matrices include singular and non-finite ones.
        #[test]
        fn fixed_and_variable_sizes_give_the_same_bits(
            values in prop::collection::vec(-4i8..5, 36),
            small in prop::bool::ANY,
            odd in -1.0f64..1.0,
        ) {
            fn compare<const N: usize>(values: &[f64]) -> std::result::Result<(), TestCaseError> {
                let (mut any, mut pivots, mut inverse) = (values[..N * N].to_vec(), vec![0; N], vec![0.0; N]);
                let (mut own, mut own_pivots, mut own_inverse) = (any.clone(), pivots.clone(), inverse.clone());
                let sign = factor(&mut any, &mut pivots, &mut inverse);
                prop_assert_eq!(sign, fixed::factor::<N>(&mut own, &mut own_pivots, &mut own_inverse));
                if sign.is_some() {
                    let bits = |x: &[f64]| x.iter().map(|x| (x + 0.0).to_bits()).collect::<Vec<_>>();
                    let (mut x, mut y) = (values[..N].to_vec(), values[..N].to_vec());
                    solve(&any, &pivots, &inverse, &mut x);
                    fixed::solve::<N>(&own, &own_pivots, &own_inverse, &mut y);
                    prop_assert_eq!(bits(&x), bits(&y));
                    solve_transposed(&any, &pivots, &inverse, &mut x);
                    fixed::solve_transposed::<N>(&own, &own_pivots, &own_inverse, &mut y);
                    prop_assert_eq!(bits(&x), bits(&y));
                }
                Ok(())
            }
            let mut values: Vec<f64> = values.iter().map(|&value| f64::from(value)).collect();
            if !small {
                values.iter_mut().zip(1..).for_each(|(value, k)| *value += odd * f64::from(k).sin());
            }
            compare::<4>(&values)?;
            compare::<6>(&values)?;
            // The elimination of fixed order must reject a NaN.
            // The general elimination is not tested with a NaN, because the general elimination misses a NaN that is
            // multiplied by zero.
            values[7] = f64::NAN;
            let (mut own, mut pivots, mut inverse) = (values[..16].to_vec(), [0; 4], [0.0; 4]);
            prop_assert!(fixed::factor::<4>(&mut own, &mut pivots, &mut inverse).is_none());
        }
    }

    proptest! {
        #[test]
        fn a_system_of_two_is_solved_as_by_lu(a in prop::array::uniform4(-1.0f64..1.0), b in prop::array::uniform2(-1.0f64..1.0)) {
            let mut lu = Lu::new(2);
            (0..4).for_each(|k| lu.add(k / 2, k % 2, a[k]));
            prop_assert!(lu.factor());
            let (mut known, scale) = (b, 1.0 / lu.determinant().abs());
            lu.solve(&mut known);
            let found = solve_pair([[a[0], a[1]], [a[2], a[3]]], b).unwrap();
            for k in 0..2 {
                prop_assert!((found[k] - known[k]).abs() <= 1e-14 * scale * (1.0 + known[k].abs()), "{found:?} {known:?}");
            }
        }
    }

    #[test]
    fn a_singular_system_of_two_is_refused() {
        for a in [
            [[1.0, 2.0], [2.0, 4.0]],
            [[0.0, 1.0], [0.0, 2.0]],
            [[1.0, f64::NAN], [0.0, 1.0]],
            [[f64::NAN, 0.0], [0.0, 1.0]],
        ] {
            assert_eq!(solve_pair(a, [1.0, 1.0]), None, "{a:?}");
        }
        assert_eq!(solve_pair([[0.0, 2.0], [4.0, 0.0]], [1.0, 1.0]), Some([0.25, 0.5]));
    }

    #[test]
    fn singular_matrix_is_refused() {
        let mut lu = Lu::new(2);
        for (row, column, value) in [(0, 0, 1.0), (0, 1, 2.0), (1, 0, 2.0), (1, 1, 4.0)] {
            lu.add(row, column, value);
        }
        assert!(!lu.factor());
    }

    #[test]
    fn nan_is_refused() {
        let mut lu = Lu::new(1);
        lu.add(0, 0, f64::NAN);
        assert!(!lu.factor());
    }
}
