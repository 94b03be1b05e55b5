//! Lengths, guides and configurations.

use super::kind::kinds;
use super::touch::{coupler, crank, ends, move_places, moving_guide, output, placed, slider};
use linkage::case::Case;
use linkage::math::{Vec2, rotated, turned, unit};
use linkage::mechanism::{GROUND, JointId, JointKind, LinkId};
use prover::diagnosis::others;

kinds! { Geometry, Case:
    "coupler-longer" (1e-2): "the first link that is not driven is longer by a share of its length",
        |case, size| stretched(case, coupler(case)?, 1.0 + size);
    "crank-longer" (1e-2): "the crank is longer by a share of its length",
        |case, size| stretched(case, crank(case), 1.0 + size);
    "crank-half": "the crank has half its length", |case, _| stretched(case, crank(case), 0.5);
    "output-longer" (1e-2): "the last link is longer by a share of its length",
        |case, size| stretched(case, output(case), 1.0 + size);
    "pivot-aside" (1e-2): "the last pivot of the ground is moved along x by a share of the size",
        |case, size| pivot(case, |place, long| place + Vec2::new(size * long, 0.0));
    "pivot-up" (1e-2): "the last pivot of the ground is moved along y by a share of the size",
        |case, size| pivot(case, |place, long| place + Vec2::new(0.0, size * long));
    "pivot-mirrored": "the last pivot of the ground has y with the wrong sign",
        |case, _| pivot(case, |place, _| Vec2::new(place.x, -place.y));
    "point-mirrored": "a place on a link with three places is on the wrong side of the link", |case, _| {
        let joints = case.mechanism.joints();
        let off = |link: LinkId| joints.iter().filter_map(move |joint| joint.on(link)).find(|place| place.y != 0.0);
        let link = case.mechanism.links().ids().skip(1).find(|&link| off(link).is_some())?;
        let wrong = off(link)?;
        let mirrored = move |place: Vec2| if place == wrong { Vec2::new(place.x, -place.y) } else { place };
        placed(case, |links, joints| move_places(links, joints, link, mirrored))
    };
    "guide-turned" (1e-2): "the axis of the first slider is turned by an angle",
        |case, size| guided(case, slider(case)?, |axis| rotated(unit(size), axis), 0.0);
    "guide-aside" (1e-2): "the guide of the first slider is moved across by a share of the size",
        |case, size| guided(case, slider(case)?, |axis| axis, size * case.mechanism.size());
    "moving-guide-aside" (1e-2): "a guide that moves is moved across by a share of the size",
        |case, size| guided(case, moving_guide(case)?, |axis| axis, size * case.mechanism.size());
    "branch": "the first group that has another configuration is in that one",
        |case, _| others(case).into_iter().next().map(|(_, other)| other);
    "last-branch": "the last group that has another configuration is in that one",
        |case, _| others(case).into_iter().next_back().map(|(_, other)| other);
}

/// All points on a link moved away from the first one by a factor.
fn stretched(case: &Case, link: LinkId, factor: f64) -> Option<Case> {
    let [first, _] = ends(case, link)?;
    placed(case, |links, joints| move_places(links, joints, link, |place| first + (place - first) * factor))
}

/// Moves the last pin position on the ground that is not the crank's.
/// `to` is given the position and the size of the mechanism (m).
fn pivot(case: &Case, to: impl Fn(Vec2, f64) -> Vec2) -> Option<Case> {
    let pins = case.mechanism.joints().entries().filter(|(_, joint)| joint.is_pin());
    let fixed = pins.filter(|(index, _)| *index != case.crank().joint);
    let last = fixed.filter_map(|(_, joint)| joint.on(GROUND)).next_back()?;
    let (new, moved) = (to(last, case.mechanism.size()), |place, new| if place == last { new } else { place });
    if new == last {
        return None;
    }
    placed(case, |links, joints| move_places(links, joints, GROUND, |place| moved(place, new)))
}

/// A prismatic joint with another axis on its first link, and with its point there moved across (m).
fn guided(case: &Case, joint: JointId, axis: impl Fn(Vec2) -> Vec2, across: f64) -> Option<Case> {
    placed(case, |_, joints| {
        let own = &mut joints[joint];
        if let JointKind::Prismatic { axes } = &mut own.kind {
            own.first.local += turned(axes[0]) * across;
            axes[0] = axis(axes[0]);
        }
    })
}
