//! Faults in the reactions and moments of the answers.

use super::kind::kinds;
use super::touch::{crank, crank_pin, output, slider};
use linkage::case::Case;
use linkage::math::{Vec2, cross, rotated};
use linkage::solver::State;

kinds! { Force, Answer:
    "reaction" (1e-2): "the reaction in the last joint is too large by a relative amount",
        |_, state, size| state.forces.last_mut().map(|force| *force *= 1.0 + size);
    "reaction-sign": "the reaction in the last joint is that of the second link on the first",
        |_, state, _| state.forces.last_mut().map(|force| *force *= -1.0);
    "reaction-axes": "x and y of the reaction in the last joint are exchanged",
        |_, state, _| state.forces.last_mut().map(|force| *force = Vec2::new(force.y, force.x));
    "reaction-frame": "the reaction in the crank pin is given in the crank's frame", |at, state, _| {
        let direction = state.motions[crank(at.case)].direction;
        let force = &mut state.forces[crank_pin(at.case)];
        *force = rotated(Vec2::new(direction.x, -direction.y), *force);
    };
    "reaction-component": "the reaction in the crank pin has only its component perpendicular to the next link",
        |at, state, _| {
            let pin = crank_pin(at.case);
            (pin != at.case.crank().joint).then_some(())?;
            let along = state.motions[at.case.mechanism.joints()[pin].other(crank(at.case)).link].direction;
            let force = &mut state.forces[pin];
            *force -= along * along.dot(force);
        };
    "pivot-component": "the crank-pivot reaction lacks the crank-pin reaction's component along the next link",
        |at, state, _| {
            let dropped = dropped(at.case, state)?;
            state.forces[at.case.crank().joint] -= dropped;
        };
    "moment-component": "the balancing moment lacks the crank-pin reaction's component along the next link",
        |at, state, _| {
            let dropped = dropped(at.case, state)?;
            let pin = at.case.mechanism.joints()[crank_pin(at.case)].on(crank(at.case))?;
            state.torques[0] -= cross(crank_arm(at.case, state, pin)?, dropped);
        };
    "reaction-without-weight": "the reaction in the crank's pivot lacks the crank's weight", |at, state, _| {
        let weight = at.case.gravity * at.case.mechanism.links()[crank(at.case)].mass;
        (weight.norm() > 0.0).then(|| state.forces[at.case.crank().joint] += weight)
    };
    "reaction-without-inertia": "the reaction in the crank's pivot lacks the crank's inertia force", |at, state, _| {
        let link = &at.case.mechanism.links()[crank(at.case)];
        let force = state.motions[crank(at.case)].point_acceleration(link.mass_centre) * link.mass;
        (link.mass > 0.0).then(|| state.forces[at.case.crank().joint] -= force)
    };
    "reaction-x-dropped": "the reaction in the last joint has no x component",
        |_, state, _| state.forces.last_mut().map(|force| force.x = 0.0);
    "reaction-instant": "the reaction in the last joint is doubled at one instant", |at, state, _| {
        let factor = if at.row == at.case.grid.len() / 2 { 2.0 } else { 1.0 };
        state.forces.last_mut().map(|force| *force *= factor)
    };
    "reactions-kilo": "all forces are in kilonewtons",
        |_, state, _| state.forces.iter_mut().for_each(|force| *force *= 1e-3);
    "reactions-exchanged": "the reactions in the first and the last joint are exchanged", |_, state, _| {
        let last = state.forces.len() - 1;
        (last > 0).then(|| state.forces.swap(0, last))
    };
    "guide-moment-missing": "the moment in the first slider is missing",
        |at, state, _| state.moments[slider(at.case)?] = 0.0;
    "guide-moment-sign": "the moment in the first slider has the wrong sign",
        |at, state, _| state.moments[slider(at.case)?] *= -1.0;
    "guide-moment-point": "the moment in the first slider is about the joint's point on the guide", |at, state, _| {
        let index = slider(at.case)?;
        let joint = &at.case.mechanism.joints()[index];
        let [first, second] = [joint.first, joint.second].map(|side| state.motions[side.link].point(side.local));
        state.moments[index] += cross(second - first, state.forces[index]);
    };
    "last-guide-moment": "the moment in the last slider is missing", |at, state, _| {
        let (last, _) = at.case.mechanism.joints().entries().rfind(|(_, joint)| joint.slides())?;
        state.moments[last] = 0.0;
    };
    "moment" (1e-2): "the balancing moment is too large by a relative amount",
        |at, state, size| has_moment(at.case).then(|| state.torques[0] *= 1.0 + size);
    "moment-sign": "the balancing moment is that of the crank on the drive",
        |at, state, _| has_moment(at.case).then(|| state.torques[0] *= -1.0);
    "moment-wrong-point": "the balancing moment is taken about the crank's mass centre", |at, state, _| {
        has_moment(at.case).then_some(())?;
        let arm = crank_arm(at.case, state, at.case.mechanism.links()[crank(at.case)].mass_centre)?;
        state.torques[0] += cross(arm, state.forces[at.case.crank().joint]);
    };
    "moment-without-weight": "the balancing moment lacks the crank's weight", |at, state, _| {
        has_moment(at.case).then_some(())?;
        let link = &at.case.mechanism.links()[crank(at.case)];
        let arm = crank_arm(at.case, state, link.mass_centre)?;
        state.torques[0] += cross(arm, at.case.gravity) * link.mass;
        (link.mass > 0.0 && at.case.gravity.norm() > 0.0).then_some(())
    };
    "moments-exchanged": "the moments of the first and the last drive are exchanged", |at, state, _| {
        let last = state.torques.len() - 1;
        (last > 0 && !at.case.is_free()).then(|| state.torques.swap(0, last))
    };
    "force-output": "the reaction on the last link lacks the link's inertia force", |at, state, _| {
        let (link, joints) = (output(at.case), at.case.mechanism.joints());
        let joint = joints.find(|joint| joint.on(link).is_some())?;
        let own = &at.case.mechanism.links()[link];
        let force = state.motions[link].point_acceleration(own.mass_centre) * own.mass;
        let sign = if joints[joint].second.link == link { 1.0 } else { -1.0 };
        state.forces[joint] -= force * sign;
        (own.mass > 0.0).then_some(())
    };
}

/// Whether the answers contain a moment of the first drive.
fn has_moment(case: &Case) -> bool {
    case.crank().has_moment()
}

/// World vector from the crank's pivot to a point on the crank.
fn crank_arm(case: &Case, state: &State, place: Vec2) -> Option<Vec2> {
    let pivot = case.mechanism.joints()[case.crank().joint].on(crank(case))?;
    let motion = &state.motions[crank(case)];
    Some(motion.arm(place) - motion.arm(pivot))
}

/// Vector component of the crank pin's force in the direction of the next link.
/// The sign is that of [`State::forces`]: the force on the joint's second link.
fn dropped(case: &Case, state: &State) -> Option<Vec2> {
    let (pin, own) = (crank_pin(case), case.crank().joint);
    (pin != own && has_moment(case)).then_some(())?;
    let along = state.motions[case.mechanism.joints()[pin].other(crank(case)).link].direction;
    Some(along * along.dot(&state.forces[pin]))
}
