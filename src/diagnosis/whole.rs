//! Changes of the case without a number.

use super::cause::{Cause, Change, How, Part};
use super::configurations::others;
use super::knobs::changed;
use super::question::Rank;
use super::tries::{Candidate, Make, Tries};
use linkage::case::Case;
use linkage::drive::{Course, Load};
use linkage::math::Vec2;
use linkage::mechanism::Side;

/// Changes without a number: another configuration, gravity along another axis, mass centres at joints, no inertia
/// forces.
pub(super) fn whole_changes(tries: &Tries) -> Vec<Candidate> {
    let case = &tries.thin.case;
    let mut all: Vec<(Change, Make)> = Vec::new();
    for (change, other) in others(case) {
        let (pose, modes) = (other.start.clone(), other.modes.clone());
        let make: Make = Box::new(move |case| {
            let (pose, modes) = (pose.clone(), modes.clone());
            case.with(|parts| (parts.start, parts.modes) = (pose, modes)).ok()
        });
        all.push((change, make));
    }
    let gravity = case.gravity;
    if gravity.norm() > 0.0 {
        let swapped = Vec2::new(gravity.y, gravity.x);
        let make: Make = Box::new(move |case| case.with(|parts| parts.gravity = swapped).ok());
        all.push((Change { part: Part::Gravity, how: How::Swapped }, make));
    }
    let kinematic = tries.thin.is_moved();
    if !kinematic && !tries.is_free {
        all.push((Change { part: Part::InertiaForces, how: How::Missing }, Box::new(without_inertia_forces)));
    }
    if kinematic || tries.is_free {
        all.extend(mass_centres(case));
    }
    let tried = all.into_iter().filter_map(|(change, make)| {
        let misfit = tries.of(&make)?;
        tries.candidate(&misfit, Rank::Change, Cause::Case(change), make)
    });
    tried.collect()
}

/// The mass centre of every link at each of its joints.
fn mass_centres(case: &Case) -> Vec<(Change, Make)> {
    let mut found: Vec<(Change, Make)> = Vec::new();
    for (index, link) in case.mechanism.links().iter().enumerate().skip(1).filter(|(_, link)| link.mass > 0.0) {
        for joint in case.mechanism.joints() {
            let Some(at) = joint.on(index).filter(|at| (at - link.mass_centre).norm() > 0.0) else { continue };
            let change = Change { part: Part::MassCentre(link.name.clone()), how: How::AtJoint(joint.name.clone()) };
            let make: Make = Box::new(move |case| {
                let mut parts = case.clone().into_parts();
                changed(&mut parts, |links, _| links[index].mass_centre = at)?;
                Case::new(parts).ok()
            });
            found.push((change, make));
        }
    }
    found
}

/// The case with weights, but without resistance to acceleration.
fn without_inertia_forces(case: &Case) -> Option<Case> {
    let mut parts = case.clone().into_parts();
    let gravity = parts.gravity;
    let weight = |(link, body): (usize, &linkage::mechanism::Link)| Load::Force {
        at: Side { link, local: body.mass_centre },
        force: [Course::Constant(body.mass * gravity.x), Course::Constant(body.mass * gravity.y)],
        follows: false,
    };
    let weights: Vec<Load> = case.mechanism.links().iter().enumerate().skip(1).map(weight).collect();
    parts.loads.extend(weights);
    changed(&mut parts, |links, _| links.iter_mut().for_each(|link| (link.mass, link.inertia) = (0.0, 0.0)))?;
    Case::new(parts).ok()
}
