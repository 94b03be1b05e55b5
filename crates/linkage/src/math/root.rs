//! Zeros of a function of one variable, with or without bounds. All searches for zeros in the project use this module.
//!
//! The documentation of each search says what the search requires of the function and when the search stops.
//! The function may fail (`E`): the first error ends a search. NaN never counts as a zero.

use super::KeepNan;

/// Whether two values have different signs, or one of the values is zero. NaN has no sign.
#[inline]
#[must_use]
pub fn changes(a: f64, b: f64) -> bool {
    a <= 0.0 && b >= 0.0 || a >= 0.0 && b <= 0.0
}

/// Halves the interval from `low` to `high` `halvings` times, to find the position where `before` changes from true to
/// false.
/// Returns both ends of the remaining interval.
/// If `before` is never true, the lower end stays. If `before` is always true, the upper end stays.
/// After about 52 halvings the interval is as short as a rounding error of its original length.
///
/// # Errors
/// The first error of `before`.
#[inline]
pub fn halved<E>(
    [mut low, mut high]: [f64; 2],
    halvings: usize,
    mut before: impl FnMut(f64) -> Result<bool, E>,
) -> Result<[f64; 2], E> {
    for _ in 0..halvings {
        let middle = f64::midpoint(low, high);
        if before(middle)? {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok([low, high])
}

/// A position, and the function's value at this position.
pub type PlaceAndValue = (f64, f64);

/// Searches for a sign change, starting at `from`.
/// The first position has the distance `width` from `from`.
/// Each further position has twice the distance of the previous position.
/// The search ends before the distance exceeds `most`.
/// Returns the last two positions, between which the sign changes.
/// `None` if the sign does not change, if a value or the width is NaN, or if the width is zero.
/// A negative `width` searches backwards.
///
/// # Errors
/// The first error of `value`.
pub fn widened<E>(
    from: PlaceAndValue,
    mut width: f64,
    most: f64,
    mut value: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<[PlaceAndValue; 2]>, E> {
    let mut last = from;
    while width.abs() <= most && width != 0.0 {
        let at = from.0 + width;
        let next = (at, value(at)?);
        if changes(last.1, next.1) {
            return Ok(Some([last, next]));
        }
        if next.1.is_nan() {
            return Ok(None);
        }
        last = next;
        width *= 2.0;
    }
    Ok(None)
}

/// Stopping criterion of a regula falsi. The search ends as soon as one of the two conditions below is met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Close {
    /// Largest absolute value of the function that counts as zero.
    pub value: f64,
    /// Largest distance between two bounds that count as equal.
    /// The width is at least four rounding errors of the larger bound, even if a smaller width is requested.
    pub width: f64,
}

/// The zero between two positions with different signs, by regula falsi in the Illinois form.
/// If two successive steps move the same bound, the value at the other bound is halved.
/// Source: Dowell and Jarratt, BIT 11, 1971, 168-174; order 1.44.
/// `None` if the signs are the same, a value is NaN, or `steps` are not enough.
///
/// # Errors
/// The first error of `value`.
pub fn regula_falsi<E>(
    [mut held, mut last]: [PlaceAndValue; 2],
    close: Close,
    steps: usize,
    mut value: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<f64>, E> {
    if !changes(held.1, last.1) {
        return Ok(None);
    }
    if let Some(end) = [held, last].into_iter().find(|end| end.1 == 0.0) {
        return Ok(Some(end.0));
    }
    for _ in 0..steps {
        // The new position is a mean of the bounds with positive weights. The mean lies between the bounds and loses no
        // digits.
        let at = (held.0 * last.1 - last.0 * held.1) / (last.1 - held.1);
        let found = value(at)?;
        let rounding = 4.0 * f64::EPSILON * held.0.abs().larger(last.0.abs());
        if found.abs() <= close.value || (last.0 - held.0).abs() <= close.width.larger(rounding) {
            return Ok(Some(at));
        }
        if found.is_nan() {
            return Ok(None);
        }
        if found.is_sign_positive() == last.1.is_sign_positive() {
            held.1 /= 2.0;
        } else {
            held = last;
        }
        last = (at, found);
    }
    Ok(None)
}

/// The zero between `bounds` (either may be the larger) of a function that returns its value and slope.
/// The search uses Newton's method from `start`. If a step leaves the bounds, bisection replaces the step.
/// `rises` says whether the value is positive at the second bound.
/// The search ends after the first Newton step that is not longer than `settled`.
/// Convergence is quadratic, so the remaining error is about the square of the last step.
/// `None` if a value is NaN.
///
/// # Errors
/// The first error of `value`.
#[inline]
pub fn newton<E>(
    mut bounds: [f64; 2],
    rises: bool,
    start: f64,
    settled: f64,
    mut value: impl FnMut(f64) -> Result<(f64, f64), E>,
) -> Result<Option<f64>, E> {
    /// Largest number of steps.
    /// Bisection alone needs at most one step per bit of a double. The remaining steps are for Newton's method.
    const MOST: usize = 100;
    let mut at = start;
    for _ in 0..MOST {
        let (here, slope) = value(at)?;
        if here.is_nan() {
            return Ok(None);
        }
        if here == 0.0 {
            return Ok(Some(at));
        }
        bounds[usize::from((here > 0.0) == rises)] = at;
        let next = at - here / slope;
        if (next - at).abs() <= settled {
            return Ok(Some(next));
        }
        let [low, high] = [bounds[0].smaller(bounds[1]), bounds[0].larger(bounds[1])];
        at = if next > low && next < high { next } else { f64::midpoint(low, high) };
        if !(low < at && at < high) {
            break;
        }
    }
    Ok(Some(at))
}

/// Makes `steps` steps of Newton's method from a point near the zero.
/// A step is skipped if it is NaN or not shorter than `longest`.
/// `value` returns the function's value and slope.
///
/// # Errors
/// The first error of `value`.
#[inline]
pub fn polished<E>(
    mut at: f64,
    steps: usize,
    longest: f64,
    mut value: impl FnMut(f64) -> Result<(f64, f64), E>,
) -> Result<f64, E> {
    for _ in 0..steps {
        let (here, slope) = value(at)?;
        let step = here / slope;
        if step.abs() < longest {
            at -= step;
        }
    }
    Ok(at)
}

/// A length at which the value is zero, found by at most `steps` secant steps.
/// The first secant goes through `known` and through the function's point at the length `guess`.
/// Both lengths are positive.
/// The search ends if the next change would be at most four rounding errors of the length.
/// The search also ends if the next change would be as large as the length itself.
/// Returns the length whose value was nearest to zero.
/// This length need not be the last one: between values as small as rounding errors, the slope of a secant is
/// arbitrary, and so is the next length.
///
/// # Errors
/// The first error of `value`.
pub fn secants<E>(
    mut known: PlaceAndValue,
    guess: f64,
    steps: usize,
    mut value: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let mut last = (guess, value(guess)?);
    let mut best = last;
    for _ in 0..steps {
        let change = last.1 * (last.0 - known.0) / (last.1 - known.1);
        if !(change.abs() > 4.0 * f64::EPSILON * last.0 && change.abs() < last.0) {
            break;
        }
        known = last;
        let at = last.0 - change;
        last = (at, value(at)?);
        if last.1.abs() <= best.1.abs() {
            best = last;
        }
    }
    Ok(best.0)
}

#[cfg(test)]
mod tests;
