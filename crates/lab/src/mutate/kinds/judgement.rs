//! Faults that only one comparison can find.

use super::kind::kinds;
use super::touch::turner;
use linkage::case::Case;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{GROUND, JointId};
use linkage::solver::State;

kinds! { Judgement, Answer:
    "first-instant" (1e-3): "the angle of the last rotating link is off (rad) at the first instant",
        |at, state, size| turned(at.case, state, at.row == 0, size);
    "last-instant" (1e-3): "the angle of the last rotating link is off (rad) at the last instant",
        |at, state, size| turned(at.case, state, at.row + 1 == at.case.grid.len(), size);
    "second-moment" (1e-2): "the moment of the second drive is too large by a relative amount", |at, state, size| {
        at.case.drives.further().first().filter(|drive| drive.has_moment())?;
        *state.torques.get_mut(1)? *= 1.0 + size;
    };
    "frame-couple" (1e-2): "two frame reactions are off by a couple, by a fraction of the larger reaction",
        |at, state, size| {
            let joints = at.case.mechanism.joints();
            let on_frame = |index: &JointId| joints[*index].on(GROUND).is_some();
            let first = joints.ids().find(on_frame)?;
            let last = joints.ids().rfind(on_frame)?;
            let place = |index: JointId| {
                let side = joints[index].second;
                state.motions[side.link].point(side.local)
            };
            let arm = place(last) - place(first);
            (arm.norm() > 0.0).then_some(())?;
            let across = Vec2::new(-arm.y, arm.x) / arm.norm();
            let force = across * (size * state.forces[first].norm().larger(state.forces[last].norm()));
            // Each of the `forces` acts on the second link of its joint.
            // If the frame is the first link, the force on the frame has the opposite sign.
            let sign = |index: JointId| if joints[index].first.link == GROUND { -1.0 } else { 1.0 };
            state.forces[first] -= force * sign(first);
            state.forces[last] += force * sign(last);
        };
}

fn turned(case: &Case, state: &mut State, is_there: bool, size: f64) -> Option<()> {
    if is_there {
        state.angles[turner(case)] += size;
    }
    Some(())
}
