//! Interpolation between equally spaced samples.

/// Number of samples that one interpolation uses.
pub const POINTS: usize = 6;

/// Lagrange weights of six equally spaced samples at the position `s`.
/// The unit of `s` is the spacing, and `s` is 0 at the first sample.
///
/// Between the two middle samples (2 <= s <= 3) the interpolation error is below 0.005 h^6 times the sixth derivative,
/// where h is the spacing.
/// If `s` is the position of a sample, this sample has exactly the weight one, and all others have exactly the weight
/// zero.
/// Berrut and Trefethen, "Barycentric Lagrange interpolation", SIAM Review 2004.
#[must_use]
pub fn lagrange_weights(s: f64) -> [f64; POINTS] {
    const BARYCENTRIC: [f64; POINTS] = [-1.0, 5.0, -10.0, 10.0, -5.0, 1.0];
    let mut weights = [0.0; POINTS];
    let mut sum = 0.0;
    for (k, weight) in weights.iter_mut().enumerate() {
        let distance = s - k as f64;
        if distance == 0.0 {
            let mut exact = [0.0; POINTS];
            exact[k] = 1.0;
            return exact;
        }
        *weight = BARYCENTRIC[k] / distance;
        sum += *weight;
    }
    weights.map(|weight| weight / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reproduces_polynomials_of_degree_five() {
        let polynomial = |x: f64| 1.0 + x * (2.0 + x * (-1.0 + x * (0.5 + x * (0.25 - 0.1 * x))));
        for s in [2.0, 2.1, 2.5, 2.999, 3.0] {
            let value: f64 = lagrange_weights(s).iter().enumerate().map(|(k, w)| w * polynomial(k as f64)).sum();
            assert!((value - polynomial(s)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_sample_is_returned_bit_for_bit() {
        assert_eq!(lagrange_weights(3.0), [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    }
}
