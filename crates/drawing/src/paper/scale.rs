//! Scale factors of drawings by drafting practice: 1, 2, 2.5 or 5 times a power of ten.

use linkage::math::KeepNan;

/// Share by which a number may exceed a round one and still count as round. It allows for the quotient's rounding
/// error.
const SAME: f64 = 1e-12;

/// The smallest of the numbers 1, 2, 2.5 or 5 times a power of ten that is at least `least`.
/// It is 1 if `least` is not positive and finite.
///
/// Neighbouring numbers differ by a factor of two at most.
/// A vector drawn with this number therefore fills more than half of the length that `least` corresponds to.
#[must_use]
pub fn round_up(least: f64) -> f64 {
    if !(least > 0.0 && least.is_finite()) {
        return 1.0;
    }
    let power = least.log10().floor() as i32;
    let candidates = (power - 1..=power + 1).flat_map(|n| ["1", "2", "2.5", "5"].map(|m| (m, n)));
    // Parsed from text, so that 0.02 is the double nearest to 0.02 and is printed as such.
    let numbers = candidates.filter_map(|(m, n)| format!("{m}e{n}").parse::<f64>().ok());
    numbers.filter(|&number| number >= least * (1.0 - SAME)).fold(f64::INFINITY, f64::smaller)
}

/// Scale factor (units per millimetre) with which `largest` is drawn at most `room` millimetres long, and more than
/// half
/// as long.
#[must_use]
pub fn factor(largest: f64, room: f64) -> f64 {
    round_up(largest / room)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_round_and_fill_the_room() {
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
    fn a_round_number_is_its_own_factor_and_nothing_is_one() {
        assert_eq!([round_up(0.02), round_up(2.5), round_up(500.0)], [0.02, 2.5, 500.0]);
        assert_eq!([round_up(0.0), round_up(f64::NAN), round_up(f64::INFINITY)], [1.0; 3]);
    }
}
