//! First derivatives in the answers.

use super::kind::kinds;
use super::touch::{crank, floating, moving_guide, on_arm, turner};
use linkage::case::Case;
use linkage::math::{Vec2, rotated, turned};
use linkage::solver::State;

kinds! { Rate, Answer:
    "omega" (1e-2): "the angular velocity of the last turning link is larger by a share",
        |at, state, size| state.motions[turner(at.case)].omega *= 1.0 + size;
    "omega-sign": "the angular velocity of the last turning link is counted clockwise",
        |at, state, _| state.motions[turner(at.case)].omega *= -1.0;
    "omega-degrees": "the angular velocity of the last turning link is in degrees per second", |at, state, _| {
        let omega = &mut state.motions[turner(at.case)].omega;
        *omega = omega.to_degrees();
    };
    "omega-relative": "the angular velocity of the last turning link is that relative to the crank", |at, state, _| {
        let (last, first) = (turner(at.case), crank(at.case));
        (last != first).then(|| state.motions[last].omega -= state.motions[first].omega)
    };
    "velocity-half-arm": "half a length in a velocity: v = v0 + omega x r / 2",
        |at, state, _| on_arm(at.case, state, |motion, arm| motion.velocity -= turned(arm) * (0.5 * motion.omega));
    "velocity-x-dropped": "the x component of the last moving frame's velocity is dropped",
        |at, state, _| state.motions[floating(at.case)].velocity.x = -about_frame(at.case, state).x;
    "velocity-y-dropped": "the y component of the last moving frame's velocity is dropped",
        |at, state, _| state.motions[floating(at.case)].velocity.y = -about_frame(at.case, state).y;
    "velocity" (1e-2): "the velocity of the last moving frame is larger by a share",
        |at, state, size| state.motions[floating(at.case)].velocity *= 1.0 + size;
    "velocity-frame": "the velocity of the last moving frame is in its own frame, not in the world", |at, state, _| {
        let motion = &mut state.motions[floating(at.case)];
        let back = Vec2::new(motion.direction.x, -motion.direction.y);
        motion.velocity = rotated(back, motion.velocity);
    };
    "stale-velocities" (1e-2): "velocities are those of a moment before: a share of a radian of the crank",
        |at, state, size| {
            let before = size / at.case.crank().top_speed().abs();
            for motion in state.motions.iter_mut().skip(1) {
                motion.velocity -= motion.acceleration * before;
                motion.omega -= motion.alpha * before;
            }
        };
    "velocity-guide": "a slider's velocity lacks that of its moving guide", |at, state, _| {
        let joint = &at.case.mechanism.joints()[moving_guide(at.case)?];
        let place = state.motions[joint.second.link].point(joint.second.local);
        let lead = state.motions[joint.first.link].velocity_at(place);
        state.motions[joint.second.link].velocity -= lead;
    };
    "velocities-reversed": "all velocities are those of the motion backwards",
        |_, state, _| for motion in state.motions.iter_mut().skip(1) {
            motion.velocity *= -1.0;
            motion.omega *= -1.0;
        };
    "velocity-instant" (1e-2): "the last moving frame's velocity is off at one instant by a share of its size",
        |at, state, size| {
            if at.row == at.case.grid.len() / 3 {
                let speed = at.case.mechanism.size() * at.case.crank().top_speed();
                state.motions[floating(at.case)].velocity.x += size * speed;
            }
        };
}

/// Velocity of the mass centre due to rotation about the frame's origin, for the last link with a moving frame.
fn about_frame(case: &Case, state: &State) -> Vec2 {
    let link = floating(case);
    let motion = &state.motions[link];
    turned(motion.arm(case.mechanism.links()[link].mass_centre)) * motion.omega
}
