//! The chord method and its inverse, graphical integration.
//!
//! The slope of the chord over an interval is the mean of the derivative over this interval.
//! As an approximation of the derivative at the middle of the interval, the slope has the error h^2 f'''/24 and terms
//! of higher order.
//! For a sine of angular frequency k, the slope is exactly sin(k h/2) / (k h/2) times the derivative.
//! In graphical integration, the integral grows over an interval by the derivative at the middle times the length.

/// Returns the midpoints of the intervals between `places`.
pub fn middles(places: &[f64]) -> Vec<f64> {
    places.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])).collect()
}

/// Returns the slopes of the chords between the points (`places`, `values`).
/// The slopes approximate the derivative at the midpoints of the intervals.
pub fn slopes(places: &[f64], values: &[f64]) -> Vec<f64> {
    places.windows(2).zip(values.windows(2)).map(|(x, y)| (y[1] - y[0]) / (x[1] - x[0])).collect()
}

/// Integrates a function that has the value `start` at the first of `places`.
/// The function has the derivatives `rates` at the midpoints of the intervals between `places`.
/// Returns the values at `places`.
pub fn integral(start: f64, places: &[f64], rates: &[f64]) -> Vec<f64> {
    let mut sum = start;
    let steps = places.windows(2).zip(rates).map(|(x, rate)| {
        sum += rate * (x[1] - x[0]);
        sum
    });
    std::iter::once(start).chain(steps).collect()
}

/// Returns the slopes of a curve that is periodic over `places`.
/// The curve has the values `rates` at the midpoints of the intervals between `places`.
/// The result has a slope for each of `places` except the first.
pub fn closed_slopes(places: &[f64], rates: &[f64]) -> Vec<f64> {
    let mut middles = middles(places);
    let mut values = rates.to_vec();
    if let (Some(&first), Some(&rate), [start, .., end]) = (middles.first(), rates.first(), places) {
        middles.push(first + (end - start));
        values.push(rate);
    }
    slopes(&middles, &values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn places(n: usize) -> Vec<f64> {
        (0..=n).map(|k| TAU * k as f64 / n as f64).collect()
    }

    #[test]
    fn the_chord_method_reduces_a_sine_by_its_known_factor() {
        for (n, k) in [(12, 1.0), (12, 3.0), (48, 5.0)] {
            let x = places(n);
            let half = k * TAU / n as f64 / 2.0;
            let factor = half.sin() / half;
            let sine: Vec<f64> = x.iter().map(|x| (k * x).sin()).collect();
            let velocity = slopes(&x, &sine);
            let acceleration = closed_slopes(&x, &velocity);
            assert_eq!((velocity.len(), acceleration.len()), (n, n));
            // The bound is the rounding error of the sines, amplified by each division by h.
            let bound = |order: i32| 8.0 * f64::EPSILON * (n as f64 / TAU * 2.0).powi(order);
            for (x, v) in middles(&x).iter().zip(&velocity) {
                assert!((v - factor * k * (k * x).cos()).abs() <= bound(1), "{v}");
            }
            for (x, a) in x[1..].iter().zip(&acceleration) {
                assert!((a + factor * factor * k * k * (k * x).sin()).abs() <= bound(2), "{a}");
            }
        }
    }

    #[test]
    fn integration_inverts_the_chord_method() {
        let x = [0.0, 0.1, 0.35, 0.4, 1.0];
        let f = [2.0, -1.0, 0.5, 7.0, 3.0];
        for (back, value) in integral(f[0], &x, &slopes(&x, &f)).iter().zip(f) {
            // Every interval adds the rounding errors of one division, one product and one sum.
            // The function's values are at most 7.
            assert!((back - value).abs() <= 7.0 * 12.0 * f64::EPSILON);
        }
    }

    #[test]
    fn empty_input_gives_empty_output() {
        assert!(slopes(&[], &[]).is_empty() && closed_slopes(&[], &[]).is_empty());
        assert_eq!(integral(3.0, &[1.0], &[]), [3.0]);
    }
}
