//! Uncertainty that results from rounded instants.

use formula::Rounded;
use linkage::math::KeepNan;

/// Printed instants count as exact if their pattern is improbable for rounded instants.
/// The probability of the pattern by chance must be at most 1 / `EVIDENCE`.
/// By chance, n steps between rounded instants look equal with the probability 1 / n.
/// The step of rounded instants, in units of the last digit, is divisible by two with the probability 1 / 2 and by five
/// with the probability 1 / 5.
/// A trailing zero therefore occurs by chance with the probability 1 / 10.
const EVIDENCE: f64 = 50.0;

/// Whether printed instants are exact values that someone chose, such as 0, 0.1 and 0.2, and not rounded values.
/// Chosen instants are multiples of one step.
/// In addition, the number of multiples or the roundness of the step must show that no other step gives the same
/// printed instants.
pub fn chosen(values: &[Rounded]) -> bool {
    chosen_as(values, Sort::Any)
}

/// Whether printed instants in degrees are exact values that someone chose, and not rounded values.
/// Whole degrees at equal steps count as chosen if the first instant is a multiple of the step.
/// Whole degrees at unequal steps, such as 0, 30, 45, 60 and 90, count as chosen if they have a common divisor.
/// The divisor must be so large that random whole numbers would hardly have it in common.
/// All other instants are judged as by [`chosen`].
pub fn degrees_chosen(values: &[Rounded]) -> bool {
    let are_whole = values.iter().all(|at| at.value.fract() == 0.0);
    chosen_as(values, if are_whole { Sort::WholeDegrees } else { Sort::Any })
}

#[derive(Clone, Copy, PartialEq)]
enum Sort {
    Any,
    WholeDegrees,
}

fn chosen_as(values: &[Rounded], sort: Sort) -> bool {
    let Some(first) = values.first() else { return false };
    let size = values.iter().map(|at| at.value.abs()).fold(0.0, f64::larger);
    let step = values.get(1).map_or(first.value, |second| second.value - first.value);
    let is_step = |pair: &[Rounded]| (pair[1].value - pair[0].value - step).abs() <= 8.0 * f64::EPSILON * size;
    let is_first_one = first.value == 0.0 || is_multiple(first.value, step);
    // Each `error` is half a unit of the last printed digit, times 1 + 1e-9 as a margin for rounding errors.
    // The division by 1 + 1e-9 removes this margin.
    let unit = 2.0 * values.iter().map(|at| at.error).fold(0.0, f64::larger) / (1.0 + 1e-9);
    if !is_first_one || !values.windows(2).all(is_step) {
        return are_multiples(values, unit, sort);
    }
    sort == Sort::WholeDegrees
        || is_multiple(step, unit) && evidence((values.len() - 1) as f64, (step / unit).abs().round()) >= EVIDENCE
}

fn is_multiple(value: f64, of: f64) -> bool {
    (value / of - (value / of).round()).abs() <= 1e-6 * (value / of).abs()
}

/// Evidence that a step of `round` units was chosen.
/// The evidence is the number of multiples, times the factors two and five in `round`.
fn evidence(multiples: f64, mut round: f64) -> f64 {
    let mut evidence = if multiples < 1.0 { 1.0 } else { multiples };
    // Doubles above 1e15 are not reliable whole numbers, so they give no evidence.
    if !(round < 1e15) {
        return 0.0;
    }
    for prime in [2.0, 5.0] {
        while evidence < EVIDENCE && round % prime == 0.0 {
            (evidence, round) = (evidence * prime, round / prime);
        }
    }
    evidence
}

/// Upper limit of the number of rows that count as independent in the search for a common divisor.
/// Rounded instants with a common step are not independent of each other, so the limit is low.
const INDEPENDENT: i32 = 3;

/// Whether instants at unequal steps are multiples of a chosen step.
/// The instants are counted in units of the last printed digit.
/// If their common divisor is a round number (many factors 2 and 5), the step was probably chosen by a person: for
/// example, if all instants end in zeros.
/// By chance, n independent whole degrees have a common divisor d only with the probability 1 / d^n.
fn are_multiples(values: &[Rounded], unit: f64, sort: Sort) -> bool {
    let (mut divisor, mut count) = (0u64, 0i32);
    for at in values.iter().filter(|at| at.value != 0.0) {
        let units = (at.value / unit).abs();
        if !(units < 1e12) || (units - units.round()).abs() > 1e-3 {
            return false;
        }
        divisor = common(divisor, units.round() as u64);
        count = count.saturating_add(1);
    }
    // A single number is always a multiple of itself, so it gives no evidence.
    if count < 2 {
        return false;
    }
    let independent = (count - 1).min(INDEPENDENT);
    evidence(1.0, divisor as f64) >= EVIDENCE
        || sort == Sort::WholeDegrees && (divisor as f64).powi(independent) >= EVIDENCE
}

/// Greatest common divisor.
fn common(mut one: u64, mut other: u64) -> u64 {
    while other != 0 {
        (one, other) = (other, one % other);
    }
    one
}

/// Safety factor for the slope. Near an inflection a curve is steeper than the two secants next to a row.
/// With eight rows per period the curve is steeper than these secants by a ninth.
const STEEPER: f64 = 1.2;

/// Uncertainty that rounded instants cause in a column, from the slope of the column.
/// For each row the uncertainty is a slope times the uncertainty `slack` of the row's instant.
/// The slope is taken from the steeper of the two neighbouring secants, and multiplied by a safety factor.
/// `order` lists the rows in ascending order of the instants `at`. Angles may jump by a `turn`.
pub fn drift(values: &[Rounded], at: &[f64], slack: &[f64], order: &[usize], turn: Option<f64>) -> Vec<f64> {
    let mut drift = vec![0.0; values.len()];
    for pair in order.windows(2) {
        let gap = values[pair[1]].value - values[pair[0]].value;
        let gap = turn.map_or(gap, |turn| gap - turn * (gap / turn).round());
        let span = at[pair[1]] - at[pair[0]];
        let slope = if span > 0.0 && gap.is_finite() { (gap / span).abs() } else { 0.0 };
        for &row in pair {
            drift[row] = drift[row].larger(STEEPER * slope * slack[row]);
        }
    }
    drift
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cell::{TableCell, numbers};

    fn of(texts: &[String]) -> Vec<Rounded> {
        numbers(&texts.iter().map(|text| TableCell::parse(text).unwrap()).collect::<Vec<_>>())
    }

    #[test]
    fn a_step_is_recognised_only_if_unambiguous() {
        let list = |count: u32, of: &dyn Fn(f64) -> String| (0..count).map(|row| of(row.into())).collect::<Vec<_>>();
        for (count, print, expected) in [
            (361, &(|row: f64| format!("{}", (row * 10.0).round() / 1e3)) as &dyn Fn(f64) -> String, true),
            (4, &|row| format!("{:.6}", 0.01 * row), true),
            (100, &|row| format!("{row}"), true),
            // The step is 2.777... ms. After rounding, the instants of three rows look equally spaced, but the rounded
            // instants are not exact.
            (3, &|row| format!("{:.0}", 2.7777 * row), false),
            (9, &|row| format!("{:.6}", row / 780.0), false),
            (73, &|row| format!("{:.6}", row / 780.0), false),
            // The step is a round number, but the first instant is no multiple of it, so the instants do not count as
            // chosen.
            (9, &|row| format!("{:.5}", 1.0 / 12.0 + 0.1 * row), false),
            (1, &|_| "0.0417".into(), false),
            (1, &|_| "0".into(), true),
        ] {
            let texts = list(count, print);
            assert_eq!(chosen(&of(&texts)), expected, "{texts:?}");
        }
        assert!(degrees_chosen(&of(&["70".into()])));
        assert!(degrees_chosen(&of(&list(4, &|row| format!("{}", 15.0 * row)))));
        assert!(!degrees_chosen(&of(&["0".into(), "2".into(), "3".into(), "5".into()])));
        // The rule for whole degrees does not apply to fractions of degrees.
        assert!(!degrees_chosen(&of(&["0".into(), "2.7".into(), "5.4".into()])));
        let (degrees, any) = (degrees_chosen as fn(&[Rounded]) -> bool, chosen as fn(&[Rounded]) -> bool);
        for (texts, chosen, expected) in [
            // Whole degrees as in printed tables count as chosen. In a unit other than degrees, the same numbers may be
            // rounded.
            (["0", "30", "45", "60", "90"], degrees, true),
            (["0", "30", "45", "60", "90"], any, false),
            (["0", "3", "5", "8", "10"], degrees, false),
            // The trailing zeros show that these angles are exact.
            (["0.000", "17.000", "46.000", "63.000", "90.000"], degrees, true),
            (["0.000", "0.200", "0.500", "0.600", "1.000"], any, true),
            (["0.0000", "0.0333", "0.0667", "0.2000", "0.5000"], any, false),
            // The instants in the next row are rounded. Only by chance do they look equally spaced.
            (["2.068378", "9.362942", "16.657506", "23.952070", "31.246634"], degrees, false),
        ] {
            assert_eq!(chosen(&of(&texts.map(Into::into))), expected, "{texts:?}");
        }
    }

    /// The rows are in descending order of their instants. The value jumps by a whole turn of 6.2, so its actual change
    /// is only 0.2.
    #[test]
    fn drift_follows_the_slope_of_the_column() {
        let values: Vec<Rounded> = [0.5, 0.3, 6.3, 6.1].map(Rounded::exact).to_vec();
        let (at, slack, order) = ([3.0, 2.0, 1.0, 0.0], [0.01, 0.02, 0.0, 0.03], [3, 2, 1, 0]);
        let of = |turn: Option<f64>| drift(&values, &at, &slack, &order, turn);
        let near = |own: &[f64], slopes: [f64; 4]| {
            own.iter()
                .zip(slopes)
                .zip(slack)
                .all(|((own, slope), slack)| (slope * slack * (1.0 - 1e-9)..=1.5 * slope * slack).contains(own))
        };
        assert!(near(&of(Some(6.2)), [0.2; 4]), "{:?}", of(Some(6.2)));
        // Without a turn, the jump counts as a slope.
        assert!(near(&of(None), [0.2, 6.0, 6.0, 0.2]), "{:?}", of(None));
    }
}
