//! Functions of one variable with two continuous derivatives: motion laws over time, lifts over the angle of a cam.

use std::convert::Infallible;
use std::f64::consts::TAU;
use std::fmt::Debug;
use std::sync::Arc;

use super::{KeepNan, Piecewise, extremum};

/// A function that another crate evaluates, such as a formula.
pub trait Smooth: Debug + Send + Sync {
    /// Value and first two derivatives.
    fn at(&self, x: f64) -> [f64; 3];

    /// The text that defines the function. Functions with equal texts are equal.
    fn stated(&self) -> &str;
}

/// A function with two continuous derivatives.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// A spline through points.
    Table(Piecewise),
    /// f(x) = amplitude * (sin(2 pi x / period + phase) - sin(phase)), for all x.
    /// The value of the function is 0 at x = 0.
    Harmonic {
        /// Amplitude, not zero.
        amplitude: f64,
        /// Period, positive.
        period: f64,
        /// Phase at x = 0 (rad).
        phase: f64,
    },
    /// A formula, from x = 0 to a given end.
    Formula(FormulaCurve),
}

/// The function g(x) = factor * (f(x) - f(0)), from x = 0 to `end`.
#[derive(Clone, Debug)]
pub struct FormulaCurve {
    /// The function f.
    of: Arc<dyn Smooth>,
    shift: f64,
    factor: f64,
    end: f64,
    /// The first derivative where its absolute value is largest, with its sign.
    /// The value is stored, because the search for it takes many evaluations.
    steepest: f64,
    /// The second derivative where its absolute value is largest, with its sign.
    /// The value is stored, because the search for it takes many evaluations.
    sharpest: f64,
}

impl FormulaCurve {
    /// The function f(x) - f(0) from x = 0 to `end`.
    #[must_use]
    pub fn new(of: Arc<dyn Smooth>, end: f64) -> Self {
        let places = parts(end);
        let values: Vec<[f64; 3]> = places.iter().map(|&x| of.at(x)).collect();
        let largest = |order: usize| {
            let [least, most] = [-1.0, 1.0].map(|sign| {
                let mut derivative = |x: f64| Ok::<_, Infallible>(sign * of.at(x)[order]);
                let samples: Vec<f64> = values.iter().map(|own| sign * own[order]).collect();
                let Ok((_, most)) = extremum::greatest(&places, &samples, &mut derivative);
                sign * most
            });
            larger_size(least, most)
        };
        let (shift, steepest, sharpest) = (of.at(0.0)[0], largest(1), largest(2));
        FormulaCurve { of, shift, factor: 1.0, end, steepest, sharpest }
    }

    /// The first of the [`Curve::places`] at which the function or one of its first two derivatives is undefined.
    #[must_use]
    pub fn undefined_at(&self) -> Option<f64> {
        parts(self.end).into_iter().find(|&x| !self.of.at(x).into_iter().all(f64::is_finite))
    }
}

/// Equally spaced x from 0 to `end`. A search evaluates the formula at these x.
fn parts(end: f64) -> Vec<f64> {
    (0..=PARTS).map(|part| end * f64::from(part) / f64::from(PARTS)).collect()
}

fn larger_size(least: f64, most: f64) -> f64 {
    if -least > most { least } else { most }
}

impl PartialEq for FormulaCurve {
    fn eq(&self, other: &Self) -> bool {
        let numbers = |own: &Self| [own.shift, own.factor, own.end];
        self.of.stated() == other.of.stated() && numbers(self) == numbers(other)
    }
}

/// Number of parts into which the range of a formula, or the period of a harmonic, is divided for searches.
const PARTS: u32 = 1024;

impl Curve {
    /// Value and first two derivatives at `x`.
    #[inline]
    #[must_use]
    pub fn at(&self, x: f64) -> [f64; 3] {
        match self {
            Curve::Table(table) => table.at(x),
            &Curve::Harmonic { amplitude, period, phase } => {
                let (rate, (sine, cosine)) = (TAU / period, (TAU * x / period + phase).sin_cos());
                [amplitude * (sine - phase.sin()), amplitude * rate * cosine, -amplitude * rate * rate * sine]
            }
            Curve::Formula(own) => {
                let [value, first, second] = own.of.at(x);
                [own.factor * (value - own.shift), own.factor * first, own.factor * second]
            }
        }
    }

    /// Name of the curve's kind.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Curve::Table(_) => "table",
            Curve::Harmonic { .. } => "harmonic",
            Curve::Formula(_) => "formula",
        }
    }

    /// The x at which the curve ends; `None` if it never ends.
    #[must_use]
    pub fn end(&self) -> Option<f64> {
        match self {
            Curve::Table(table) => table.knots().last().copied(),
            Curve::Harmonic { .. } => None,
            Curve::Formula(own) => Some(own.end),
        }
    }

    /// This curve multiplied by `factor`.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        match self {
            Curve::Table(table) => Curve::Table(table.times(factor)),
            &Curve::Harmonic { amplitude, period, phase } => {
                Curve::Harmonic { amplitude: factor * amplitude, period, phase }
            }
            Curve::Formula(own) => {
                let [factor, steepest, sharpest] =
                    [own.factor, own.steepest, own.sharpest].map(|number| factor * number);
                Curve::Formula(FormulaCurve { factor, steepest, sharpest, ..own.clone() })
            }
        }
    }

    /// Ascending values of x that divide the curve into intervals for searches.
    /// For a table, these are the knots; for any other curve, they are equally spaced.
    #[must_use]
    pub fn places(&self) -> Vec<f64> {
        match self {
            Curve::Table(table) => table.knots().to_vec(),
            Curve::Harmonic { period, .. } => parts(*period),
            Curve::Formula(own) => parts(own.end),
        }
    }

    /// The first derivative where its absolute value is largest, with its sign.
    #[must_use]
    pub fn steepest(&self) -> f64 {
        match self {
            Curve::Table(table) => {
                let [least, most] = table.slopes();
                larger_size(least, most)
            }
            Curve::Harmonic { amplitude, period, .. } => amplitude.abs() * TAU / period,
            Curve::Formula(own) => own.steepest,
        }
    }

    /// Largest absolute value of the second derivative.
    /// For a formula, the value comes from a search over 1024 parts.
    #[must_use]
    pub fn sharpest(&self) -> f64 {
        match self {
            Curve::Table(table) => table.knots().iter().fold(0.0, |most, &knot| most.larger(table.at(knot)[2].abs())),
            Curve::Harmonic { amplitude, period, .. } => amplitude.abs() * (TAU / period).powi(2),
            Curve::Formula(own) => own.sharpest.abs(),
        }
    }

    /// Difference between the largest and the smallest value at [`Curve::places`].
    #[must_use]
    pub fn range(&self) -> f64 {
        let values = || self.places().into_iter().map(|x| self.at(x)[0]);
        values().fold(f64::NEG_INFINITY, f64::larger) - values().fold(f64::INFINITY, f64::smaller)
    }

    /// Whether the numbers that define the curve are finite. For a table: knots and the values at the knots.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        match self {
            Curve::Table(table) => table.is_finite(),
            Curve::Harmonic { amplitude, period, phase } => {
                [amplitude, period, phase].iter().all(|own| own.is_finite())
            }
            Curve::Formula(own) => [own.shift, own.factor, own.end, own.steepest].iter().all(|own| own.is_finite()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_harmonic_begins_with_zero_and_matches_its_derivatives() {
        let curve = Curve::Harmonic { amplitude: 2.0, period: 3.0, phase: 0.4 };
        assert_eq!(curve.at(0.0)[0], 0.0);
        assert_relative_eq!(curve.steepest().abs(), 2.0 * TAU / 3.0, epsilon = 1e-12);
        assert_relative_eq!(curve.times(-0.5).range(), 2.0, epsilon = 1e-5);
        for x in [0.0, 0.3, 1.1, 2.9, 7.0] {
            let h = 1e-6;
            let [[before, rate, _], [after, later, _]] = [curve.at(x - h), curve.at(x + h)];
            let [_, first, second] = curve.at(x);
            assert_relative_eq!((after - before) / (2.0 * h), first, epsilon = 1e-8);
            assert_relative_eq!((later - rate) / (2.0 * h), second, epsilon = 1e-7);
        }
    }
}
