//! The search for a change point, from one side.

use crate::assur::groups::{Clearance, Plan};
use linkage::math::{KeepNan, Motion};

/// Share of the estimated distance that a step of the search takes. At a dead point the estimate is twice the distance:
/// less than half of it stays on the branch.
const STEP: f64 = 0.4;
/// Sine below which a group passes through zero, if it does so linearly. Rounding of the lengths leaves up to the root
/// of the unit roundoff, and a mechanism that keeps more is another one.
const MET: f64 = 1e-6;
/// Sine from which on the slope is compared: at a dead point it grows with the inverse of the sine.
const LINEAR: f64 = 1e-3;
const MOST_STEPS: usize = 200;

/// A pose from which a search begins.
pub(super) struct Start<'a> {
    pub(super) angle: f64,
    pub(super) plan: &'a Plan,
    pub(super) motions: &'a [Motion],
}

/// The angle of the driving link at which a group has a change point, in the sense `way` (+1 or -1) from a pose.
/// Otherwise the angle up to which there is none.
pub(super) fn change_point(start: &Start, group: usize, way: f64) -> Result<f64, f64> {
    let (mut plan, mut motions) = (start.plan.clone(), start.motions.to_vec());
    let mut angle = start.angle;
    let mut slope = f64::NAN;
    for _ in 0..MOST_STEPS {
        let Some(Clearance { sine, rate }) = clearance(&mut plan, &mut motions, group) else { return Err(angle) };
        let towards = -rate * way;
        // Written so that NaN ends the search.
        if !(towards > 0.0) {
            return Err(angle);
        }
        if sine < LINEAR && slope.is_nan() {
            slope = towards;
        }
        if sine < MET {
            return if towards < 2.0 * slope { Ok(angle + way * sine / towards) } else { Err(angle) };
        }
        let ahead = angle + way * STEP * (sine / towards).smaller(0.25);
        if plan.positions(&[ahead], &mut motions).is_err() {
            return Err(angle);
        }
        angle = ahead;
    }
    Err(angle)
}

/// Clearance of a group at the last pose of a plan.
pub(super) fn clearance(plan: &mut Plan, motions: &mut [Motion], group: usize) -> Option<Clearance> {
    plan.velocities(&[1.0], motions);
    plan.clearances(motions).nth(group).flatten()
}
