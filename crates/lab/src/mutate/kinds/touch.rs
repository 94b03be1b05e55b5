//! Helpers for planting faults. A helper selects a part of a case or an answer, and changes this part.

use linkage::case::Case;
use linkage::math::statistics::distinct;
use linkage::math::{Motion, Vec2};
use linkage::mechanism::{GROUND, Joint, JointId, Link, LinkId};
use linkage::solver::State;
use prover::diagnosis::{changed, reassembled, remade};

/// The case with changed links and joints, in the start pose of the unchanged case.
pub(super) fn with(case: &Case, change: impl FnOnce(&mut [Link], &mut [Joint])) -> Option<Case> {
    remade(case, |parts| changed(parts, change))
}

/// The case with changed links and joints, reassembled.
pub(super) fn placed(case: &Case, change: impl FnOnce(&mut [Link], &mut [Joint])) -> Option<Case> {
    remade(case, |parts| {
        changed(parts, change)?;
        reassembled(parts)
    })
}

/// The last link, which is usually the output.
pub(super) fn output(case: &Case) -> LinkId {
    LinkId(case.mechanism.links().len() - 1)
}

/// The last link without a pin on the ground: its frame moves. If all links have a pin on the ground, the last link is
/// returned.
pub(super) fn floating(case: &Case) -> LinkId {
    let held = |link: LinkId| {
        let joints = case.mechanism.joints().iter();
        joints.filter(|joint| joint.on(link).is_some()).any(|joint| joint.is_pin() && joint.on(GROUND).is_some())
    };
    case.mechanism.links().ids().skip(1).rev().find(|&link| !held(link)).unwrap_or_else(|| output(case))
}

/// The last link that can turn; if no link can turn, the last link.
/// The angular rates of links that cannot turn are only rounding noise.
pub(super) fn turner(case: &Case) -> LinkId {
    case.mechanism.links().ids().skip(1).rev().find(|&link| case.can_turn(link)).unwrap_or_else(|| output(case))
}

/// The crank's link.
pub(super) fn crank(case: &Case) -> LinkId {
    case.crank().link
}

/// The heaviest moving link. If several links are equally heavy, the last of these links is returned.
pub(super) fn heaviest(case: &Case) -> Option<LinkId> {
    let moving = case.mechanism.links().entries().skip(1).filter(|(_, link)| link.mass > 0.0);
    moving.max_by(|a, b| a.1.mass.total_cmp(&b.1.mass)).map(|(index, _)| index)
}

/// The first moving link that is not driven and has joints at two or more positions.
/// If no such link exists, the last link with joints at two or more positions is returned.
pub(super) fn coupler(case: &Case) -> Option<LinkId> {
    let is_driven = |link: LinkId| case.drives.iter().any(|drive| drive.link == link);
    let long = || case.mechanism.links().ids().skip(1).filter(|&link| ends(case, link).is_some());
    long().find(|&link| !is_driven(link)).or_else(|| long().next_back())
}

/// The joint positions on a link, without repetition, in the order of joints.
pub(super) fn places(case: &Case, link: LinkId) -> Vec<Vec2> {
    distinct(case.mechanism.joints().iter().filter_map(|joint| joint.on(link)))
}

/// The first and the last joint position on a link; `None` if the link has fewer than two.
pub(super) fn ends(case: &Case, link: LinkId) -> Option<[Vec2; 2]> {
    match places(case, link).as_slice() {
        [first, .., last] => Some([*first, *last]),
        _ => None,
    }
}

/// Moves the joint positions and the points of a link.
pub(super) fn move_places(links: &mut [Link], joints: &mut [Joint], link: LinkId, to: impl Fn(Vec2) -> Vec2) {
    links[link].points.iter_mut().for_each(|point| point.local = to(point.local));
    let sides = joints.iter_mut().flat_map(|joint| [&mut joint.first, &mut joint.second]);
    sides.filter(|side| side.link == link).for_each(|side| side.local = to(side.local));
}

/// The first prismatic joint.
pub(super) fn slider(case: &Case) -> Option<JointId> {
    case.mechanism.joints().find(Joint::slides)
}

/// The first prismatic joint whose guide moves.
pub(super) fn moving_guide(case: &Case) -> Option<JointId> {
    let is_moving = |joint: &Joint| joint.slides() && joint.first.link != GROUND && joint.second.link != GROUND;
    case.mechanism.joints().find(is_moving)
}

/// The joint between the crank and the next link. If the crank has only its driven joint, the driven joint is returned.
pub(super) fn crank_pin(case: &Case) -> JointId {
    let (own, link) = (case.crank().joint, crank(case));
    let joints = case.mechanism.joints().entries();
    joints
        .filter(|(_, joint)| joint.on(link).is_some())
        .map(|(index, _)| index)
        .find(|&index| index != own)
        .unwrap_or(own)
}

/// Changes the motion of the last turning link. `change` receives this motion and the arm of the link.
/// Returns `None` if the arm has zero length.
pub(super) fn on_arm(case: &Case, state: &mut State, change: impl FnOnce(&mut Motion, Vec2)) -> Option<()> {
    let link = turner(case);
    let arm = arm(case, state, link);
    (arm.norm() > 0.0).then(|| change(&mut state.motions[link], arm))
}

/// World vector from the origin of a link's frame to the link's last joint position.
/// If this position is the origin, the vector leads to the mass centre.
pub(super) fn arm(case: &Case, state: &State, link: LinkId) -> Vec2 {
    let last = places(case, link).last().copied().unwrap_or_else(Vec2::zeros);
    let own = &case.mechanism.links()[link];
    let local = if last.norm() > 0.0 { last } else { own.mass_centre };
    state.motions[link].arm(local)
}
