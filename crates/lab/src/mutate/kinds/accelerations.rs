//! Faults in the second derivatives of the answers.

use super::kind::kinds;
use super::touch::{floating, moving_guide, on_arm, turner};
use linkage::case::Case;
use linkage::math::turned;
use linkage::solver::State;

kinds! { Acceleration, Answer:
    "centripetal-missing": "the centripetal acceleration of the last rotating link is missing",
        |at, state, _| on_arm(at.case, state, |motion, arm| motion.acceleration += arm * (motion.omega * motion.omega));
    "centripetal-sign": "the centripetal acceleration of the last rotating link points outwards",
        |at, state, _| on_arm(at.case, state, |motion, arm| motion.acceleration += arm * (2.0 * motion.omega * motion.omega));
    "tangential-missing": "the tangential acceleration of the last rotating link is missing",
        |at, state, _| on_arm(at.case, state, |motion, arm| motion.acceleration -= turned(arm) * motion.alpha);
    "coriolis-missing": "the Coriolis acceleration of a slider on a moving guide is missing",
        |at, state, _| without_coriolis(at.case, state, 1.0);
    "coriolis-half": "the Coriolis acceleration of a slider on a moving guide is omega v instead of 2 omega v",
        |at, state, _| without_coriolis(at.case, state, 0.5);
    "alpha" (1e-2): "the angular acceleration of the last rotating link is too large by a relative amount",
        |at, state, size| state.motions[turner(at.case)].alpha *= 1.0 + size;
    "alpha-sign": "the angular acceleration of the last rotating link is measured clockwise",
        |at, state, _| state.motions[turner(at.case)].alpha *= -1.0;
    "alpha-missing": "the angular acceleration of the last rotating link is zero",
        |at, state, _| state.motions[turner(at.case)].alpha = 0.0;
    "alpha-degrees": "the angular acceleration of the last rotating link is in deg/s²", |at, state, _| {
        let alpha = &mut state.motions[turner(at.case)].alpha;
        *alpha = alpha.to_degrees();
    };
    "acceleration-size" (1e-2): "the acceleration of the last moving frame is too large by a relative amount",
        |at, state, size| state.motions[floating(at.case)].acceleration *= 1.0 + size;
    "acceleration-half": "second differences are halved: all accelerations have half their value",
        |_, state, _| for motion in state.motions.iter_mut().skip(1) {
            motion.acceleration *= 0.5;
            motion.alpha *= 0.5;
        };
    "acceleration-with-gravity": "gravity is subtracted from the last moving frame's acceleration", |at, state, _| {
        state.motions[floating(at.case)].acceleration -= at.case.gravity;
        (at.case.gravity.norm() > 0.0).then_some(())
    };
    "acceleration-x-dropped": "the x component of the last moving frame's acceleration is missing",
        |at, state, _| state.motions[floating(at.case)].acceleration.x = 0.0;
}

/// Removes a fraction of the Coriolis term from the acceleration of a slider on a moving guide.
fn without_coriolis(case: &Case, state: &mut State, share: f64) -> Option<()> {
    let joint = case.mechanism.joints()[moving_guide(case)?].clone();
    let [_, speed, _] = state.slide(&joint)?;
    let guide = &state.motions[joint.first.link];
    let part = turned(guide.arm(joint.axis_on(joint.first.link)?)) * (2.0 * guide.omega * speed);
    state.motions[joint.second.link].acceleration -= part * share;
    Some(())
}
