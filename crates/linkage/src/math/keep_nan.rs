//! The larger and the smaller of two numbers. `larger` and `smaller` return NaN if a number is NaN.
//!
//! `f64::max` and `f64::min` drop NaN.
//! For NaN and 1, `f64::max` and `f64::min` return 1, so a later check cannot detect the NaN.
//! `clippy.toml` therefore forbids these two functions.

/// The larger and the smaller of two numbers.
pub trait KeepNan: Copy {
    /// The larger of the two numbers; NaN if either number is NaN.
    #[must_use]
    fn larger(self, other: Self) -> Self;

    /// The smaller of the two numbers; NaN if either number is NaN.
    #[must_use]
    fn smaller(self, other: Self) -> Self;

    /// The larger of the two numbers, ignoring NaN. The result is NaN if both numbers are NaN.
    #[must_use]
    fn larger_number(self, other: Self) -> Self;

    /// The smaller of the two numbers, ignoring NaN. The result is NaN if both numbers are NaN.
    #[must_use]
    fn smaller_number(self, other: Self) -> Self;
}

impl KeepNan for f64 {
    #[inline]
    fn larger(self, other: f64) -> f64 {
        if self > other || self.is_nan() { self } else { other }
    }

    #[inline]
    fn smaller(self, other: f64) -> f64 {
        if self < other || self.is_nan() { self } else { other }
    }

    #[inline]
    #[expect(clippy::disallowed_methods, reason = "this is the one place where NaN may be dropped")]
    fn larger_number(self, other: f64) -> f64 {
        self.max(other)
    }

    #[inline]
    #[expect(clippy::disallowed_methods, reason = "this is the one place where NaN may be dropped")]
    fn smaller_number(self, other: f64) -> f64 {
        self.min(other)
    }
}

/// The largest absolute value in a list; NaN if one value is NaN, 0 for an empty list.
#[must_use]
pub fn largest_size(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().larger(most))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_propagates_from_any_position() {
        for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN), (-f64::NAN, 1.0), (f64::NAN, f64::NAN)] {
            assert!(a.larger(b).is_nan() && a.smaller(b).is_nan(), "{a} {b}");
        }
        for place in 0..3 {
            let mut values = [1.0, -2.0, 3.0];
            values[place] = f64::NAN;
            assert!(largest_size(&values).is_nan(), "{place}");
            assert!(values.into_iter().fold(0.0, f64::larger).is_nan(), "{place}");
            assert!(values.into_iter().fold(0.0, f64::smaller).is_nan(), "{place}");
        }
    }

    #[test]
    fn larger_and_smaller_compare_numbers_as_usual() {
        for (a, b) in [(1.0, 2.0), (2.0, 1.0), (-1.0, 1.0), (f64::NEG_INFINITY, 0.0), (0.0, f64::INFINITY)] {
            let (high, low) = if a > b { (a, b) } else { (b, a) };
            assert_eq!((a.larger(b), a.smaller(b)), (high, low));
            assert_eq!((a.larger_number(b), a.smaller_number(b)), (high, low));
        }
        assert_eq!(largest_size(&[1.0, -3.0, 2.0]), 3.0);
        assert_eq!(largest_size(&[]), 0.0);
    }

    #[test]
    fn larger_number_and_smaller_number_ignore_nan() {
        assert_eq!((f64::NAN.larger_number(1.0), 1.0f64.smaller_number(f64::NAN)), (1.0, 1.0));
    }
}
