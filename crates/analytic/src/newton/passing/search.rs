//! The search for a change point, in one direction of the crank's rotation.

use super::spot::{Spot, walked};
use crate::newton::steps::TRACKING_STEP;
use crate::newton::system::System;
use linkage::math::KeepNan;

/// Ratio of a search step to the estimated distance of the change point.
const STEP: f64 = 0.4;
/// The determinant of a block counts as zero if it decreases linearly to less than this fraction of its largest
/// possible value.
/// For a dyad this ratio is about a tenth of the sine of its transmission angle.
const MET: f64 = 1e-7;
/// Below this ratio, the search stores the slope of the determinant, for comparison with the slope at `MET`.
/// At a dead point the determinant falls with the square root of the distance, and its slope grows without bound.
const LINEAR: f64 = 1e-4;
const MOST_STEPS: usize = 200;

/// Newton's method ends at corrections below this value during a search. The usual limit is too small: near a change
/// point, rounding errors are amplified.
const COARSE: f64 = 1e-7;

/// Searches for the angle (rad) at which the determinant of a block passes through zero, about `ahead` (rad) from a
/// spot.
/// If the search fails, the error is the angle up to which the determinant has no zero.
pub(super) fn change_point(system: &mut System, start: &Spot, block: usize, ahead: f64) -> Result<f64, f64> {
    let settled = std::mem::replace(&mut system.settled, COARSE);
    let found = approached(system, start, block, ahead);
    system.settled = settled;
    found
}

fn approached(system: &mut System, start: &Spot, block: usize, ahead: f64) -> Result<f64, f64> {
    let (way, mut left) = (ahead.signum(), ahead.abs());
    let mut spot = start.clone();
    let mut linear = f64::NAN;
    for _ in 0..MOST_STEPS {
        let to = spot.angle + way * (STEP * left).smaller(TRACKING_STEP);
        let Ok(next) = walked(system, &spot, to) else { return Err(spot.angle) };
        let share = next.shares[block].abs();
        let slope = (spot.shares[block].abs() - share) / (to - spot.angle).abs();
        // The comparison is negated so that NaN ends the search.
        if !(slope > 0.0) {
            return Err(spot.angle);
        }
        spot = next;
        left = share / slope;
        if share < LINEAR && linear.is_nan() {
            linear = slope;
        }
        if share < MET {
            return if slope < 2.0 * linear { Ok(spot.angle + way * left) } else { Err(spot.angle) };
        }
    }
    Err(spot.angle)
}
