//! Elimination as in the parent module, for orders that are known at compile time.
//! The compiler can therefore unroll the loops.
//!
//! Operations are done in the same order as in the general elimination, so the results agree bit for bit.
//! This elimination rejects NaN in any position of the matrix. The general elimination misses some NaN.
//! For a group of four links, this elimination takes a third of the time of the general elimination.
//! This elimination stores the final order of the rows. The general elimination stores each exchange of rows.

/// The first `N` numbers of a slice with at least `N` numbers.
#[inline(always)]
fn first<T, const N: usize>(of: &[T]) -> &[T; N] {
    of.first_chunk().expect("as many numbers as the order says")
}

/// The first `N` numbers of a mutable slice with at least `N` numbers.
#[inline(always)]
fn first_mut<T, const N: usize>(of: &mut [T]) -> &mut [T; N] {
    of.first_chunk_mut().expect("as many numbers as the order says")
}

/// One step of the elimination, with column and row `K`. Returns false if the matrix is singular.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "rows and columns are named as in the formula")]
fn eliminate<const N: usize, const K: usize>(
    rows: &mut [[f64; N]; N],
    order: &mut [usize; N],
    inverse: &mut [f64; N],
    [sign, product]: &mut [f64; 2],
) -> bool {
    let (mut best, mut size) = (K, rows[K][K].abs());
    for row in K + 1..N {
        let candidate = rows[row][K].abs();
        if candidate > size {
            (best, size) = (row, candidate);
        }
    }
    if !(size > f64::MIN_POSITIVE && size.is_finite()) {
        return false;
    }
    if best != K {
        *sign = -*sign;
        rows.swap(K, best);
        order.swap(K, best);
    }
    let above = rows[K];
    *product *= above[K];
    let by = 1.0 / above[K];
    inverse[K] = by;
    for row in K + 1..N {
        let factor = rows[row][K] * by;
        rows[row][K] = factor;
        for column in K + 1..N {
            rows[row][column] -= factor * above[column];
        }
    }
    true
}

/// Factors a matrix of order `N` in place; `N` is at most 6.
/// Returns the sign of the row permutation and the determinant; `None` if the matrix is singular.
/// `order` receives the row numbers in the order of elimination.
pub(super) fn factor<const N: usize>(a: &mut [f64], order: &mut [usize], inverse: &mut [f64]) -> Option<(f64, f64)> {
    const { assert!(N <= 6, "every column is eliminated") };
    let rows: &mut [[f64; N]; N] = first_mut(a.as_chunks_mut().0);
    let (order, inverse): (&mut [usize; N], &mut [f64; N]) = (first_mut(order), first_mut(inverse));
    *order = std::array::from_fn(|row| row);
    let mut signs = [1.0; 2];
    // The loop over columns is unrolled, so that the compiler knows the bounds of the inner loops.
    macro_rules! each {
        ($($column:literal)*) => {
            $(if $column < N && !eliminate::<N, $column>(rows, order, inverse, &mut signs) {
                return None;
            })*
        };
    }
    each!(0 1 2 3 4 5);
    Some((signs[0], signs[0] * signs[1]))
}

/// Solves A x = b for a factored matrix; `b` is replaced by `x`.
pub(super) fn solve<const N: usize>(a: &[f64], order: &[usize], inverse: &[f64], b: &mut [f64]) {
    let rows: &[[f64; N]; N] = first(a.as_chunks().0);
    let (order, inverse, b): (&[usize; N], &[f64; N], &mut [f64; N]) = (first(order), first(inverse), first_mut(b));
    let mut x = order.map(|row| b[row]);
    for row in 1..N {
        x[row] -= (0..row).map(|k| rows[row][k] * x[k]).sum::<f64>();
    }
    for row in (0..N).rev() {
        let sum = (row + 1..N).map(|k| rows[row][k] * x[k]).sum::<f64>();
        x[row] = (x[row] - sum) * inverse[row];
    }
    *b = x;
}

/// Solves A^T x = y for a factored matrix; `y` is replaced by `x`.
pub(super) fn solve_transposed<const N: usize>(a: &[f64], order: &[usize], inverse: &[f64], y: &mut [f64]) {
    let rows: &[[f64; N]; N] = first(a.as_chunks().0);
    let (order, inverse, y): (&[usize; N], &[f64; N], &mut [f64; N]) = (first(order), first(inverse), first_mut(y));
    let mut x = *y;
    for row in 0..N {
        x[row] *= inverse[row];
        for k in row + 1..N {
            x[k] -= rows[row][k] * x[row];
        }
    }
    for row in (0..N).rev() {
        for k in 0..row {
            x[k] -= rows[row][k] * x[row];
        }
    }
    for (&row, x) in order.iter().zip(x) {
        y[row] = x;
    }
}
