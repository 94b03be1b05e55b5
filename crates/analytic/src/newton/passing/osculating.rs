//! Osculating polynomials through values, first and second derivatives at several positions (Hermite).
//!
//! The polynomial is p(x) = sum of l_i(x)^3 (c0 + c1 (x - x_i) + c2 (x - x_i)^2) with Lagrange's l_i.
//! The derivatives of l_i^-3 give c0 = f, c1 = f' - 3 s f, 2 c2 = f'' - 6 s f' + (9 s^2 + 3 t) f.
//! Here s is the sum of 1 / (x_i - x_j), and t the sum of 1 / (x_i - x_j)^2.

/// Value, first and second derivative.
type Jet = [f64; 3];

fn product([a, da, dda]: Jet, [b, db, ddb]: Jet) -> Jet {
    [a * b, da * b + a * db, dda * b + 2.0 * da * db + a * ddb]
}

/// Polynomials of many functions through the same positions.
#[derive(Clone, Debug)]
pub(super) struct Osculating {
    places: Vec<f64>,
    /// c0, c1, c2 of every function: first for the first position, then for each further position.
    coefficients: Vec<Vec<Jet>>,
}

impl Osculating {
    /// Polynomials through the values and derivatives of all functions at these positions.
    pub(super) fn through(points: &[(f64, [&[f64]; 3])]) -> Self {
        let places: Vec<f64> = points.iter().map(|(x, _)| *x).collect();
        let of = |(i, (x, [f, df, ddf])): (usize, &(f64, [&[f64]; 3]))| -> Vec<Jet> {
            let others = || places.iter().enumerate().filter(move |&(j, _)| j != i).map(|(_, other)| 1.0 / (x - other));
            let (s, t) = (others().sum::<f64>(), others().map(|one| one * one).sum::<f64>());
            let one = |((f, df), ddf): ((&f64, &f64), &f64)| {
                [*f, df - 3.0 * s * f, 0.5 * (ddf - 6.0 * s * df + (9.0 * s * s + 3.0 * t) * f)]
            };
            f.iter().zip(*df).zip(*ddf).map(one).collect()
        };
        let coefficients = points.iter().enumerate().map(of).collect();
        Osculating { places, coefficients }
    }

    /// Values and derivatives of all functions at `x`.
    pub(super) fn at(&self, x: f64) -> Vec<Jet> {
        let mut sum = vec![[0.0; 3]; self.coefficients[0].len()];
        for (i, (own, coefficients)) in self.places.iter().zip(&self.coefficients).enumerate() {
            let others = self.places.iter().enumerate().filter(|&(j, _)| j != i);
            let basis = others.fold([1.0, 0.0, 0.0], |all, (_, other)| {
                let width = own - other;
                product(all, [(x - other) / width, 1.0 / width, 0.0])
            });
            let cube = product(basis, product(basis, basis));
            let d = x - own;
            for (sum, [c0, c1, c2]) in sum.iter_mut().zip(coefficients) {
                let part = product(cube, [c0 + d * (c1 + d * c2), c1 + 2.0 * d * c2, 2.0 * c2]);
                sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::Osculating;

    #[test]
    fn the_polynomial_matches_the_function_and_its_derivatives() {
        let of = |x: f64| [[x.sin() + 3.0], [x.cos()], [-x.sin()]];
        let places = [-0.3, -0.2, -0.07, 0.07, 0.2, 0.3];
        let values = places.map(of);
        let points: Vec<(f64, [&[f64]; 3])> =
            places.iter().zip(&values).map(|(x, v)| (*x, [&v[0][..], &v[1][..], &v[2][..]])).collect();
        let polynomial = Osculating::through(&points);
        for x in [-0.3, -0.1, 0.0, 0.07, 0.25] {
            let found = polynomial.at(x)[0];
            // Bounds for rounding errors: a few units in the last place of f, s f and 9 s^2 f, with s up to 21 and f up
            // to 3.3.
            for (k, bound) in [(0, 1e-14), (1, 1e-13), (2, 16.0 * f64::EPSILON * 9.0 * 19.0 * 19.0)] {
                assert!((found[k] - of(x)[k][0]).abs() < bound, "{x} {k}: {}", found[k] - of(x)[k][0]);
            }
        }
    }
}
