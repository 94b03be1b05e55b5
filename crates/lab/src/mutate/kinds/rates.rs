//! Faults in the first derivatives of the answers.

use super::kind::kinds;
use super::touch::{crank, floating, moving_guide, on_arm, turner};
use linkage::case::Case;
use linkage::math::{Vec2, rotated, turned};
use linkage::solver::State;

kinds! { Rate, Answer:
    "omega" (1e-2): "the angular velocity of the last rotating link is too large by a relative amount",
        |at, state, size| state.motions[turner(at.case)].omega *= 1.0 + size;
    "omega-sign": "the angular velocity of the last rotating link is measured clockwise",
        |at, state, _| state.motions[turner(at.case)].omega *= -1.0;
    "omega-degrees": "the angular velocity of the last rotating link is in degrees per second", |at, state, _| {
        let omega = &mut state.motions[turner(at.case)].omega;
        *omega = omega.to_degrees();
    };
    "omega-relative": "the angular velocity of the last rotating link is relative to the crank", |at, state, _| {
        let (last, first) = (turner(at.case), crank(at.case));
        (last != first).then(|| state.motions[last].omega -= state.motions[first].omega)
    };
    "velocity-half-arm": "a velocity uses half a length: v = v0 + omega x r / 2",
        |at, state, _| on_arm(at.case, state, |motion, arm| motion.velocity -= turned(arm) * (0.5 * motion.omega));
    "velocity-x-dropped": "the x component of the last moving frame's velocity is dropped",
        |at, state, _| state.motions[floating(at.case)].velocity.x = -about_frame(at.case, state).x;
    "velocity-y-dropped": "the y component of the last moving frame's velocity is dropped",
        |at, state, _| state.motions[floating(at.case)].velocity.y = -about_frame(at.case, state).y;
    "velocity" (1e-2): "the velocity of the last moving frame is too large by a relative amount",
        |at, state, size| state.motions[floating(at.case)].velocity *= 1.0 + size;
    "velocity-frame": "the velocity of the last moving frame is given in that frame, not in the world", |at, state, _| {
        let motion = &mut state.motions[floating(at.case)];
        let back = Vec2::new(motion.direction.x, -motion.direction.y);
        motion.velocity = rotated(back, motion.velocity);
    };
    "stale-velocities" (1e-2): "velocities are those of an earlier time, by a small crank rotation (rad)",
        |at, state, size| {
            let before = size / at.case.crank().top_speed().abs();
            for motion in state.motions.iter_mut().skip(1) {
                motion.velocity -= motion.acceleration * before;
                motion.omega -= motion.alpha * before;
            }
        };
    "velocity-guide": "the velocity of a slider lacks the velocity of its moving guide", |at, state, _| {
        let joint = &at.case.mechanism.joints()[moving_guide(at.case)?];
        let place = state.motions[joint.second.link].point(joint.second.local);
        let lead = state.motions[joint.first.link].velocity_at(place);
        state.motions[joint.second.link].velocity -= lead;
    };
    "velocities-reversed": "all velocities have the opposite sign",
        |_, state, _| for motion in state.motions.iter_mut().skip(1) {
            motion.velocity *= -1.0;
            motion.omega *= -1.0;
        };
    "velocity-instant" (1e-2): "the last moving frame's velocity is off at one instant by a fraction of typical speed",
        |at, state, size| {
            if at.row == at.case.grid.len() / 3 {
                let speed = at.case.mechanism.size() * at.case.crank().top_speed();
                state.motions[floating(at.case)].velocity.x += size * speed;
            }
        };
}

/// The part of a mass centre's velocity that comes from the link's rotation about the origin of its frame.
/// The link is the one that `floating` selects.
fn about_frame(case: &Case, state: &State) -> Vec2 {
    let link = floating(case);
    let motion = &state.motions[link];
    turned(motion.arm(case.mechanism.links()[link].mass_centre)) * motion.omega
}
