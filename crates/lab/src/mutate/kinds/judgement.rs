//! Faults that a single comparison sees: each escapes where that part of the judging is left out.

use super::kind::{Family, Kind};
use super::touch::turner;
use linkage::case::Case;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::GROUND;
use linkage::solver::State;

const OF: Family = Family::Judgement;

pub(super) const KINDS: &[Kind] = &[
    Kind::answer(
        OF,
        "first-instant",
        "the angle of the last link that turns, at the first instant",
        |at, state, size| turned(at.case, state, at.row == 0, size),
    )
    .sized(1e-3),
    Kind::answer(
        OF,
        "last-instant",
        "the angle of the last link that turns, at the last instant",
        |at, state, size| turned(at.case, state, at.row + 1 == at.case.grid.len(), size),
    )
    .sized(1e-3),
    Kind::answer(OF, "second-moment", "the moment of the second drive is larger by a share", |at, state, size| {
        at.case.drives.further().first().filter(|drive| drive.has_moment())?;
        *state.torques.get_mut(1)? *= 1.0 + size;
        Some(())
    })
    .sized(1e-2),
    Kind::answer(
        OF,
        "frame-couple",
        "the reactions in two joints of the frame are off by a couple, by a share of the larger",
        |at, state, size| {
            let joints = at.case.mechanism.joints();
            let on_frame = |index: &usize| joints[*index].on(GROUND).is_some();
            let first = (0..joints.len()).find(on_frame)?;
            let last = (0..joints.len()).rfind(on_frame)?;
            let place = |index: usize| {
                let side = joints[index].second;
                state.motions[side.link].point(side.local)
            };
            let arm = place(last) - place(first);
            (arm.norm() > 0.0).then_some(())?;
            let across = Vec2::new(-arm.y, arm.x) / arm.norm();
            let force = across * (size * state.forces[first].norm().larger(state.forces[last].norm()));
            // What a joint exerts on its second link; on the frame it has the other sign where the frame is the first.
            let sign = |index: usize| if joints[index].first.link == GROUND { -1.0 } else { 1.0 };
            state.forces[first] -= force * sign(first);
            state.forces[last] += force * sign(last);
            Some(())
        },
    )
    .sized(1e-2),
];

fn turned(case: &Case, state: &mut State, is_there: bool, size: f64) -> Option<()> {
    if is_there {
        state.angles[turner(case)] += size;
    }
    Some(())
}
