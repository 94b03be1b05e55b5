//! Numbers on the command line: the allowed values, and the messages about invalid values.

use crate::sentences;
use std::fmt::Display;
use std::str::FromStr;

use design::relations::MOST_DEGREE;
use scenario::engine::MOST_TIMES;

pub(super) type Parsed<T> = std::result::Result<T, String>;

/// A finite number.
pub(super) fn finite(text: &str) -> Parsed<f64> {
    allowed(text, sentences::A_FINITE_NUMBER_SUCH_AS, |_| true)
}

/// A finite number greater than zero.
pub(super) fn positive(text: &str) -> Parsed<f64> {
    allowed(text, sentences::A_FINITE_NUMBER_GREATER_THAN, |number| number > 0.0)
}

/// A finite number that is not negative.
pub(super) fn not_negative(text: &str) -> Parsed<f64> {
    allowed(text, sentences::A_FINITE_NUMBER_THAT_IS_OR_GREATER, |number| number >= 0.0)
}

/// A finite number other than zero.
pub(super) fn not_zero(text: &str) -> Parsed<f64> {
    allowed(text, sentences::A_FINITE_NUMBER_THAT_IS_NOT, |number| number != 0.0)
}

/// A number above 0 and below 1.
pub(super) fn share(text: &str) -> Parsed<f64> {
    allowed(text, sentences::A_NUMBER_BETWEEN_AND_SUCH_AS, |number| number > 0.0 && number < 1.0)
}

/// A number above 0 and at most 1.
pub(super) fn efficiency(text: &str) -> Parsed<f64> {
    allowed(text, sentences::A_NUMBER_ABOVE_AND_AT_MOST, |number| number > 0.0 && number <= 1.0)
}

/// A whole number of at least one.
pub(super) fn count(text: &str) -> Parsed<usize> {
    let count = text.trim().parse().ok().filter(|count| *count > 0);
    count.ok_or_else(|| sentences::EXPECTED_A_WHOLE_NUMBER_FROM_ON.into())
}

/// A degree of polynomials.
pub(super) fn degree(text: &str) -> Parsed<usize> {
    from_one(text, MOST_DEGREE)
}

/// Longest table of solutions. The time to make the table grows with the square of its length.
const MOST_ROWS: usize = 1000;

/// A row of a table of solutions.
pub(super) fn row(text: &str) -> Parsed<usize> {
    from_one(text, MOST_ROWS)
}

/// A whole number from 1 to `most`.
fn from_one(text: &str, most: usize) -> Parsed<usize> {
    let number = text.trim().parse().ok().filter(|number| (1..=most).contains(number));
    number.ok_or_else(|| sentences::expected_a_number_from_one_to(&most))
}

/// A number of extrapolations.
pub(super) fn times(text: &str) -> Parsed<usize> {
    let times = text.trim().parse().ok().filter(|times| *times <= MOST_TIMES);
    times.ok_or_else(|| sentences::expected_a_whole_number_from_to(&MOST_TIMES))
}

/// Reads a decimal number; `such` names the kind of number that the option expects.
///
/// # Errors
/// A message that names the expected kind of number, `such`.
pub(super) fn decimal(text: &str, such: impl Display) -> Parsed<f64> {
    let text = text.trim();
    match f64::from_str(text) {
        Ok(number) if number.is_finite() => Ok(number),
        _ if text.contains(',') && f64::from_str(&text.replacen(',', ".", 1)).is_ok() => {
            Err(sentences::expected_decimals_take_a_point(&such, &(text.replacen(',', ".", 1))))
        }
        _ => Err(format!("expected {such}")),
    }
}

fn allowed(text: &str, such: &str, is_allowed: impl Fn(f64) -> bool) -> Parsed<f64> {
    let number = decimal(text, such)?;
    if is_allowed(number) { Ok(number) } else { Err(format!("expected {such}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_allowed_numbers_are_accepted() {
        assert_eq!(
            [finite("-1e3"), positive("0.5"), not_negative(" 0"), not_zero("-2")],
            [Ok(-1e3), Ok(0.5), Ok(0.0), Ok(-2.0)]
        );
        assert_eq!((share("1e-4"), efficiency("1"), count("3")), (Ok(1e-4), Ok(1.0), Ok(3)));
        for read in [finite, positive, not_negative, not_zero, share, efficiency] {
            for text in ["nan", "inf", "-inf", "1e999", "", "x", "1 2"] {
                let told = read(text).unwrap_err();
                assert!(told.starts_with("expected ") && !told.contains("decimals"), "{text}: {told}");
            }
            assert!(read("30,5").unwrap_err().ends_with("; write decimals with a point: 30.5"));
        }
        for refused in [
            positive("0"),
            positive("-1"),
            not_negative("-1"),
            not_zero("0"),
            share("1"),
            share("0"),
            efficiency("1.1"),
        ] {
            assert!(refused.is_err());
        }
        for text in ["0", "-1", "2.5", "", "99999999999999999999"] {
            assert!(count(text).is_err(), "{text}");
        }
    }
}
