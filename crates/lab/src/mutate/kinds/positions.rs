//! Faults in the positions and angles of the answers.

use super::kind::kinds;
use super::touch::{arm, floating, output, turner};
use linkage::math::{rotated, unit};
use linkage::mechanism::LinkId;
use linkage::solver::State;

kinds! { Position, Answer:
    "place-x" (1e-3): "the last link is displaced along x by a fraction of the mechanism's size",
        |at, state, size| state.motions[output(at.case)].origin.x += size * at.case.mechanism.size();
    "place-y" (1e-3): "the last link is displaced along y by a fraction of the mechanism's size",
        |at, state, size| state.motions[output(at.case)].origin.y += size * at.case.mechanism.size();
    "place-instant" (1e-3): "the last link is displaced along y at one instant in the middle of the run",
        |at, state, size| {
            if at.row == at.case.grid.len() / 2 {
                state.motions[output(at.case)].origin.y += size * at.case.mechanism.size();
            }
        };
    "place-scaled" (1e-3): "all positions are too large by a relative amount, as between two standards of the inch",
        |_, state, size| state.motions.iter_mut().skip(1).for_each(|motion| motion.origin *= 1.0 + size);
    "place-half-arm": "the last moving frame is displaced by half the arm to its last joint", |at, state, _| {
        let link = floating(at.case);
        let arm = arm(at.case, state, link);
        (arm.norm() > 0.0).then(|| state.motions[link].origin += arm * 0.5)
    };
    "mirrored": "all positions are mirrored about the x axis, the angles are not",
        |_, state, _| state.motions.iter_mut().skip(1).for_each(|motion| motion.origin.y *= -1.0);
    "angle" (1e-3): "the angle of the last rotating link is off (rad), and its direction vector too",
        |at, state, size| turn(state, turner(at.case), size);
    "angle-alone" (1e-3): "the angle of the last rotating link is off (rad), but not its direction vector",
        |at, state, size| state.angles[turner(at.case)] += size;
    "angle-sign": "the angle of the last rotating link is measured clockwise",
        |at, state, _| state.angles[turner(at.case)] *= -1.0;
    "angle-degrees": "the angle of the last rotating link is in degrees", |at, state, _| {
        let angle = &mut state.angles[turner(at.case)];
        *angle = angle.to_degrees();
    };
    "angle-drift" (1e-3): "the angle of the last rotating link drifts by an angle (rad) over the run",
        |at, state, size| turn(state, turner(at.case), size * share(at.row, at.case.grid.len()));
    "place-drift" (1e-3): "the last link drifts along x by a fraction of the mechanism's size over the run", |at, state, size| {
        let drift = size * at.case.mechanism.size() * share(at.row, at.case.grid.len());
        state.motions[output(at.case)].origin.x += drift;
    };
    "stale-places" (1e-2): "positions are those of an earlier time, by a small crank rotation (rad)",
        |at, state, size| {
            let before = size / at.case.crank().top_speed().abs();
            for (motion, angle) in state.motions.iter_mut().zip(&mut state.angles).skip(1) {
                motion.origin -= motion.velocity * before;
                motion.direction = rotated(unit(-motion.omega * before), motion.direction);
                *angle -= motion.omega * before;
            }
        };
}

fn turn(state: &mut State, link: LinkId, angle: f64) {
    state.angles[link] += angle;
    let motion = &mut state.motions[link];
    motion.direction = rotated(unit(angle), motion.direction);
}

fn share(row: usize, rows: usize) -> f64 {
    row as f64 / rows.max(1) as f64
}
