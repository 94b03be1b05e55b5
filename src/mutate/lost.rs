//! The size at which a fault is lost.

use super::mutant::Party;
use super::planted::Fault;
use super::stage::Stage;
use linkage::math::KeepNan;

/// Smallest size over the first one that is tried: nothing that small is above rounding.
const LEAST: f64 = 1e-16;
/// Factor between sizes on the way down.
const STEP: f64 = 10.0;
/// Factor to which the size is found.
const FACTOR: f64 = 2.0;
/// Proofs that are made for it at most.
const MOST: usize = 24;

/// The smallest size that is still found, to a factor of two; `fault` itself is found with `margin`.
pub(super) fn smallest(stage: &Stage, fault: Fault, party: Party, margin: f64) -> f64 {
    let whole = fault.size;
    let mut left = MOST;
    let mut is_found = |size: f64| {
        left = left.saturating_sub(1);
        left > 0 && stage.proven(Fault { size, ..fault }, party).is_found()
    };
    // Most effects are proportional to the size, so that the margin says where it is lost.
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
    // A guess that was too small: up again in steps, then by halves.
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
