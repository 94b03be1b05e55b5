//! Formats numbers for readers: short numbers as plain decimals, only meaningful digits, and zero as `0`.
//!
//! Whether a value counts as zero depends on a scale. [`resolved`] therefore takes the resolution of the value, and
//! [`beside`] takes the bound on the difference of the two values.

use linkage::input::InputValue;
use linkage::math::KeepNan;
pub use linkage::trajectory::shown_unit as shown;

/// Number of digits of an error or a bound. An estimate does not justify more digits.
const DIGITS: usize = 3;

/// Number of decimal digits that a double always preserves.
const MOST_DIGITS: usize = 15;

/// If the difference of two values exceeds this fraction of a value, the first four digits of the value show the
/// difference.
const FAR: f64 = 1e-3;

/// If two values differ by at most their bound, digits below this fraction of a value are not shown.
/// The value is then shown with at most seven digits.
const NEAR: f64 = 1e-6;

/// An error, a bound or a fraction of a bound: three significant digits.
#[must_use]
pub fn error(value: f64) -> String {
    significant(value, DIGITS)
}

/// An error with its unit, or the number alone if the unit is empty.
#[must_use]
pub fn error_in(value: f64, unit: &str) -> String {
    with_unit(&error(value), unit)
}

/// A number with at most `digits` significant digits.
/// Numbers with a magnitude from a thousandth to a hundred thousand are written as plain decimals, all other numbers
/// with an exponent.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return value.to_string();
    }
    let rounded = rounded(value, digits);
    if rounded == 0.0 {
        "0".into()
    } else if is_plain(rounded) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

/// A value with an error of up to `resolution` (the value's bound or rounding error).
/// Digits below the resolution are left out. A value smaller than the resolution is `0`.
/// With a resolution of 0 the value has all its digits.
#[must_use]
pub fn resolved(value: f64, resolution: f64) -> String {
    let resolution = resolution.abs();
    if !value.is_finite() || !resolution.is_finite() {
        return significant(value, MOST_DIGITS);
    }
    if value.abs() < resolution || value == 0.0 {
        return "0".into();
    }
    // If the resolution is 0, the ratio is infinite and the cast saturates, so all digits are shown.
    let digits = (value.abs() / resolution).log10().ceil() as usize;
    let digits = digits.clamp(1, MOST_DIGITS);
    let decimals = -resolution.log10().floor();
    if is_plain(value) && decimals >= 0.0 && decimals <= MOST_DIGITS as f64 && digits < MOST_DIGITS {
        fixed(value, decimals as usize)
    } else {
        significant(value, digits)
    }
}

/// Two values with enough digits to show their difference, but with at least four digits.
/// A value below the `bound` on the difference is written as `0` if the difference exceeds a thousandth of this value.
/// If the difference is within the bound, the values have at most seven digits.
#[must_use]
pub fn beside(values: [f64; 2], bound: f64) -> [String; 2] {
    let [a, b] = values;
    let difference = (a - b).abs();
    let is_far = |value: f64| difference > FAR * value.abs();
    let resolution = |value: f64| match difference > 0.0 {
        true if is_far(value) && value.abs() < bound => bound,
        true if is_far(value) => FAR * value.abs(),
        true if difference <= bound => difference.larger(NEAR * value.abs()),
        true => difference,
        // This arm includes NaN.
        false => bound.larger(NEAR * value.abs()),
    };
    values.map(|value| resolved(value, resolution(value)))
}

/// A number with `decimals` decimals, for table columns and locations. A value that rounds to zero has no sign.
#[must_use]
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(size) if size.chars().all(|sign| matches!(sign, '0' | '.')) => size.into(),
        _ => text,
    }
}

/// A number with `decimals` decimals, as in `fixed`, and its unit.
#[must_use]
pub fn fixed_in(value: f64, decimals: usize, unit: &str) -> String {
    with_unit(&fixed(value, decimals), unit)
}

/// An input's value with `decimals` decimals and its unit: `41.000 deg`, `300.000 mm`.
#[must_use]
pub fn input_in(at: InputValue, decimals: usize) -> String {
    fixed_in(at.input.shown(at.value), decimals, at.input.shown_in().0)
}

/// A number with enough digits to distinguish it from another number.
pub fn told_apart(value: f64, other: f64) -> String {
    let differ = |digits: &usize| significant(value, *digits) != significant(other, *digits);
    significant(value, (6..15).find(differ).unwrap_or(15))
}

/// An input's name, value and unit: `crank angle 41.000 deg`, `slide 300.000 mm`.
#[must_use]
pub fn input_told(at: InputValue, decimals: usize) -> String {
    format!("{} {}", at.input.noun(), input_in(at, decimals))
}

/// Significant digits of a quantity in a report.
const SHOWN: usize = 6;

/// Units written with a decimal prefix, each with the smallest value that is written with the prefix kilo.
const PREFIXED: [(&str, f64); 4] = [("N", 1e4), ("N m", 1e4), ("W", 1e3), ("Pa", 1e3)];

/// A quantity in an SI unit, with six significant digits and the decimal prefix that suits its magnitude:
/// `115.101 kN`.
#[must_use]
pub fn quantity(value: f64, unit: &str) -> String {
    let least = PREFIXED.iter().find(|(own, _)| *own == unit).map_or(f64::INFINITY, |(_, least)| *least);
    let (factor, prefix) = match value.abs() {
        size if size >= 1e3 * least => (1e-6, "M"),
        size if size >= least => (1e-3, "k"),
        _ => (1.0, ""),
    };
    with_unit(&significant(value * factor, SHOWN), &format!("{prefix}{unit}"))
}

/// Part of a whole in per cent: `0.2 %`, `34 %`.
#[must_use]
pub fn percent(share: f64) -> String {
    format!("{} %", significant(100.0 * share, 2))
}

/// A number followed by a blank and its unit, or the number alone if the unit is empty.
#[must_use]
pub fn with_unit(number: &str, unit: &str) -> String {
    if unit.is_empty() { number.into() } else { format!("{number} {}", shown(unit)) }
}

/// Whether a value is written as plain decimals: its magnitude is from a thousandth to a hundred thousand.
fn is_plain(value: f64) -> bool {
    (1e-3..1e5).contains(&value.abs())
}

fn rounded(value: f64, digits: usize) -> f64 {
    let decimals = digits.max(1) - 1;
    format!("{value:.decimals$e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_have_three_digits_in_the_shorter_notation() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (0.25, "0.25"),
            (-0.012_345, "-0.0123"),
            (0.001, "0.001"),
            (9.996e-4, "0.001"),
            (9.99e-4, "9.99e-4"),
            (2.622e-14, "2.62e-14"),
            (17.77777, "17.8"),
            (12_345.0, "12300"),
            (99_999.0, "1e5"),
            (1.5e7, "1.5e7"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(error(value), text);
        }
        assert_eq!(error(f64::NAN), "NaN");
        assert_eq!([error_in(0.5, "N m"), error_in(0.5, "")], ["0.5 N·m", "0.5"]);
    }

    #[test]
    fn a_value_has_the_digits_that_its_resolution_allows() {
        for (value, resolution, text) in [
            (17.345_123_04, 1e-4, "17.3451"),
            (17.345_123_04, 4.4e-3, "17.345"),
            (-613.245_5, 0.01, "-613.25"),
            (613.2, 10.0, "610"),
            (-2.622e-14, 1e-10, "0"),
            (-2.622e-14, 1e-16, "-2.62e-14"),
            (123_456.7, 1.0, "1.23457e5"),
            (0.3, 0.0, "0.3"),
            (0.0, 0.0, "0"),
            (1.0, f64::NAN, "1"),
        ] {
            assert_eq!(resolved(value, resolution), text, "{value} to {resolution}");
        }
    }

    #[test]
    fn two_values_show_where_they_differ() {
        for (values, bound, texts) in [
            ([5.137_56, 5.137_82], 1e-3, ["5.1376", "5.1378"]),
            ([0.0, 180.0], 1e-10, ["0", "180.0"]),
            ([7e-15, 180.0], 1e-10, ["0", "180.0"]),
            ([-0.006_972_4, -0.209_174], 1e-12, ["-0.006972", "-0.2092"]),
            ([2.5, 2.5], 1e-3, ["2.500", "2.500"]),
            ([f64::NAN, 2.5], 1e-3, ["NaN", "2.500"]),
            ([2.512_345_678_9, 2.512_345_678_8], 1e-9, ["2.512346", "2.512346"]),
            ([2.512_345_678_9, 2.512_345_678_8], 1e-12, ["2.5123456789", "2.5123456788"]),
        ] {
            assert_eq!(beside(values, bound), texts);
        }
    }

    #[test]
    fn a_quantity_has_six_digits_and_a_prefix() {
        for (value, unit, text) in [
            (115_101.088_59, "N", "115.101 kN"),
            (-6_494.629_4, "N", "-6494.63 N"),
            (2.4e5, "N m", "240 kN·m"),
            (2e8, "Pa", "200 MPa"),
            (0.464_057_601, "kg m^2", "0.464058 kg·m²"),
            (-0.0, "N", "0 N"),
        ] {
            assert_eq!(quantity(value, unit), text);
        }
    }

    #[test]
    fn values_rounded_to_zero_have_no_sign() {
        assert_eq!([fixed(-0.000_000_4, 6), fixed(-0.000_4, 3)], ["0.000000", "0.000"]);
        assert_eq!([fixed(-0.06, 1), fixed(-10.0, 0), fixed(0.0, 2)], ["-0.1", "-10", "0.00"]);
        assert_eq!([percent(0.344), percent(1.0), percent(0.0), percent(2.5e-7)], ["34 %", "100 %", "0 %", "2.5e-5 %"]);
    }
}
