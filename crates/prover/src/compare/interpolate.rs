//! Values between the rows of a table, with the interpolation error.

use columns::MISSING;
use formula::Rounded;
use linkage::math::KeepNan;

/// Number of rows needed to interpolate: four for a cubic, and one more to estimate its error.
const FEWEST: usize = 5;
/// Between rows, the fourth divided difference is assumed to be at most this multiple of a measured difference.
/// The measured difference is the largest fourth divided difference in nearby windows of five rows.
const SAFETY: f64 = 2.0;

/// A column in ascending order of its instants.
pub(super) struct Course {
    at: Vec<f64>,
    values: Vec<Rounded>,
    /// Absolute fourth divided difference of every five successive rows.
    fourth: Vec<f64>,
}

impl Course {
    /// Creates a column from its instants and values, sorted by instants.
    /// Rows without a number are left out. Angles may jump by multiples of `turn`.
    pub(super) fn new(at: &[f64], values: &[Rounded], turn: Option<f64>) -> Self {
        let rows: Vec<(f64, Rounded)> =
            at.iter().copied().zip(values.iter().copied()).filter(|(_, own)| own.value.is_finite()).collect();
        let at: Vec<f64> = rows.iter().map(|(at, _)| *at).collect();
        let values = unwound(rows.into_iter().map(|(_, value)| value).collect(), turn);
        let window = |first: usize| {
            let mut own: Vec<f64> = values[first..first + FEWEST].iter().map(|own| own.value).collect();
            for order in 1..FEWEST {
                for index in 0..FEWEST - order {
                    own[index] = (own[index + 1] - own[index]) / (at[first + index + order] - at[first + index]);
                }
            }
            own[0].abs()
        };
        let fourth = (0..(at.len() + 1).saturating_sub(FEWEST)).map(window).collect();
        Course { at, values, fourth }
    }

    /// The value at an instant, interpolated by the cubic through the four rows around the instant.
    /// The value's error is the error of the rows plus the first neglected term.
    /// The value is NaN outside the rows, or if the rows are too few.
    pub(super) fn value(&self, wanted: f64) -> Rounded {
        let next = self.at.partition_point(|&at| at < wanted);
        if next == 0 || next == self.at.len() || self.at.len() < FEWEST {
            return MISSING;
        }
        let first = next.saturating_sub(2).min(self.at.len() - 4);
        let rows = first..first + 4;
        let weight = |row: usize| -> f64 {
            let others = rows.clone().filter(|&other| other != row);
            others.map(|other| (wanted - self.at[other]) / (self.at[row] - self.at[other])).product()
        };
        let [value, error] = rows.clone().fold([0.0, 0.0], |[sum, error], row| {
            let (weight, own) = (weight(row), self.values[row]);
            [sum + weight * own.value, error + weight.abs() * own.error]
        });
        let near = first.saturating_sub(2)..(first + 2).min(self.fourth.len());
        let fourth = self.fourth[near].iter().copied().fold(0.0, f64::larger);
        let distances: f64 = rows.map(|row| (wanted - self.at[row]).abs()).product();
        Rounded { value, error: error + SAFETY * fourth * distances }
    }
}

/// Removes jumps by multiples of `turn` between the rows of an angle.
fn unwound(mut values: Vec<Rounded>, turn: Option<f64>) -> Vec<Rounded> {
    let Some(turn) = turn else { return values };
    for row in 1..values.len() {
        let gap = values[row].value - values[row - 1].value;
        values[row].value -= turn * (gap / turn).round();
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolation_is_exact_for_cubics_and_bounded_for_sines() {
        let at: Vec<f64> = (0..40).map(|row| 0.2 * f64::from(row) + 0.03 * f64::from(row % 3)).collect();
        let of = |f: &dyn Fn(f64) -> f64| {
            let values: Vec<Rounded> = at.iter().map(|&at| Rounded::exact(f(at))).collect();
            Course::new(&at, &values, None)
        };
        let (cubic, sine) = (of(&|x| x * x * (x - 3.0)), of(&f64::sin));
        for step in 1..=770 {
            let x = 0.01 * f64::from(step);
            let (exact, found) = (x * x * (x - 3.0), cubic.value(x));
            assert!((found.value - exact).abs() < 1e-11 && found.error < 1e-9, "{x}: {found:?}");
            let found = sine.value(x);
            assert!((found.value - x.sin()).abs() <= found.error + 1e-15 && found.error < 5e-4, "{x}: {found:?}");
        }
        assert!(cubic.value(-0.1).value.is_nan() && cubic.value(8.0).value.is_nan());
    }

    #[test]
    fn row_errors_propagate_with_their_weights() {
        let at: Vec<f64> = (0..20).map(f64::from).collect();
        let values: Vec<Rounded> = at.iter().map(|&at| Rounded { value: at, error: 1e-6 }).collect();
        // Midway between two rows the weights are -1/16, 9/16, 9/16 and -1/16.
        // The absolute weights add up to 5/4. So equal errors of the four rows are multiplied by up to 5/4.
        let found = Course::new(&at, &values, None).value(9.5);
        assert!((found.error - 1.25e-6).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn an_angle_that_wraps_is_interpolated_smoothly() {
        let at: Vec<f64> = (0..20).map(f64::from).collect();
        let values: Vec<Rounded> = at.iter().map(|at| Rounded::exact((100.0 * at).rem_euclid(360.0))).collect();
        let found = Course::new(&at, &values, Some(360.0)).value(7.5);
        assert!((found.value - 750.0).abs() < 1e-9 && found.error < 1e-9, "{found:?}");
    }
}
