//! The greatest value of a function that is known at samples.

/// Golden section steps: the bracket shrinks to 1e-9 of the distance of two samples, where the value is exact to rounding.
const REFINEMENTS: usize = 44;

/// Place and value of the greatest sample or, by golden section between its neighbours (Kiefer 1953), of the greatest value found there.
/// `places` ascend, `samples` are the values there; `value` may fail, as with a pose that cannot be reached.
///
/// # Errors
/// The first of `value`.
///
/// # Panics
/// Without a sample.
pub fn greatest<E>(
    places: &[f64],
    samples: &[f64],
    value: &mut dyn FnMut(f64) -> Result<f64, E>,
) -> Result<(f64, f64), E> {
    let top = (0..samples.len()).max_by(|&a, &b| samples[a].total_cmp(&samples[b])).expect("there is a sample");
    let mut best = (places[top], samples[top]);
    let (mut low, mut high) = (places[top.saturating_sub(1)], places[(top + 1).min(places.len() - 1)]);
    let ratio = (5f64.sqrt() - 1.0) / 2.0;
    let mut at = |place: f64| -> Result<f64, E> {
        let found = value(place)?;
        if found > best.1 {
            best = (place, found);
        }
        Ok(found)
    };
    let (mut left, mut right) = (high - ratio * (high - low), low + ratio * (high - low));
    let (mut at_left, mut at_right) = (at(left)?, at(right)?);
    for _ in 0..REFINEMENTS {
        if at_left > at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - ratio * (high - low);
            at_left = at(left)?;
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + ratio * (high - low);
            at_right = at(right)?;
        }
    }
    Ok(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_between_samples_is_found() {
        let mut value = |x: f64| Ok::<f64, ()>(3.0 - (x - 0.3).powi(2));
        let places = [-1.0, 0.0, 1.0, 2.0];
        let samples = places.map(|x| value(x).unwrap());
        let (place, peak) = greatest(&places, &samples, &mut value).unwrap();
        // Flat at the top: half the digits of the place, all of the value.
        assert!((place - 0.3).abs() < 1e-7 && (peak - 3.0).abs() < 1e-15, "{place} {peak}");
        assert_eq!(greatest(&places, &samples, &mut |_| Err("out of reach")), Err("out of reach"));
    }
}
