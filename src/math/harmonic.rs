//! Zeros of trigonometric polynomials: all of them, by eigenvalues.

use nalgebra::{Complex, DMatrix, linalg::Schur};
use std::f64::consts::TAU;

/// Roots farther than this from the unit circle are not angles. Rounding moves a simple root by far less; the two roots of a
/// pair that nearly touches move by up to the square root of it, and Newton then decides.
const ON_CIRCLE: f64 = 1e-4;
/// Zeros nearer to each other than this (rad) are one that touches: rounding splits such a zero by the square root of epsilon.
const APART: f64 = 1e-6;
/// A polished zero is one where the polynomial is below this share of its largest coefficient.
const ZERO: f64 = 1e-11;

/// Real zeros in [0, 2 pi) of the trigonometric polynomial of degree `degree` that equals `f`, in ascending order.
///
/// The coefficients c_k of sum c_k z^k, z = e^(i x), follow from 2 `degree` + 2 equally spaced values; the zeros are the eigenvalues of the
/// companion matrix of z^degree f that lie on the unit circle, polished by Newton's method. Touching zeros count once.
/// Returns `None` if `f` vanishes identically or is not finite.
pub fn zeros(degree: usize, f: impl Fn(f64) -> f64) -> Option<Vec<f64>> {
    let coefficients = coefficients(degree, f);
    let largest = coefficients.iter().map(|c| c.norm()).fold(0.0, f64::max);
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    // Leading coefficients that are rounding would send roots to infinity (and, by symmetry, to zero).
    let strip = coefficients.iter().take_while(|c| c.norm() <= 1e-14 * largest).count().min(degree);
    let inner = &coefficients[strip..coefficients.len() - strip];
    if inner.len() < 3 {
        return Some(Vec::new());
    }
    let roots = Schur::try_new(companion(inner), f64::EPSILON, 10_000)?.eigenvalues()?;
    let mut found: Vec<f64> = Vec::new();
    for root in roots.iter().filter(|root| (root.norm() - 1.0).abs() < ON_CIRCLE) {
        if let Some(x) = polish(&coefficients, root.arg(), ZERO * largest) {
            let x = x.rem_euclid(TAU);
            let apart = |y: &f64| (x - y).abs().min(TAU - (x - y).abs()) > APART;
            if found.iter().all(apart) {
                found.push(x);
            }
        }
    }
    found.sort_by(f64::total_cmp);
    Some(found)
}

/// c_k for k from -degree to degree.
fn coefficients(degree: usize, f: impl Fn(f64) -> f64) -> Vec<Complex<f64>> {
    let count = 2 * degree + 2;
    let values: Vec<f64> = (0..count).map(|j| f(TAU * j as f64 / count as f64)).collect();
    let coefficient = |k: i64| {
        let term = |(j, &value): (usize, &f64)| {
            // The product is reduced before it becomes an angle: no digits are lost.
            let turn = (k * j as i64).rem_euclid(count as i64) as f64 / count as f64;
            Complex::from_polar(value / count as f64, -TAU * turn)
        };
        values.iter().enumerate().map(term).sum()
    };
    (-(degree as i64)..=degree as i64).map(coefficient).collect()
}

/// Companion matrix of the polynomial with the given coefficients, lowest power first.
fn companion(coefficients: &[Complex<f64>]) -> DMatrix<Complex<f64>> {
    let n = coefficients.len() - 1;
    DMatrix::from_fn(n, n, |row, column| {
        if column == n - 1 {
            -coefficients[row] / coefficients[n]
        } else if row == column + 1 {
            Complex::new(1.0, 0.0)
        } else {
            Complex::new(0.0, 0.0)
        }
    })
}

/// Newton's method from `x`; `None` if it does not end in a zero near by.
fn polish(coefficients: &[Complex<f64>], start: f64, small: f64) -> Option<f64> {
    let degree = (coefficients.len() / 2) as f64;
    let mut x = start;
    let mut value = f64::INFINITY;
    for _ in 0..60 {
        let (mut f, mut slope) = (0.0, 0.0);
        for (index, c) in coefficients.iter().enumerate() {
            let k = index as f64 - degree;
            let term = c * Complex::from_polar(1.0, k * x);
            f += term.re;
            slope -= k * term.im;
        }
        value = f.abs();
        let step = f / slope;
        if !step.is_finite() || step.abs() < 1e-16 {
            break;
        }
        x -= step;
    }
    (value <= small && (x - start).abs() < 0.1).then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn simple_and_touching_zeros() {
        let found = zeros(1, |x| x.cos() - 0.5).unwrap();
        assert!((found[0] - TAU / 6.0).abs() < 1e-14 && (found[1] - 5.0 * TAU / 6.0).abs() < 1e-14 && found.len() == 2);
        assert_eq!(zeros(1, |x| x.cos() - 1.5).unwrap(), [0.0; 0]);
        let touching = zeros(2, |x| (x.cos() - 1.0) * (x.sin() - 0.3)).unwrap();
        assert_eq!(touching.len(), 3, "{touching:?}");
        assert!(zeros(3, |_| 0.0).is_none());
        assert!(zeros(3, |_| f64::NAN).is_none());
    }

    proptest! {
        #[test]
        fn as_many_as_a_dense_scan_finds(c in prop::collection::vec(-1.0f64..1.0, 7)) {
            let f = |x: f64| c[0] + c[1] * x.cos() + c[2] * x.sin() + c[3] * (2.0 * x).cos() + c[4] * (2.0 * x).sin()
                + c[5] * (3.0 * x).cos() + c[6] * (3.0 * x).sin();
            let found = zeros(3, f).unwrap();
            for x in &found {
                prop_assert!(f(*x).abs() < 1e-11);
            }
            let n = 20_000;
            let value = |k: usize| f(TAU * k as f64 / n as f64);
            let changes = (0..n).filter(|&k| value(k) * value(k + 1) < 0.0).count();
            // Between two sign changes closer than the scan's spacing only the scan can be wrong.
            prop_assert!(found.len() >= changes && found.len() - changes <= 2 && (found.len() - changes) % 2 == 0);
        }
    }
}
