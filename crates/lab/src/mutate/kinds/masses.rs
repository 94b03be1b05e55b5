//! Faults in gravity, masses, mass centres and moments of inertia.

use super::kind::kinds;
use super::touch::{crank, ends, heaviest, output, with};
use linkage::case::Case;
use linkage::math::Vec2;
use linkage::mechanism::{Link, LinkId};
use prover::diagnosis::remade;

kinds! { Mass, Case:
    "gravity-missing": "gravity is missing", |case, _| gravity(case, |_| Vec2::zeros());
    "gravity-sign": "gravity points in the opposite direction", |case, _| gravity(case, |own| -own);
    "gravity-axis": "x and y of gravity are exchanged", |case, _| gravity(case, |own| Vec2::new(own.y, own.x));
    "gravity-size" (3.4e-4): "gravity is too large by a relative amount, such as 9.81 for 9.80665",
        |case, size| gravity(case, |own| own * (1.0 + size));
    "gravity-mm": "gravity is in mm/s²", |case, _| gravity(case, |own| own * 1e3);
    "mass-missing": "the heaviest link has no mass", |case, _| on(case, heaviest(case), |link| link.mass = 1e-12);
    "mass-heaviest" (1e-2): "the mass of the heaviest link is too large by a relative amount",
        |case, size| on(case, heaviest(case), |link| link.mass *= 1.0 + size);
    "mass-grams": "the mass of the heaviest link in kilograms is taken for grams",
        |case, _| on(case, heaviest(case), |link| link.mass *= 1e-3);
    "mass-crank" (1e-2): "the mass of the crank is too large by a relative amount",
        |case, size| on(case, massive(case, crank(case)), |link| link.mass *= 1.0 + size);
    "mass-output" (1e-2): "the mass of the last link is too large by a relative amount",
        |case, size| on(case, massive(case, output(case)), |link| link.mass *= 1.0 + size);
    "masses-exchanged": "the masses of the first and the last link are exchanged", |case, _| {
        let last = output(case);
        let [first, other] = [LinkId(1), last].map(|link| case.mechanism.links()[link].mass);
        (last > LinkId(1) && first != other).then_some(())?;
        with(case, |links, _| (links[1].mass, links[last].mass) = (other, first))
    };
    "inertia-missing": "the moment of inertia of the last link that has one is zero",
        |case, _| on(case, turning(case), |link| link.inertia = 0.0);
    "inertia" (1e-2): "the moment of inertia of the last link that has one is too large by a relative amount",
        |case, size| on(case, turning(case), |link| link.inertia *= 1.0 + size);
    "inertia-crank" (1e-1): "the moment of inertia of the crank is too large by a relative amount", |case, size| {
        let has = Some(crank(case)).filter(|&link| case.mechanism.links()[link].inertia > 0.0);
        on(case, has, |link| link.inertia *= 1.0 + size)
    };
    "inertia-twice": "the moment of inertia of the last link that has one is doubled",
        |case, _| on(case, turning(case), |link| link.inertia *= 2.0);
    "inertia-about-joint": "a moment of inertia is taken about a joint: m l^2 / 3 instead of m l^2 / 12", |case, _| {
        let link = case.mechanism.links().ids().skip(1).rev().find(|&link| steiner(case, link) > 0.0)?;
        let more = steiner(case, link);
        on(case, Some(link), |link| link.inertia += more)
    };
    "inertias-missing": "all moments of inertia are zero", |case, _| {
        case.mechanism.links().iter().any(|link| link.inertia > 0.0).then_some(())?;
        with(case, |links, _| links.iter_mut().for_each(|link| link.inertia = 0.0))
    };
    "inertia-cm2": "a moment of inertia in kg·m² is taken for kg·cm²",
        |case, _| on(case, turning(case), |link| link.inertia *= 1e-4);
    "centre-along" (1e-2): "the mass centre of the heaviest link is off along x by a fraction of the link's extent",
        |case, size| on(case, heaviest(case), |link| link.mass_centre.x += size * link.extent());
    "centre-across" (1e-2): "the mass centre of the heaviest link is off along y by a fraction of the link's extent",
        |case, size| on(case, heaviest(case), |link| link.mass_centre.y += size * link.extent());
    "centre-at-joint": "the mass centre of the heaviest link with an offset mass centre is at the frame origin",
        |case, _| on(case, off_frame(case), |link| link.mass_centre = Vec2::zeros());
    "centre-half": "the mass centre of a link is at half its distance from the frame origin",
        |case, _| on(case, off_frame(case), |link| link.mass_centre *= 0.5);
    "centre-mirrored": "the mass centre of a link is on the opposite side of the frame origin",
        |case, _| on(case, off_frame(case), |link| link.mass_centre *= -1.0);
    "centre-other-end": "the mass centre of a link is measured from the wrong end of the link", |case, _| {
        let link = case.mechanism.links().ids().skip(1).rev().find(|&link| measured(case, link).is_some())?;
        let centre = measured(case, link)?;
        on(case, Some(link), |link| link.mass_centre = centre)
    };
    "centre-mm": "the mass centre of a link in metres is taken for millimetres",
        |case, _| on(case, off_frame(case), |link| link.mass_centre *= 1e-3);
}

fn gravity(case: &Case, to: impl Fn(Vec2) -> Vec2) -> Option<Case> {
    (case.gravity.norm() > 0.0).then_some(())?;
    remade(case, |parts| {
        parts.gravity = to(parts.gravity);
        Some(())
    })
}

fn on(case: &Case, link: Option<LinkId>, change: impl Fn(&mut Link)) -> Option<Case> {
    let link = link?;
    with(case, |links, _| change(&mut links[link]))
}

fn massive(case: &Case, link: LinkId) -> Option<LinkId> {
    (case.mechanism.links()[link].mass > 0.0).then_some(link)
}

/// The last link that can turn and has a moment of inertia.
fn turning(case: &Case) -> Option<LinkId> {
    let has = |&link: &LinkId| case.mechanism.links()[link].inertia > 0.0 && case.can_turn(link);
    case.mechanism.links().ids().skip(1).rev().find(has)
}

/// The heaviest link whose mass centre is not at the origin of its frame.
fn off_frame(case: &Case) -> Option<LinkId> {
    let links = case.mechanism.links();
    let off = links.ids().skip(1).filter(|&link| links[link].mass > 0.0 && links[link].mass_centre.norm() > 0.0);
    off.max_by(|&a, &b| links[a].mass.total_cmp(&links[b].mass))
}

/// Mass times the squared distance of the mass centre from the first joint (kg m^2).
fn steiner(case: &Case, link: LinkId) -> f64 {
    let own = &case.mechanism.links()[link];
    let place = case.mechanism.joints().iter().find_map(|joint| joint.on(link));
    place.map_or(0.0, |place| own.mass * (place - own.mass_centre).norm_squared())
}

/// A wrong mass centre: the position of the link's last joint, minus the vector from the first joint to the correct
/// mass centre.
/// `None` if the position does not change.
fn measured(case: &Case, link: LinkId) -> Option<Vec2> {
    let [first, last] = ends(case, link)?;
    let own = &case.mechanism.links()[link];
    let centre = last - (own.mass_centre - first);
    (own.mass > 0.0 && (centre - own.mass_centre).norm() > 1e-9 * own.extent()).then_some(centre)
}
