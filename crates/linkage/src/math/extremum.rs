//! Extremes of a function of one variable between bounds. All searches for extremes in the project use this module.

/// Number of golden section steps of [`greatest`]. The remaining interval is 1e-9 of the distance between two samples.
/// The largest value is then exact up to rounding error.
const REFINEMENTS: usize = 44;

/// Encloses the position of the largest value between `low` and `high` by golden section (Kiefer 1953).
/// The search performs `steps` steps.
/// Each step reduces the interval to 0.618 of its length. Returns both ends of the remaining interval.
/// If the function has several extremes in the interval, the remaining interval encloses one extreme.
/// After about 40 steps, the interval's length is 1e-8 of its original length, the square root of the rounding error.
/// Further steps gain little.
/// NaN counts as less than any number.
///
/// # Errors
/// The first error of `value`.
pub fn golden<E>(
    [mut low, mut high]: [f64; 2],
    steps: usize,
    mut value: impl FnMut(f64) -> Result<f64, E>,
) -> Result<[f64; 2], E> {
    let share = (5f64.sqrt() - 1.0) / 2.0;
    let (mut left, mut right) = (high - share * (high - low), low + share * (high - low));
    let (mut at_left, mut at_right) = (value(left)?, value(right)?);
    for _ in 0..steps {
        if at_left > at_right || at_right.is_nan() {
            (high, right, at_right) = (right, left, at_left);
            left = high - share * (high - low);
            at_left = value(left)?;
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + share * (high - low);
            at_right = value(right)?;
        }
    }
    Ok([low, high])
}

/// Position and value of the largest value found.
/// The search starts from the largest sample and uses golden section between the two neighbours of this sample.
/// `places` are ascending positions, `samples` the values at these positions.
/// `value` may fail, for example at a pose that cannot be reached.
/// If a sample or a computed value is NaN, the largest value is unknown and the result is NaN.
///
/// # Errors
/// The first error of `value`.
///
/// # Panics
/// If there is no sample.
pub fn greatest<E>(
    places: &[f64],
    samples: &[f64],
    value: &mut dyn FnMut(f64) -> Result<f64, E>,
) -> Result<(f64, f64), E> {
    if let Some(unknown) = samples.iter().position(|sample| sample.is_nan()) {
        return Ok((places[unknown], f64::NAN));
    }
    let top = (0..samples.len()).max_by(|&a, &b| samples[a].total_cmp(&samples[b])).expect("there is a sample");
    let mut best = (places[top], samples[top]);
    let between = [places[top.saturating_sub(1)], places[(top + 1).min(places.len() - 1)]];
    golden(between, REFINEMENTS, |place| {
        let found = value(place)?;
        if found > best.1 || found.is_nan() {
            best = (place, found);
        }
        Ok(found)
    })?;
    Ok(best)
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use proptest::prelude::*;

    use super::*;
    use crate::math::KeepNan;

    #[test]
    fn a_peak_between_samples_is_found() {
        let mut value = |x: f64| Ok::<f64, ()>(3.0 - (x - 0.3).powi(2));
        let places = [-1.0, 0.0, 1.0, 2.0];
        let samples = places.map(|x| value(x).unwrap());
        let (place, peak) = greatest(&places, &samples, &mut value).unwrap();
        // A function is flat at its maximum, so the position is accurate to half the digits.
        // The value is accurate to all digits.
        assert!((place - 0.3).abs() < 1e-7 && (peak - 3.0).abs() < 1e-15, "{place} {peak}");
        assert_eq!(greatest(&places, &samples, &mut |_| Err("cannot be reached")), Err("cannot be reached"));
    }

    #[test]
    fn nan_is_never_skipped() {
        let mut value = |x: f64| Ok::<f64, ()>(x);
        for unknown in [f64::NAN, -f64::NAN] {
            let found = greatest(&[0.0, 1.0, 2.0], &[0.0, unknown, 2.0], &mut value).unwrap();
            assert!(found.0 == 1.0 && found.1.is_nan(), "{found:?}");
        }
        // Only the second computed value is NaN. The result must be NaN although the later values are numbers.
        let mut count = 0;
        let mut gap = |x: f64| {
            count += 1;
            Ok::<f64, ()>(if count == 2 { f64::NAN } else { -x * x })
        };
        assert!(greatest(&[-1.0, 0.0, 1.0], &[-1.0, 0.0, -1.0], &mut gap).unwrap().1.is_nan());
    }

    proptest! {
        /// The remaining interval contains the maximum, also if the maximum is at an end of the original interval.
        #[test]
        fn golden_section_keeps_the_peak(low in -5.0f64..5.0, width in 0.1f64..10.0, share in 0.0f64..=1.0, sharp in 0.1f64..4.0) {
            let (high, peak) = (low + width, low + share * width);
            let value = |x: f64| Ok::<f64, Infallible>(-((x - peak).abs() / width).powf(sharp));
            let Ok([a, b]) = golden([low, high], 30, value);
            prop_assert!(a - 1e-12 <= peak && peak <= b + 1e-12 && low <= a && b <= high, "{a} {peak} {b}");
            prop_assert!(b - a < 2e-6 * width, "{}", b - a);
        }

        /// The result is at least as large as every sample. The result is below the true largest value by at most a
        /// known bound.
        #[test]
        fn the_maximum_is_not_below_any_sample(c in prop::collection::vec(-1.0f64..1.0, 6), count in 40usize..80) {
            let f = |x: f64| (0..3).map(|k| c[2 * k] * (k as f64 * x + c[2 * k + 1]).sin()).sum::<f64>();
            let places: Vec<f64> = (0..=count).map(|k| 7.0 * k as f64 / count as f64).collect();
            let samples: Vec<f64> = places.iter().map(|&x| f(x)).collect();
            let (place, value) = greatest(&places, &samples, &mut |x| Ok::<f64, ()>(f(x))).unwrap();
            prop_assert!(samples.iter().all(|&sample| value >= sample) && value == f(place));
            let dense = (0..7000).map(|k| f(k as f64 * 1e-3)).fold(f64::NEG_INFINITY, f64::larger);
            // If two maxima are nearly equal, the samples may select the wrong maximum.
            // Near each maximum the function is about a parabola.
            // The result is then too small by at most the height by which this parabola rises between two samples.
            prop_assert!(value >= dense - 5.0 * (7.0 / count as f64).powi(2), "{value} {dense}");
        }
    }
}
