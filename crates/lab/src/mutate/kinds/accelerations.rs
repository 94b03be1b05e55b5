//! Second derivatives in the answers.

use super::kind::kinds;
use super::touch::{floating, moving_guide, on_arm, turner};
use linkage::case::Case;
use linkage::math::turned;
use linkage::solver::State;

kinds! { Acceleration, Answer:
    "centripetal-missing": "the last turning link's acceleration lacks its centripetal part",
        |at, state, _| on_arm(at.case, state, |motion, arm| motion.acceleration += arm * (motion.omega * motion.omega));
    "centripetal-sign": "the centripetal part of the last turning link's acceleration points outwards",
        |at, state, _| on_arm(at.case, state, |motion, arm| motion.acceleration += arm * (2.0 * motion.omega * motion.omega));
    "tangential-missing": "the last turning link's acceleration lacks its tangential part",
        |at, state, _| on_arm(at.case, state, |motion, arm| motion.acceleration -= turned(arm) * motion.alpha);
    "coriolis-missing": "a slider's acceleration on a moving guide lacks Coriolis' part",
        |at, state, _| without_coriolis(at.case, state, 1.0);
    "coriolis-half": "Coriolis' part of a slider on a moving guide is omega v instead of 2 omega v",
        |at, state, _| without_coriolis(at.case, state, 0.5);
    "alpha" (1e-2): "the angular acceleration of the last turning link is larger by a share",
        |at, state, size| state.motions[turner(at.case)].alpha *= 1.0 + size;
    "alpha-sign": "the angular acceleration of the last turning link is counted clockwise",
        |at, state, _| state.motions[turner(at.case)].alpha *= -1.0;
    "alpha-missing": "the angular acceleration of the last turning link is zero",
        |at, state, _| state.motions[turner(at.case)].alpha = 0.0;
    "alpha-degrees": "the angular acceleration of the last turning link is in degrees", |at, state, _| {
        let alpha = &mut state.motions[turner(at.case)].alpha;
        *alpha = alpha.to_degrees();
    };
    "acceleration-size" (1e-2): "the acceleration of the last moving frame is larger by a share",
        |at, state, size| state.motions[floating(at.case)].acceleration *= 1.0 + size;
    "acceleration-half": "second differences are taken with half: all accelerations are half",
        |_, state, _| for motion in state.motions.iter_mut().skip(1) {
            motion.acceleration *= 0.5;
            motion.alpha *= 0.5;
        };
    "acceleration-with-gravity": "the last moving frame's acceleration is less that of gravity", |at, state, _| {
        state.motions[floating(at.case)].acceleration -= at.case.gravity;
        (at.case.gravity.norm() > 0.0).then_some(())
    };
    "acceleration-x-dropped": "the last moving frame's frame has no acceleration along x",
        |at, state, _| state.motions[floating(at.case)].acceleration.x = 0.0;
}

/// Removes a share of the Coriolis term from the acceleration of a slider on a moving guide.
fn without_coriolis(case: &Case, state: &mut State, share: f64) -> Option<()> {
    let joint = case.mechanism.joints()[moving_guide(case)?].clone();
    let [_, speed, _] = state.slide(&joint)?;
    let guide = &state.motions[joint.first.link];
    let part = turned(guide.arm(joint.axis_on(joint.first.link)?)) * (2.0 * guide.omega * speed);
    state.motions[joint.second.link].acceleration -= part * share;
    Some(())
}
