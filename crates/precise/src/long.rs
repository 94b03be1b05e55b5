//! A number with about 31 digits, with sine and cosine.
//!
//! Sources: Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic building blocks of double-word
//! arithmetic", ACM Transactions on Mathematical Software 44 (2017), 15:1-15:27, algorithms 6 (sum), 9 and 12
//! (products), 17 (quotient).

use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A double-double number: the nearest double and the remainder.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Long(f64, f64);

/// The sum of two doubles without error (Knuth).
fn sum(a: f64, b: f64) -> Long {
    let sum = a + b;
    let second = sum - a;
    Long(sum, (a - (sum - second)) + (b - second))
}

/// The sum of two doubles without error, if the first double has the larger absolute value (Dekker).
fn ordered_sum(a: f64, b: f64) -> Long {
    let sum = a + b;
    Long(sum, b - (sum - a))
}

impl Long {
    /// 0.
    pub const ZERO: Long = Long(0.0, 0.0);
    /// Half a turn (rad).
    const PI: Long = Long(PI, 1.224_646_799_147_353_2e-16);
    /// A full turn (rad).
    pub const TURN: Long = Long(2.0 * PI, 2.0 * 1.224_646_799_147_353_2e-16);
    /// 1.
    pub const ONE: Long = Long(1.0, 0.0);

    /// Exactly this double.
    pub fn of(value: f64) -> Long {
        Long(value, 0.0)
    }

    /// The nearest double.
    pub fn rounded(self) -> f64 {
        self.0 + self.1
    }

    /// Absolute value.
    pub fn abs(self) -> Long {
        if self.0 < 0.0 { -self } else { self }
    }

    /// Square root of a number that is not negative.
    pub fn sqrt(self) -> Long {
        if self == Long::ZERO {
            return self;
        }
        // One step of Newton's method doubles the number of correct digits.
        let root = Long::of(self.0.sqrt());
        (root + self / root) * Long::of(0.5)
    }

    /// Sine and cosine of an angle (rad) of up to about 1e9.
    pub fn sin_cos(self) -> (Long, Long) {
        let quarter = Long::PI * Long::of(0.5);
        let quarters = (self.rounded() / quarter.rounded()).round();
        let rest = self - quarter * Long::of(quarters);
        let (sin, cos) = series(rest);
        match quarters.rem_euclid(4.0) as u8 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }
}

/// Number of terms of the power series: (pi / 4)^29 / 29! is 1e-34.
const TERMS: u8 = 29;

/// Sine and cosine of an angle of at most an eighth of a turn, by their power series.
fn series(angle: Long) -> (Long, Long) {
    let (mut sums, mut term) = ([Long::ONE, Long::ZERO], Long::ONE);
    for k in 1..=TERMS {
        term = term * angle / Long::of(f64::from(k));
        let own = &mut sums[usize::from(k % 2)];
        // The sign is + for k = 0, 1, 4, 5, ... and - for k = 2, 3, 6, 7, ...
        *own = if k % 4 < 2 { *own + term } else { *own - term };
    }
    (sums[1], sums[0])
}

impl Add for Long {
    type Output = Long;
    fn add(self, other: Long) -> Long {
        let (high, low) = (sum(self.0, other.0), sum(self.1, other.1));
        let joined = ordered_sum(high.0, high.1 + low.0);
        ordered_sum(joined.0, low.1 + joined.1)
    }
}

impl Sub for Long {
    type Output = Long;
    fn sub(self, other: Long) -> Long {
        self + -other
    }
}

impl Mul for Long {
    type Output = Long;
    fn mul(self, other: Long) -> Long {
        let high = self.0 * other.0;
        let low = self.1.mul_add(other.0, self.0.mul_add(other.1, self.1 * other.1));
        ordered_sum(high, self.0.mul_add(other.0, -high) + low)
    }
}

impl Div for Long {
    type Output = Long;
    fn div(self, other: Long) -> Long {
        let quotient = self.0 / other.0;
        let back = other * Long::of(quotient);
        ordered_sum(quotient, ((self.0 - back.0) + (self.1 - back.1)) / other.0)
    }
}

impl Neg for Long {
    type Output = Long;
    fn neg(self) -> Long {
        Long(-self.0, -self.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: Long, b: Long) -> bool {
        (a - b).abs().rounded() <= 1e-30 * a.abs().rounded()
    }

    #[test]
    fn sums_and_products_keep_thirty_digits() {
        let third = Long::ONE / Long::of(3.0);
        assert!(near(third + third + third, Long::ONE));
        // The sum 1 + 2^-90 minus 1 is exactly 2^-90.
        let small = Long::of(2f64.powi(-90));
        assert_eq!(Long::ONE + small - Long::ONE, small);
        for value in [2.0, 1e-12, 0.3, 7e11] {
            let root = Long::of(value).sqrt();
            assert!(near(root * root, Long::of(value)), "{value}");
        }
        assert_eq!(Long::ZERO.sqrt(), Long::ZERO);
    }

    /// The test covers addition theorems, an angle known in radicals, and large angles.
    #[test]
    fn sines_keep_thirty_digits() {
        for k in 0..200 {
            let (a, b) = (Long::of(0.037 * f64::from(k) - 3.0), Long::of(0.011 * f64::from(k)));
            let ((sa, ca), (sb, cb), (s, c)) = (a.sin_cos(), b.sin_cos(), (a + b).sin_cos());
            let off = [(sa * cb + ca * sb) - s, (ca * cb - sa * sb) - c, sa * sa + ca * ca - Long::ONE];
            assert!(off.iter().all(|off| off.abs().rounded() < 1e-30), "{k}: {off:?}");
            assert!((s.rounded() - (a + b).rounded().sin()).abs() < 1e-15);
        }
        // The sine of a twelfth of a turn is a half, even a hundred thousand turns later.
        let turn = Long::PI * Long::of(2.0);
        for turns in [0.0, 1.0, 1e5] {
            let (sin, _) = (turn / Long::of(12.0) + turn * Long::of(turns)).sin_cos();
            assert!((sin - Long::of(0.5)).abs().rounded() < 1e-31 * (turns + 10.0), "{turns}");
        }
    }
}
