//! Faults in lengths, guides and configurations.

use super::kind::kinds;
use super::touch::{coupler, crank, ends, move_places, moving_guide, output, placed, slider};
use linkage::case::Case;
use linkage::math::{Vec2, rotated, turned, unit};
use linkage::mechanism::{GROUND, JointId, JointKind, LinkId, TransmissionDesign, TransmissionId};
use prover::diagnosis::{others, recoupled, remade};

kinds! { Geometry, Case:
    "coupler-longer" (1e-2): "the first link that is not driven is too long by a fraction of its length",
        |case, size| stretched(case, coupler(case)?, 1.0 + size);
    "crank-longer" (1e-2): "the crank is too long by a fraction of its length",
        |case, size| stretched(case, crank(case), 1.0 + size);
    "crank-half": "the crank has half its length", |case, _| stretched(case, crank(case), 0.5);
    "output-longer" (1e-2): "the last link is too long by a fraction of its length",
        |case, size| stretched(case, output(case), 1.0 + size);
    "pivot-aside" (1e-2): "the last ground pivot is displaced along x by a fraction of the mechanism's size",
        |case, size| pivot(case, |place, long| place + Vec2::new(size * long, 0.0));
    "pivot-up" (1e-2): "the last ground pivot is displaced along y by a fraction of the mechanism's size",
        |case, size| pivot(case, |place, long| place + Vec2::new(0.0, size * long));
    "pivot-mirrored": "the y coordinate of the last ground pivot has the wrong sign",
        |case, _| pivot(case, |place, _| Vec2::new(place.x, -place.y));
    "point-mirrored": "a joint off the x axis of its link is mirrored about this axis", |case, _| {
        let joints = case.mechanism.joints();
        let off = |link: LinkId| joints.iter().filter_map(move |joint| joint.on(link)).find(|place| place.y != 0.0);
        let link = case.mechanism.links().ids().skip(1).find(|&link| off(link).is_some())?;
        let wrong = off(link)?;
        let mirrored = move |place: Vec2| if place == wrong { Vec2::new(place.x, -place.y) } else { place };
        placed(case, |links, joints| move_places(links, joints, link, mirrored))
    };
    "guide-turned" (1e-2): "the guide axis of the first slider is rotated by an angle (rad)",
        |case, size| guided(case, slider(case)?, |axis| rotated(unit(size), axis), 0.0);
    "guide-aside" (1e-2): "the guide of the first slider is shifted sideways by a fraction of the mechanism's size",
        |case, size| guided(case, slider(case)?, |axis| axis, size * case.mechanism.size());
    "moving-guide-aside" (1e-2): "a moving guide is shifted sideways by a fraction of the mechanism's size",
        |case, size| guided(case, moving_guide(case)?, |axis| axis, size * case.mechanism.size());
    "ratio" (1e-2): "the ratio of the first transmission, or the lift of a cam, is too large by a relative amount",
        |case, size| coupled(case, |own| own.times_ratio(1.0 + size));
    "ratio-inverted": "the ratio of the first transmission is inverted", |case, _| {
        let ratio = case.mechanism.transmissions().first()?.ratio()?;
        ((ratio.abs() - 1.0).abs() > 1e-9).then_some(())?;
        coupled(case, |own| own.times_ratio(ratio.powi(-2)))
    };
    "ratio-sign": "the first transmission turns its second wheel in the wrong sense",
        |case, _| coupled(case, |own| own.times_ratio(-1.0));
    "pressure-angle" (1e-2): "the pressure angle of the first gears is too large by a relative amount",
        |case, size| coupled(case, |own| own.with_pressure_angle(own.pressure_angle()? * (1.0 + size)));
    "pressure-angle-side": "the teeth of the first gears pull instead of pushing",
        |case, _| coupled(case, |own| own.with_pressure_angle(-own.pressure_angle()?));
    "pressure-angle-missing": "the tooth force of the first gears has no radial part",
        |case, _| coupled(case, |own| own.with_pressure_angle(0.0 * own.pressure_angle()?));
    "branch": "the first group with several configurations is in the wrong one",
        |case, _| others(case).into_iter().next().map(|(_, other)| other);
    "last-branch": "the last group with several configurations is in the wrong one",
        |case, _| others(case).into_iter().next_back().map(|(_, other)| other);
}

/// Changes the first transmission.
fn coupled(case: &Case, change: impl Fn(&TransmissionDesign) -> Option<TransmissionDesign>) -> Option<Case> {
    remade(case, |parts| {
        let other = change(&parts.mechanism.transmissions().first()?.design);
        recoupled(parts, TransmissionId(0), other)
    })
}

/// Multiplies the distances of a link's points and joints from the link's first joint by a factor.
fn stretched(case: &Case, link: LinkId, factor: f64) -> Option<Case> {
    let [first, _] = ends(case, link)?;
    placed(case, |links, joints| move_places(links, joints, link, |place| first + (place - first) * factor))
}

/// Moves the last pivot on the ground other than the crank's pivot.
/// The arguments of `to` are the position and the size of the mechanism (m).
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

/// Replaces a prismatic joint's axis on the joint's first link by the result of `axis`.
/// Moves the joint's point on this link by `across` (m), perpendicular to the old axis.
fn guided(case: &Case, joint: JointId, axis: impl Fn(Vec2) -> Vec2, across: f64) -> Option<Case> {
    placed(case, |_, joints| {
        let own = &mut joints[joint];
        if let JointKind::Prismatic { axes } = &mut own.kind {
            own.first.local += turned(axes[0]) * across;
            axes[0] = axis(axes[0]);
        }
    })
}
