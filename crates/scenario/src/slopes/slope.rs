//! A number with its derivatives by keys.

use std::collections::BTreeMap;
use std::ops::{Add, Mul, Sub};

/// A number with its derivatives by keys. A derivative that is not listed is zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slope {
    /// The number.
    pub value: f64,
    /// Derivatives of the number, by the index of the key.
    pub by: BTreeMap<usize, f64>,
}

impl Slope {
    /// A number that depends on no key.
    #[must_use]
    pub fn constant(value: f64) -> Slope {
        Slope { value, by: BTreeMap::new() }
    }

    /// The value of a function of this number, with its derivatives by the chain rule.
    /// `value` is the function's value at this number, and `slope` the function's derivative at this number.
    #[must_use]
    pub fn chained(&self, value: f64, slope: f64) -> Slope {
        let by = self.by.iter().map(|(key, own)| (*key, own * slope)).filter(|(_, own)| *own != 0.0);
        Slope { value, by: by.collect() }
    }

    /// Adds `factor` times the derivatives of another number.
    pub(crate) fn include(&mut self, other: &Slope, factor: f64) {
        for (key, own) in &other.by {
            *self.by.entry(*key).or_insert(0.0) += own * factor;
        }
        self.by.retain(|_, own| *own != 0.0);
    }

    fn joined(&self, other: &Slope, value: f64, [own, its]: [f64; 2]) -> Slope {
        let mut sum = self.chained(value, own);
        sum.include(other, its);
        sum
    }

    /// Sine and cosine of an angle (rad).
    #[must_use]
    pub(crate) fn sin_cos(&self) -> [Slope; 2] {
        let (sin, cos) = self.value.sin_cos();
        [self.chained(sin, cos), self.chained(cos, -sin)]
    }
}

impl Add for &Slope {
    type Output = Slope;
    fn add(self, other: &Slope) -> Slope {
        self.joined(other, self.value + other.value, [1.0, 1.0])
    }
}

impl Sub for &Slope {
    type Output = Slope;
    fn sub(self, other: &Slope) -> Slope {
        self.joined(other, self.value - other.value, [1.0, -1.0])
    }
}

impl Mul for &Slope {
    type Output = Slope;
    fn mul(self, other: &Slope) -> Slope {
        self.joined(other, self.value * other.value, [other.value, self.value])
    }
}
