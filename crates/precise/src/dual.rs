//! Dual numbers: numbers with their first derivatives in several directions.
//!
//! Every operation applies the rules of differentiation, so the derivatives have no step size error, unlike finite
//! differences. The method is the forward mode of algorithmic differentiation: Griewank, Walther, Evaluating
//! Derivatives, 2nd ed., SIAM 2008, section 3.1.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::eliminated::Eliminated;
use super::scalar::Scalar;

/// A number with its derivatives in `N` directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<B, const N: usize> {
    /// The number.
    pub value: B,
    /// One derivative per direction.
    pub slopes: [B; N],
}

impl<B: Scalar, const N: usize> Dual<B, N> {
    /// A number that is constant in all directions.
    #[must_use]
    pub fn constant(value: B) -> Self {
        Dual { value, slopes: [B::ZERO; N] }
    }

    /// A function of this number. `value` is the function's value at this number, and `slope` is its derivative there.
    fn chained(self, value: B, slope: B) -> Self {
        Dual { value, slopes: self.slopes.map(|own| own * slope) }
    }
}

impl<B: Scalar, const N: usize> Add for Dual<B, N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Dual { value: self.value + other.value, slopes: std::array::from_fn(|k| self.slopes[k] + other.slopes[k]) }
    }
}

impl<B: Scalar, const N: usize> Sub for Dual<B, N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Dual { value: self.value - other.value, slopes: std::array::from_fn(|k| self.slopes[k] - other.slopes[k]) }
    }
}

impl<B: Scalar, const N: usize> Mul for Dual<B, N> {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the rule for the derivative of a product")]
    fn mul(self, other: Self) -> Self {
        let slope = |k: usize| self.slopes[k] * other.value + self.value * other.slopes[k];
        Dual { value: self.value * other.value, slopes: std::array::from_fn(slope) }
    }
}

impl<B: Scalar, const N: usize> Div for Dual<B, N> {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the rule for the derivative of a quotient")]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Dual { value, slopes: std::array::from_fn(|k| (self.slopes[k] - value * other.slopes[k]) / other.value) }
    }
}

impl<B: Scalar, const N: usize> Neg for Dual<B, N> {
    type Output = Self;
    fn neg(self) -> Self {
        Dual { value: -self.value, slopes: self.slopes.map(|own| -own) }
    }
}

/// A matrix of numbers with derivatives: the values after elimination, and the rows before elimination.
#[derive(Debug)]
pub struct DualFactors<B, const N: usize> {
    values: Eliminated<B>,
    rows: Vec<Vec<Dual<B, N>>>,
}

impl<B: Scalar, const N: usize> Scalar for Dual<B, N> {
    const ZERO: Self = Dual { value: B::ZERO, slopes: [B::ZERO; N] };
    const ONE: Self = Dual { value: B::ONE, slopes: [B::ZERO; N] };
    const TURN: Self = Dual { value: B::TURN, slopes: [B::ZERO; N] };
    const SETTLED: f64 = B::SETTLED;
    const ROUNDING: f64 = B::ROUNDING;

    type Factors = DualFactors<B, N>;

    fn of(value: f64) -> Self {
        Dual::constant(B::of(value))
    }

    fn value(self) -> f64 {
        self.value.value()
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chained(root, B::ONE / (root + root))
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chained(sin, cos), self.chained(cos, -sin))
    }

    fn factors(rows: Vec<Vec<Self>>) -> Option<Self::Factors> {
        let values = rows.iter().map(|row| row.iter().map(|own| own.value).collect()).collect();
        Some(DualFactors { values: Eliminated::of(values)?, rows })
    }

    /// The derivatives of the solution of A x = b follow from A x' = b' - A' x. The matrix is again A, so A is
    /// eliminated only once.
    fn solution(factors: &Self::Factors, right: &[Self]) -> Vec<Self> {
        let values: Vec<B> = right.iter().map(|own| own.value).collect();
        let values = factors.values.solved(&values);
        let mut slopes: Vec<[B; N]> = right.iter().map(|own| own.slopes).collect();
        for (slopes, row) in slopes.iter_mut().zip(&factors.rows) {
            for (entry, value) in row.iter().zip(&values).filter(|(entry, _)| **entry != Self::ZERO) {
                for (own, slope) in slopes.iter_mut().zip(&entry.slopes) {
                    *own = *own - *slope * *value;
                }
            }
        }
        let slopes = factors.values.all_solved(slopes);
        values.into_iter().zip(slopes).map(|(value, slopes)| Dual { value, slopes }).collect()
    }
}
