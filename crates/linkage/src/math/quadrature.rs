//! Integrals of smooth functions.

use crate::math::KeepNan;
use std::convert::Infallible;
use std::f64::consts::PI;

use super::root;

/// Nodes in one panel.
pub const NODES: usize = 8;

/// Nodes (between -1 and 1) and weights of Gauss-Legendre quadrature with [`NODES`] nodes.
/// The rule is exact for polynomials of degree 15.
///
/// The nodes are the zeros of the Legendre polynomial.
/// Newton's method finds the zeros, starting from an asymptotic approximation of each zero.
/// The weights are 2 / ((1 - x^2) P'(x)^2). Abramowitz and Stegun 25.4.29.
#[must_use]
pub fn gauss_legendre() -> [(f64, f64); NODES] {
    let n = NODES as f64;
    std::array::from_fn(|k| {
        let guess = -(PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        // The initial guess is accurate to three digits and convergence is quadratic. Six steps are therefore more than
        // enough.
        let Ok(x) = root::polished(guess, 6, f64::INFINITY, |x| {
            let (mut before, mut here) = (1.0, x);
            for degree in 2..=NODES {
                let d = degree as f64;
                (before, here) = (here, ((2.0 * d - 1.0) * x * here - (d - 1.0) * before) / d);
            }
            slope = n * (x * here - before) / (x * x - 1.0);
            Ok::<_, Infallible>((here, slope))
        });
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    })
}

/// Nodes and weights over the intervals between ascending `breaks`.
/// Each interval is divided into equal panels no longer than `panel`.
/// The function may have kinks at the breaks, and must be smooth between them.
#[must_use]
pub fn composite(breaks: &[f64], panel: f64) -> Vec<(f64, f64)> {
    let rule = gauss_legendre();
    let mut nodes = Vec::new();
    for pair in breaks.windows(2) {
        let panels = ((pair[1] - pair[0]) / panel).ceil().larger(1.0);
        let half = (pair[1] - pair[0]) / panels / 2.0;
        for index in 0..panels as usize {
            let middle = pair[0] + half * (2 * index + 1) as f64;
            nodes.extend(rule.map(|(x, weight)| (middle + half * x, half * weight)));
        }
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_degree_fifteen_are_exact() {
        let rule = gauss_legendre();
        for degree in 0..16 {
            let found: f64 = rule.iter().map(|(x, w)| w * x.powi(degree)).sum();
            let exact = if degree % 2 == 0 { 2.0 / f64::from(degree + 1) } else { 0.0 };
            assert!((found - exact).abs() < 1e-15, "{degree}: {found}");
        }
    }

    #[test]
    fn a_kink_at_an_interval_end_costs_no_accuracy() {
        // The integral of |sin x| from 0 to 2 pi is 4.
        let found: f64 = composite(&[0.0, PI, 2.0 * PI], 0.5).iter().map(|(x, w)| w * x.sin().abs()).sum();
        assert!((found - 4.0).abs() < 1e-14, "{found}");
    }
}
