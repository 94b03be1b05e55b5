//! Statistics of lists of numbers: quantiles, means, differences and ranges.

use std::f64::consts::TAU;

use crate::math::KeepNan;

/// Quantile `q` (0 to 1) of values sorted in ascending order.
/// The quantile is interpolated linearly between neighbouring values (type 7 of Hyndman and Fan 1996).
///
/// Returns 0 for an empty slice.
#[must_use]
pub fn quantile(sorted: &[f64], q: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return 0.0 };
    let place = q.clamp(0.0, 1.0) * last as f64;
    let low = place.floor() as usize;
    let high = (low + 1).min(last);
    sorted[low] + (sorted[high] - sorted[low]) * (place - low as f64)
}

/// Indices of `values` in ascending order of value; equal values keep their order.
#[must_use]
pub fn ascending(values: &[f64]) -> Vec<usize> {
    let mut places: Vec<usize> = (0..values.len()).collect();
    places.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    places
}

/// Root mean square of `values`; 0 for an empty list.
#[must_use]
pub fn rms(values: &[f64]) -> f64 {
    let sum = values.iter().fold(0.0, |sum, value| sum + value * value);
    if values.is_empty() { 0.0 } else { (sum / values.len() as f64).sqrt() }
}

/// Differences `theirs` minus `ours`.
/// A `periodic` quantity is an angle (rad).
/// For a periodic quantity, the same number of whole turns is subtracted from all differences.
/// After the subtraction, the first difference is within half a turn.
#[must_use]
pub fn differences(ours: &[f64], theirs: &[f64], periodic: bool) -> Vec<f64> {
    let turns = turns(ours, theirs, periodic);
    ours.iter().zip(theirs).map(|(a, b)| b - a - turns).collect()
}

/// Largest absolute value of the [differences]; NaN if one of them is NaN.
#[must_use]
pub fn largest_difference(ours: &[f64], theirs: &[f64], periodic: bool) -> f64 {
    let turns = turns(ours, theirs, periodic);
    ours.iter().zip(theirs).fold(0.0, |most: f64, (a, b)| (b - a - turns).abs().larger(most))
}

fn turns(ours: &[f64], theirs: &[f64], periodic: bool) -> f64 {
    match (periodic, ours.first(), theirs.first()) {
        (true, Some(a), Some(b)) => TAU * ((b - a) / TAU).round(),
        (true | false, _, _) => 0.0,
    }
}

/// Absolute values in ascending order. NaN comes last.
#[must_use]
pub fn sorted_sizes(values: &[f64]) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// `part` as a fraction of `whole`. A `part` of 0 gives 0, even if `whole` is 0.
#[must_use]
pub fn share(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

/// The smallest and the largest value; NaN if a value is NaN.
/// For an empty list, the smallest value is plus infinity and the largest value is minus infinity.
#[must_use]
pub fn ends(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let none = [f64::INFINITY, f64::NEG_INFINITY];
    values.into_iter().fold(none, |[low, high], value| [low.smaller(value), high.larger(value)])
}

/// The distinct items, in the order of their first occurrence.
pub fn distinct<T: PartialEq>(all: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for one in all {
        if !found.contains(&one) {
            found.push(one);
        }
    }
    found
}

/// Half the distance between the smallest and the largest value. NaN if a value is NaN; 0 for an empty slice.
#[must_use]
pub fn half_range(values: &[f64]) -> f64 {
    let Some(&first) = values.first() else { return 0.0 };
    let (low, high) = values.iter().fold((first, first), |(low, high), &v| (low.smaller(v), high.larger(v)));
    (high - low) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_interpolate() {
        let values = [0.0, 1.0, 2.0, 3.0, 4.0];
        assert_eq!(quantile(&values, 0.75), 3.0);
        assert_eq!(quantile(&values, 0.99), 3.96);
        assert_eq!(quantile(&[], 0.5), 0.0);
    }

    #[test]
    fn range_and_rms() {
        assert_eq!(half_range(&[-1.0, 3.0, 2.0]), 2.0);
        assert!(half_range(&[1.0, f64::NAN]).is_nan());
        assert_eq!(rms(&[3.0, 4.0, 0.0, 0.0]), 2.5);
    }
}
