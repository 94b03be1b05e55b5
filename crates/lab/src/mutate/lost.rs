//! Smallest size at which a fault is still found.

use linkage::math::KeepNan;

/// Smallest size that is tried, divided by the first size. Effects of smaller faults are below rounding error.
const LEAST: f64 = 1e-16;
/// Factor from the whole size to the first guess, if there is no margin, and between successive sizes of the upward
/// search.
const STEP: f64 = 10.0;
/// The search ends if the smallest size that is found is at most this multiple of a size that is not found.
const FACTOR: f64 = 2.0;
/// One search makes fewer proofs than this number.
const MOST: usize = 24;

/// The smallest size for which `is_found` returns true, to a factor of two.
/// `margin` is the margin with which the size `whole` is found.
pub(super) fn smallest(whole: f64, margin: f64, is_found: &dyn Fn(f64) -> bool) -> f64 {
    let mut left = MOST;
    let mut is_found = |size: f64| {
        left = left.saturating_sub(1);
        left > 0 && is_found(size)
    };
    // Most effects are proportional to the size, so the margin predicts the size below which the fault is not found.
    let guess = if margin.is_finite() && margin > 1.0 { whole / margin } else { whole / STEP };
    let mut found = whole;
    let mut lost = None;
    let mut size = (guess * FACTOR).smaller(whole / FACTOR);
    while lost.is_none() && size > LEAST * whole {
        if is_found(size) {
            found = size;
            size /= if size <= guess * FACTOR { FACTOR * FACTOR } else { STEP };
        } else {
            lost = Some(size);
        }
    }
    let Some(mut lost) = lost else { return found };
    // If the guess was too small, the search increases the size in steps, and then bisects the interval.
    while found > STEP * lost {
        let size = lost * STEP;
        if is_found(size) {
            found = size;
        } else {
            lost = size;
        }
    }
    while found > FACTOR * lost {
        let middle = (found * lost).sqrt();
        if is_found(middle) {
            found = middle;
        } else {
            lost = middle;
        }
    }
    found
}
