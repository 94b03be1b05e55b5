//! Polynomials as sums of Chebyshev polynomials.

use linkage::math::KeepNan;

/// The sum of `coefficients[k]` times the Chebyshev polynomial T_k(x). Over the domain, x grows from -1 to 1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chebyshev {
    pub coefficients: Vec<f64>,
    domain: [f64; 2],
}

/// The zeros of the Chebyshev polynomial of degree `count`, over the domain in ascending order.
pub(crate) fn nodes(domain: [f64; 2], count: usize) -> Vec<f64> {
    let angle = |index: usize| std::f64::consts::PI * (index as f64 + 0.5) / count as f64;
    (0..count).rev().map(|index| place(domain, angle(index).cos())).collect()
}

fn place([low, high]: [f64; 2], x: f64) -> f64 {
    f64::midpoint(low, high) + x * (high - low) / 2.0
}

impl Chebyshev {
    /// The least-squares fit of degree `degree` to `values` at all [`nodes`] of the domain. The nodes may be in any
    /// order.
    pub(crate) fn fit(domain: [f64; 2], degree: usize, nodes: &[f64], values: &[f64]) -> Self {
        let mut own = Chebyshev { coefficients: vec![0.0; degree + 1], domain };
        for (&node, value) in nodes.iter().zip(values) {
            let angle = own.x(node).larger(-1.0).smaller(1.0).acos();
            for (k, sum) in own.coefficients.iter_mut().enumerate() {
                *sum += value * (k as f64 * angle).cos();
            }
        }
        let count = nodes.len() as f64;
        own.coefficients.iter_mut().enumerate().for_each(|(k, sum)| *sum *= if k == 0 { 1.0 } else { 2.0 } / count);
        own
    }

    fn half(&self) -> f64 {
        (self.domain[1] - self.domain[0]) / 2.0
    }

    fn x(&self, value: f64) -> f64 {
        (value - f64::midpoint(self.domain[0], self.domain[1])) / self.half()
    }

    /// Leaves out the coefficients of degree 2 and more if all of them are below `noise`.
    pub(crate) fn drop_noise(&mut self, noise: f64) {
        if self.coefficients.iter().skip(2).all(|own| own.abs() < noise) {
            self.coefficients.truncate(2);
        }
    }

    /// Value at zero and slope, if the degree is 1.
    pub(crate) fn line(&self) -> Option<[f64; 2]> {
        let [constant, slope] = self.coefficients[..] else { return None };
        Some([constant + slope * self.x(0.0), slope / self.half()])
    }

    /// Value with the first and the second derivative.
    pub(crate) fn at(&self, value: f64) -> [f64; 3] {
        let (x, scale) = (self.x(value), self.half().recip());
        // T_(k+1) = 2 x T_k - T_(k-1), and its derivatives.
        let (mut now, mut next) = ([1.0, 0.0, 0.0], [x, 1.0, 0.0]);
        let mut sum = [0.0; 3];
        for own in &self.coefficients {
            sum.iter_mut().zip(now).for_each(|(sum, part)| *sum += own * part);
            let [t, first, second] = next;
            let above = [2.0 * x * t, 2.0 * (t + x * first), 2.0 * (2.0 * first + x * second)];
            (now, next) = (next, [0, 1, 2].map(|k| above[k] - now[k]));
        }
        [sum[0], sum[1] * scale, sum[2] * scale * scale]
    }

    /// Bound on the third derivative over the domain: the third derivative of T_k is largest at the ends.
    pub(crate) fn third(&self) -> f64 {
        let of = |(k, own): (usize, &f64)| {
            let square = (k * k) as f64;
            own.abs() * (square * (square - 1.0) * (square - 4.0) / 15.0).abs()
        };
        self.coefficients.iter().enumerate().map(of).sum::<f64>() / self.half().powi(3)
    }

    /// Bound on the rounding error of a value.
    pub(crate) fn rounding(&self) -> f64 {
        let count = self.coefficients.len() as f64;
        4.0 * f64::EPSILON * (count + 2.0).powi(2) * self.coefficients.iter().map(|own| own.abs()).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fit_reproduces_a_polynomial_with_its_derivatives() {
        let domain = [-1.0, 3.0];
        let of = |x: f64| [x.powi(3) - 2.0 * x, 3.0 * x * x - 2.0, 6.0 * x];
        let nodes = nodes(domain, 16);
        let values: Vec<f64> = nodes.iter().map(|&node| of(node)[0]).collect();
        let own = Chebyshev::fit(domain, 5, &nodes, &values);
        for place in [-1.0, 0.3, 2.9] {
            let off = own.at(place).into_iter().zip(of(place)).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::larger) < 1e-12, "{own:?}");
        }
        assert!((own.third() - 6.0).abs() < 1e-9, "{}", own.third());
    }

    #[test]
    fn a_line_has_its_value_at_zero_and_its_slope() {
        let nodes = nodes([2.0, 5.0], 8);
        let values: Vec<f64> = nodes.iter().map(|node| 1.0 - 3.0 * node).collect();
        let mut own = Chebyshev::fit([2.0, 5.0], 4, &nodes, &values);
        assert_eq!(own.line(), None);
        own.drop_noise(1e-12);
        let [offset, slope] = own.line().unwrap();
        assert!((offset - 1.0).abs() < 1e-12 && (slope + 3.0).abs() < 1e-12);
    }
}
