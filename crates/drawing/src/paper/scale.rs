//! Scale factors of drawings by drafting practice: 1, 2, 2.5 or 5 times a power of ten.

use linkage::math::KeepNan;

/// A number that exceeds a round number by at most this fraction counts as the round number.
/// The fraction allows for the rounding error of a division.
const SAME: f64 = 1e-12;

/// The smallest number of the form 1, 2, 2.5 or 5 times a power of ten that is at least `least`.
/// The result is 1 if `least` is zero, negative, infinite or NaN.
///
/// Neighbouring numbers of this form differ by a factor of two at most.
/// With a scale factor that is rounded up to such a number, the longest vector still fills at least half of the
/// available length.
pub fn round_up(least: f64) -> f64 {
    if !(least > 0.0 && least.is_finite()) {
        return 1.0;
    }
    let power = least.log10().floor() as i32;
    let candidates = (power - 1..=power + 1).flat_map(|n| ["1", "2", "2.5", "5"].map(|m| (m, n)));
    // The numbers are parsed from text. A product such as 2 * 0.01 could have a rounding error, and would then be
    // printed with many digits.
    let numbers = candidates.filter_map(|(m, n)| format!("{m}e{n}").parse::<f64>().ok());
    numbers.filter(|&number| number >= least * (1.0 - SAME)).fold(f64::INFINITY, f64::smaller)
}

/// A round number: the scale factor (units per millimetre) at which `largest` is at most `room` millimetres long, but
/// longer than half of `room`.
pub fn factor(largest: f64, room: f64) -> f64 {
    round_up(largest / room)
}

/// Formats a multiple of `step` with as many decimals as `step` has.
/// If `step` is below 1e-4, or 1e6 or more, the number has an exponent.
pub fn multiple(value: f64, step: f64) -> String {
    if (1e-4..1e6).contains(&step) {
        let decimals = format!("{step}").split_once('.').map_or(0, |(_, decimals)| decimals.len());
        return format!("{value:.decimals$}");
    }
    if value == 0.0 {
        return "0".into();
    }
    // A computed multiple of a round number may differ from the round value by a rounding error.
    // The value is therefore rounded to ten significant digits.
    let round: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    format!("{round:e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_round_and_use_the_space() {
        for k in 0..400 {
            let largest = 1e-7 * 1.11f64.powi(k);
            let mu = factor(largest, 100.0);
            let mantissa = format!("{mu:e}");
            let mantissa = mantissa.split('e').next().unwrap();
            assert!(["1", "2", "2.5", "5"].contains(&mantissa), "{mu}");
            let paper = largest / mu;
            assert!(paper > 50.0 * (1.0 - 1e-9) && paper <= 100.0 * (1.0 + 1e-9), "{largest}: {paper} mm");
        }
    }

    #[test]
    fn round_up_keeps_round_numbers_and_maps_zero_and_nan_to_one() {
        assert_eq!([round_up(0.02), round_up(2.5), round_up(500.0)], [0.02, 2.5, 500.0]);
        assert_eq!([round_up(0.0), round_up(f64::NAN), round_up(f64::INFINITY)], [1.0; 3]);
    }
}
