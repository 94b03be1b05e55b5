//! Positions and angles that are answered.

use super::kind::{Family, Kind};
use super::touch::{arm, floating, output, turner};
use linkage::math::{rotated, unit};
use linkage::solver::State;

const OF: Family = Family::Position;

pub(super) const KINDS: &[Kind] = &[
    Kind::answer(OF, "place-x", "the last link is moved along x by a share of the size", |at, state, size| {
        state.motions[output(at.case)].origin.x += size * at.case.mechanism.size();
        Some(())
    })
    .sized(1e-3),
    Kind::answer(OF, "place-y", "the last link is moved along y by a share of the size", |at, state, size| {
        state.motions[output(at.case)].origin.y += size * at.case.mechanism.size();
        Some(())
    })
    .sized(1e-3),
    Kind::answer(
        OF,
        "place-instant",
        "the last link is moved along y at one instant in the middle of the run",
        |at, state, size| {
            if at.row == at.case.grid.len() / 2 {
                state.motions[output(at.case)].origin.y += size * at.case.mechanism.size();
            }
            Some(())
        },
    )
    .sized(1e-3),
    Kind::answer(
        OF,
        "place-scaled",
        "all places are larger by a share, as inches of two standards",
        |_, state, size| {
            state.motions.iter_mut().skip(1).for_each(|motion| motion.origin *= 1.0 + size);
            Some(())
        },
    )
    .sized(1e-3),
    Kind::answer(
        OF,
        "place-half-arm",
        "the last moving frame's frame is half an arm from where it is",
        |at, state, _| {
            let link = floating(at.case);
            let arm = arm(at.case, state, link);
            (arm.norm() > 0.0).then(|| state.motions[link].origin += arm * 0.5)
        },
    ),
    Kind::answer(OF, "mirrored", "all places are mirrored in the x axis, all angles as they are", |_, state, _| {
        state.motions.iter_mut().skip(1).for_each(|motion| motion.origin.y *= -1.0);
        Some(())
    }),
    Kind::answer(
        OF,
        "angle",
        "the angle of the last turning link is off (rad), its direction too",
        |at, state, size| {
            turn(state, turner(at.case), size);
            Some(())
        },
    )
    .sized(1e-3),
    Kind::answer(
        OF,
        "angle-alone",
        "the angle of the last turning link is off (rad), its direction is not",
        |at, state, size| {
            state.angles[turner(at.case)] += size;
            Some(())
        },
    )
    .sized(1e-3),
    Kind::answer(OF, "angle-sign", "the angle of the last turning link is counted clockwise", |at, state, _| {
        state.angles[turner(at.case)] *= -1.0;
        Some(())
    }),
    Kind::answer(OF, "angle-degrees", "the angle of the last turning link is in degrees", |at, state, _| {
        let angle = &mut state.angles[turner(at.case)];
        *angle = angle.to_degrees();
        Some(())
    }),
    Kind::answer(
        OF,
        "angle-drift",
        "the angle of the last turning link drifts by an angle (rad) over the run",
        |at, state, size| {
            turn(state, turner(at.case), size * share(at.row, at.case.grid.len()));
            Some(())
        },
    )
    .sized(1e-3),
    Kind::answer(
        OF,
        "place-drift",
        "the last link drifts along x by a share of the size over the run",
        |at, state, size| {
            let drift = size * at.case.mechanism.size() * share(at.row, at.case.grid.len());
            state.motions[output(at.case)].origin.x += drift;
            Some(())
        },
    )
    .sized(1e-3),
    Kind::answer(
        OF,
        "stale-places",
        "places are those of a moment before: a share of a radian of the crank earlier",
        |at, state, size| {
            let before = size / at.case.crank().top_speed().abs();
            for (motion, angle) in state.motions.iter_mut().zip(&mut state.angles).skip(1) {
                motion.origin -= motion.velocity * before;
                motion.direction = rotated(unit(-motion.omega * before), motion.direction);
                *angle -= motion.omega * before;
            }
            Some(())
        },
    )
    .sized(1e-2),
];

fn turn(state: &mut State, link: usize, angle: f64) {
    state.angles[link] += angle;
    let motion = &mut state.motions[link];
    motion.direction = rotated(unit(angle), motion.direction);
}

fn share(row: usize, rows: usize) -> f64 {
    row as f64 / rows.max(1) as f64
}
