//! All zeros of trigonometric polynomials.
//!
//! If a function has different signs at two neighbouring extrema, one zero lies between the extrema.
//! If the signs are equal, no zero lies between the extrema.
//! The extrema are the zeros of the derivative.
//! The zeros of the derivative are computed from eigenvalues of a matrix.
//! If two zeros nearly coincide, rounding errors move both zeros by the square root of the rounding error.
//! The extremum between two such zeros is still a simple zero of the derivative and therefore accurate.
//! The function's sign at this extremum distinguishes a close pair of zeros from a near miss.

use crate::math::KeepNan;
use nalgebra::{Complex, DMatrix, linalg::Schur};
use std::convert::Infallible;
use std::f64::consts::TAU;

use super::root;

type Coefficients = Vec<Complex<f64>>;

/// A root of the derivative is used only if its distance from the unit circle is at most this limit.
/// A rounding error moves a simple root by about the size of the error.
/// A nearly double root moves by about 1e-8, the square root of the rounding error, times the root's condition number.
/// The limit may be generous, because a superfluous root only adds one more candidate.
const ON_CIRCLE: f64 = 1e-3;
/// A value below this fraction of the argument `scale` counts as zero.
/// The limit is the rounding error of the coefficients, multiplied by a margin of two digits.
const ZERO: f64 = 1e-14;
/// Two zeros closer together than this distance (rad) count as one touching zero.
/// If a parabola of unit curvature has the depth `ZERO` between its zeros, the zeros have about this distance.
const APART: f64 = 1e-7;

/// Real zeros in [0, 2 pi), in ascending order, of the trigonometric polynomial that equals `f`.
/// The degree of the polynomial is at most `degree` (1 or more).
/// `scale` is the order of magnitude of the terms whose sum is `f`. The limit for rounding errors is proportional to
/// `scale`.
/// A touching zero counts once. Leading coefficients may be zero.
///
/// Returns `None` if `f` is not finite, or zero everywhere up to rounding error.
pub fn zeros(degree: usize, scale: f64, f: impl Fn(f64) -> f64) -> Option<Vec<f64>> {
    let coefficients = coefficients(degree, f);
    let largest = coefficients.iter().map(|c| c.norm()).fold(0.0, f64::larger);
    // If `f` returns NaN, every coefficient is NaN. This test rejects coefficients that are NaN or infinite.
    if !(coefficients.iter().all(|c| c.norm().is_finite()) && largest > ZERO * scale) {
        return None;
    }
    let small = ZERO * scale;
    // Additional equally spaced positions. With these positions, the zeros next to a missed extremum are still found.
    let even = (0..4 * degree).map(|k| TAU * (k as f64 + 0.37) / (4 * degree) as f64);
    let mut places: Vec<f64> = extrema(&coefficients)?.into_iter().chain(even).collect();
    places.sort_by(f64::total_cmp);
    let value = |x: f64| evaluate(&coefficients, x).0;
    let mut found: Vec<f64> = Vec::new();
    for (index, &from) in places.iter().enumerate() {
        let to = places.get(index + 1).copied().unwrap_or(places[0] + TAU);
        let ends = [value(from), value(to)];
        if ends[0].abs() <= small {
            // Neighbouring positions with zero values belong to one multiple zero. Only the first position is recorded.
            let before = places[(index + places.len() - 1) % places.len()];
            if value(before).abs() > small {
                found.push(from);
            }
        } else if ends[1].abs() > small && (ends[0] > 0.0) != (ends[1] > 0.0) {
            found.push(between(&coefficients, from, to));
        }
    }
    found.iter_mut().for_each(|x| *x = x.rem_euclid(TAU));
    found.sort_by(f64::total_cmp);
    found.dedup_by(|x, y| (*x - *y).abs() <= APART);
    if found.len() > 1 && found[0] + TAU - found[found.len() - 1] <= APART {
        found.pop();
    }
    Some(found)
}

/// The Fourier coefficients c_k for k from -`degree` to `degree`, computed from 2 `degree` + 2 equally spaced values of
/// `f`.
fn coefficients(degree: usize, f: impl Fn(f64) -> f64) -> Coefficients {
    let count = 2 * degree + 2;
    let values: Vec<f64> = (0..count).map(|j| f(TAU * j as f64 / count as f64)).collect();
    let coefficient = |k: i64| {
        let term = |(j, &value): (usize, &f64)| {
            // The product k j is first reduced modulo one period and then converted to an angle.
            // No digits are lost if the reduction comes first.
            let turn = (k * j as i64).rem_euclid(count as i64) as f64 / count as f64;
            Complex::from_polar(value / count as f64, -TAU * turn)
        };
        values.iter().enumerate().map(term).sum()
    };
    (-(degree as i64)..=degree as i64).map(coefficient).collect()
}

/// Value and slope of the polynomial at `x`.
fn evaluate(coefficients: &[Complex<f64>], x: f64) -> (f64, f64) {
    let degree = coefficients.len() / 2;
    let (mut value, mut slope) = (coefficients[degree].re, 0.0);
    for k in 1..=degree {
        let term = coefficients[degree + k] * Complex::from_polar(2.0, k as f64 * x);
        value += term.re;
        slope -= k as f64 * term.im;
    }
    (value, slope)
}

/// Positions of the extrema in [0, 2 pi). The list is empty for a constant function.
fn extrema(coefficients: &[Complex<f64>]) -> Option<Vec<f64>> {
    let degree = (coefficients.len() / 2) as f64;
    let slope = |(index, c): (usize, &Complex<f64>)| c * Complex::new(0.0, index as f64 - degree);
    let derivative: Coefficients = coefficients.iter().enumerate().map(slope).collect();
    if derivative.iter().all(|c| c.norm() == 0.0) {
        return Some(Vec::new());
    }
    let near = roots(&derivative)?.into_iter().filter(|found| (found.norm() - 1.0).abs() < ON_CIRCLE);
    let polished = near.map(|found| {
        let (mut best, mut least) = (found.arg(), f64::INFINITY);
        // Near a multiple root Newton's method may diverge.
        // The iterate with the smallest slope of the function is therefore kept.
        let Ok(_) = root::polished(found.arg(), 5, f64::INFINITY, |x| {
            let (value, slope) = evaluate(&derivative, x);
            if value.abs() < least && (x - found.arg()).abs() < ON_CIRCLE {
                (best, least) = (x, value.abs());
            }
            Ok::<_, Infallible>((value, slope))
        });
        best.rem_euclid(TAU)
    });
    Some(polished.collect())
}

/// The single zero between two positions with different signs of the polynomial.
/// Newton's method finds this zero. If a step would leave the interval, bisection replaces the step.
fn between(coefficients: &[Complex<f64>], from: f64, to: f64) -> f64 {
    let rises = evaluate(coefficients, to).0 > 0.0;
    let middle = f64::midpoint(from, to);
    let value = |x: f64| Ok::<_, Infallible>(evaluate(coefficients, x));
    let Ok(found) = root::newton([from, to], rises, middle, 2.0 * f64::EPSILON, value);
    found.expect("coefficients are finite, and so are the values")
}

/// Roots of the polynomial with the given coefficients, lowest power first.
/// If n is the degree, the coefficients must satisfy c_(n-k) = conj(c_k) for all k, or c_(n-k) = -conj(c_k) for all k.
/// The roots of such a polynomial come in pairs z, 1 / conj(z).
///
/// The map z = (w + a) / (1 + conj(a) w), |a| < 1, preserves the unit circle.
/// Zero leading coefficients correspond to roots at infinity. The map moves these roots to -1 / conj(a).
/// The leading coefficient of the mapped polynomial has the magnitude of the original polynomial at a.
/// The number a is chosen so that the polynomial's value at a is large. The companion matrix is then well scaled.
fn roots(polynomial: &[Complex<f64>]) -> Option<Vec<Complex<f64>>> {
    let n = polynomial.len() - 1;
    let value = |a: Complex<f64>| polynomial.iter().rev().fold(Complex::new(0.0, 0.0), |sum, c| sum * a + c).norm();
    // The candidates for a outnumber the roots by one, so at least one candidate is far from all roots.
    let candidates = (0..n + 1).map(|k| Complex::from_polar(0.5, TAU * k as f64 / (n + 1) as f64));
    let a = candidates.max_by(|&a, &b| value(a).total_cmp(&value(b)))?;
    let mut mapped = vec![Complex::new(0.0, 0.0); n + 1];
    for (power, c) in polynomial.iter().enumerate() {
        let mut product = vec![*c];
        for factor in 0..n {
            let [constant, linear] = if factor < power { [a, 1.0.into()] } else { [1.0.into(), a.conj()] };
            let mut longer = vec![Complex::new(0.0, 0.0); product.len() + 1];
            for (k, c) in product.iter().enumerate() {
                longer[k] += c * constant;
                longer[k + 1] += c * linear;
            }
            product = longer;
        }
        mapped.iter_mut().zip(product).for_each(|(sum, c)| *sum += c);
    }
    let all = Schur::try_new(companion(&mapped), f64::EPSILON, 10_000)?.eigenvalues()?;
    Some(all.iter().map(|w| (w + a) / (a.conj() * w + 1.0)).collect())
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn simple_and_touching_zeros() {
        let found = zeros(1, 1.0, |x| x.cos() - 0.5).unwrap();
        assert!((found[0] - TAU / 6.0).abs() < 1e-14 && (found[1] - 5.0 * TAU / 6.0).abs() < 1e-14 && found.len() == 2);
        assert_eq!(zeros(1, 1.0, |x| x.cos() - 1.5).unwrap(), [0.0; 0]);
        let touching = zeros(2, 1.0, |x| (x.cos() - 1.0) * (x.sin() - 0.3)).unwrap();
        assert_eq!(touching.len(), 3, "{touching:?}");
        assert_eq!(zeros(2, 1.0, |_| 1.0).unwrap(), [0.0; 0]);
        assert!(zeros(3, 1.0, |_| 0.0).is_none());
        assert!(zeros(3, 1.0, |x| 1e-16 * x.cos()).is_none());
        assert!(zeros(3, 1.0, |_| f64::NAN).is_none());
        assert!(zeros(3, 1.0, |x| if x > 5.0 { f64::NAN } else { x.cos() }).is_none());
    }

    /// Between two zeros at the distance d, a parabola of unit curvature has the depth d^2 / 8.
    /// The method distinguishes the two zeros from a near miss if this depth is above `ZERO`.
    #[test]
    fn a_close_pair_is_distinguished_from_a_near_miss() {
        for d in [1e-2, 1e-4, 1e-6] {
            let pair = |sign: f64| move |x: f64| ((x - 1.0).cos() - 1.0 + sign * d * d / 8.0) * (2.0 + (3.0 * x).sin());
            let found = zeros(4, 1.0, pair(1.0)).unwrap();
            assert!(found.len() == 2 && (found[1] - found[0] - d).abs() < 1e-3 * d + 1e-8, "{d}: {found:?}");
            assert_eq!(zeros(4, 1.0, pair(-1.0)).unwrap(), [0.0; 0], "{d}");
        }
    }

    /// If four zeros coincide, the three zeros of the derivative are accurate to a third of the digits.
    /// A third of the digits is enough, because f is flat near the four zeros.
    #[test]
    fn a_fourfold_zero_is_found_once() {
        for k in 0..20 {
            let at = 0.1 + 0.3 * f64::from(k);
            let found = zeros(3, 1.0, |x| ((x - at).cos() - 1.0).powi(2) * (2.0 + x.sin())).unwrap();
            assert!(found.len() == 1 && (found[0] - at).abs() < 1e-3, "{at}: {found:?}");
        }
    }

    /// A zero at an end of the period, or at one of the equally spaced positions, is found once.
    #[test]
    fn zeros_anywhere_are_found_once() {
        for k in 0..48 {
            let at = TAU * (f64::from(k) + 0.37) / 48.0;
            let found = zeros(3, 1.0, |x| (x - at).sin()).unwrap();
            assert_eq!(found.len(), 2, "{at}: {found:?}");
        }
        assert_eq!(zeros(2, 1.0, |x| x.sin()).unwrap().len(), 2);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn finds_as_many_zeros_as_a_dense_scan(c in prop::collection::vec(-1.0f64..1.0, 7), small in 0..3usize) {
            // The higher coefficients may be normal, small (1e-8) or of the size of a rounding error (1e-15).
            // The effective degree is then 3, 2 or 1.
            let size = [1.0, 1e-15, 1e-8];
            let (two, three) = (if c[0] > 0.5 { size[small] } else { 1.0 }, size[small]);
            let f = |x: f64| c[0] + c[1] * x.cos() + c[2] * x.sin() + two * (c[3] * (2.0 * x).cos() + c[4] * (2.0 * x).sin())
                + three * (c[5] * (3.0 * x).cos() + c[6] * (3.0 * x).sin());
            let found = zeros(3, 1.0, f).unwrap();
            for x in &found {
                prop_assert!(f(*x).abs() < 1e-13);
            }
            let n = 20_000;
            let value = |k: usize| f(TAU * k as f64 / n as f64);
            let changes = (0..n).filter(|&k| value(k) * value(k + 1) < 0.0).count();
            // The scan misses two sign changes that are closer together than its spacing.
            // The method may then correctly find two more zeros than the scan.
            let close = found.windows(2).any(|pair| pair[1] - pair[0] < TAU / n as f64);
            prop_assert!(found.len() == changes || close && found.len() == changes + 2, "{found:?} against {changes}");
        }
    }
}
