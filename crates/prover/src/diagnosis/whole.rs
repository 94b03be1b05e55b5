//! Changes of the case without a fitted number.

use std::f64::consts::FRAC_PI_2;

use super::cause::{CasePart, Change, PartChange};
use super::configurations::others;
use super::knobs::{changed, remade};
use super::question::Rank;
use super::tries::{Candidate, Make, Tries};
use linkage::case::Case;
use linkage::drive::{Course, Load};
use linkage::math::Vec2;
use linkage::mechanism::{JointSide, Link, LinkId};

/// Changes without a fitted number: another configuration, gravity along another axis, mass centres at other
/// positions, missing weights or inertia forces, loads at other points.
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
        let turned = [
            (PartChange::Swapped, Vec2::new(gravity.y, gravity.x)),
            (PartChange::Turned(FRAC_PI_2), Vec2::new(-gravity.y, gravity.x)),
            (PartChange::Turned(-FRAC_PI_2), Vec2::new(gravity.y, -gravity.x)),
        ];
        for (how, other) in turned {
            all.push(change(CasePart::Gravity, how, move |case| case.with(|parts| parts.gravity = other).ok()));
        }
    }
    let kinematic = tries.thin.is_moved();
    if !kinematic && !tries.is_free {
        let links: Vec<LinkId> = case.mechanism.links().ids().skip(1).collect();
        all.push(change(CasePart::InertiaForces, PartChange::Missing, move |case| {
            without_inertia_forces(case, &links)
        }));
    }
    if !kinematic || tries.is_free {
        all.extend(masses(case));
        all.extend(loads(case));
    }
    all.extend(mass_centres(case));
    let tried = all.into_iter().filter_map(|(change, make)| {
        let misfit = tries.of(&make)?;
        tries.candidate(&misfit, Rank::Change, change, make)
    });
    tried.collect()
}

fn change(part: CasePart, how: PartChange, make: impl Fn(&Case) -> Option<Case> + 'static) -> (Change, Make) {
    (Change { part, how }, Box::new(make))
}

/// Moves the mass centre of every link to four kinds of positions: each joint of the link, the middle between two
/// joints, and the reflections of the mass centre in this middle and in the line through two joints.
fn mass_centres(case: &Case) -> Vec<(Change, Make)> {
    let mut found: Vec<(Change, Make)> = Vec::new();
    for (index, link) in case.mechanism.links().entries().skip(1).filter(|(_, link)| link.mass > 0.0) {
        let joints = case.mechanism.joints().iter().filter_map(|joint| Some((joint.name.clone(), joint.on(index)?)));
        let joints: Vec<(String, Vec2)> = joints.collect();
        let own = link.mass_centre;
        let mut places: Vec<(PartChange, Vec2)> =
            joints.iter().map(|(name, at)| (PartChange::AtJoint(name.clone()), *at)).collect();
        for (number, (one, from)) in joints.iter().enumerate() {
            for (other, to) in &joints[number + 1..] {
                let names = [one.clone(), other.clone()];
                let along = to - from;
                if !(along.norm() > 0.0) {
                    continue;
                }
                let across = own - from - along * ((own - from).dot(&along) / along.norm_squared());
                places.push((PartChange::FromJoint(names.clone()), from + to - own));
                places.push((PartChange::Across(names.clone()), own - 2.0 * across));
                places.push((PartChange::Middle(names), 0.5 * (from + to)));
            }
        }
        let mut seen = vec![own];
        for (how, at) in places {
            if seen.iter().any(|known| (known - at).norm() <= 1e-9 * link.extent()) {
                continue;
            }
            seen.push(at);
            let part = CasePart::MassCentre(link.name.clone());
            let moved =
                move |case: &Case| remade(case, |parts| changed(parts, |links, _| links[index].mass_centre = at));
            found.push(change(part, how, moved));
        }
    }
    found
}

/// For every link, up to three changed cases: without mass and moment of inertia, without weight, and without inertia
/// forces.
fn masses(case: &Case) -> Vec<(Change, Make)> {
    let mut found = Vec::new();
    let heavy = |(_, link): &(LinkId, &Link)| link.mass > 0.0;
    let all: Vec<(LinkId, &Link)> = case.mechanism.links().entries().skip(1).filter(heavy).collect();
    // If only one link has a mass, no separate change is needed for this link: the changes of all links have the same
    // effect.
    for &(index, link) in all.iter().filter(|_| all.len() > 1) {
        let mut put = |part: fn(String) -> CasePart, make: Make| {
            found.push((Change { part: part(link.name.clone()), how: PartChange::Missing }, make));
        };
        if link.inertia > 0.0 && case.mechanism.can_turn(index) {
            put(CasePart::Body, Box::new(move |case| without_masses(case, &[index])));
        }
        // Without gravity there is no weight, and resistance to acceleration is the only effect of a mass.
        if case.gravity.norm() > 0.0 {
            let lifted = move |case: &Case| case.with(|parts| parts.loads.push(weight(case, index, -1.0))).ok();
            put(CasePart::Weight, Box::new(lifted));
            put(CasePart::Inert, Box::new(move |case| without_inertia_forces(case, &[index])));
        }
    }
    found
}

/// Moves every load that acts at a point to each other point of its link.
fn loads(case: &Case) -> Vec<(Change, Make)> {
    let mut found: Vec<(Change, Make)> = Vec::new();
    for (number, load) in case.loads.iter().enumerate() {
        for (end, side) in load.points().into_iter().enumerate() {
            let link = &case.mechanism.links()[side.link];
            for point in link.points.iter().filter(|point| point.local != side.local) {
                let at = point.local;
                let make = move |case: &Case| case.with(|parts| parts.loads[number].put_point(end, at)).ok();
                found.push(change(
                    CasePart::Load(number + 1, load.sort()),
                    PartChange::AtPoint(point.name.clone()),
                    make,
                ));
            }
        }
    }
    found
}

/// A load equal to a link's weight times a factor.
fn weight(case: &Case, link: LinkId, factor: f64) -> Load {
    let body = &case.mechanism.links()[link];
    let [x, y] = [case.gravity.x, case.gravity.y].map(|own| Course::Constant(factor * body.mass * own));
    Load::Force { at: JointSide { link, local: body.mass_centre }, force: [x, y], follows: false }
}

/// The case in which some links have weight but no inertia; `None` if this case cannot be built.
pub fn without_inertia_forces(case: &Case, of: &[LinkId]) -> Option<Case> {
    let heavy = case.with(|parts| parts.loads.extend(of.iter().map(|&link| weight(case, link, 1.0)))).ok()?;
    without_masses(&heavy, of)
}

/// The case in which the links in `of` have no mass and no moment of inertia.
fn without_masses(case: &Case, of: &[LinkId]) -> Option<Case> {
    let gone = |links: &mut [Link]| of.iter().for_each(|&link| (links[link].mass, links[link].inertia) = (0.0, 0.0));
    remade(case, |parts| changed(parts, |links, _| gone(links)))
}
