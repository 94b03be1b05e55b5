//! Random mechanisms with gears, a belt or a cam.
//! The transmission connects a link with an additional wheel or follower.

use std::f64::consts::{FRAC_PI_3, PI, TAU};

use linkage::case::{Case, CaseParts};
use linkage::input::Input;
use linkage::math::{Vec2, unit};
use linkage::mechanism::{
    AssemblyMode, CamContact, CamCurve, CamLaw, CamSegment, GroupKind, Joint, JointId, JointKind, JointSide, Link,
    LinkId, Mechanism, Point, Structure, TransmissionDesign, TransmissionKind,
};

use super::sketch::RandomSource;

/// Name of the additional wheel, and name of the wheel's axle.
const WHEEL: &str = "wheel";

/// The mechanism of `case` with a wheel on one of its links, the carrier.
/// The wheel is coupled to a link that is hinged to the carrier. The wheel's mass centre is off its axle.
/// `None` if the structure does not allow the wheel.
pub fn geared(random: &mut RandomSource, case: &Case) -> Option<Case> {
    let (joints, size) = (case.mechanism.joints(), case.mechanism.size());
    let pins: Vec<JointId> = joints.entries().filter(|(_, joint)| joint.is_pin()).map(|(id, _)| id).collect();
    let pin = pins[random.index(pins.len())];
    let [first, carrier] = match [joints[pin].first.link, joints[pin].second.link] {
        ends if random.yes() => ends,
        [one, other] => [other, one],
    };
    let (distance, start) = (size * random.number(0.2, 0.6), random.angle());
    let away = random.angle();
    let local = joints[pin].on(carrier)? + unit(away) * distance;
    let kind = kind(random, distance);
    // The arm of a follower is half as long as the distance between the axles.
    // At the start, the arm is perpendicular to the line from the cam's axle to the roller's centre.
    let start = if let TransmissionKind::Cam { .. } = kind { away + PI + FRAC_PI_3 } else { start };
    let wheel = LinkId(case.mechanism.links().len());
    let mut links = case.mechanism.links().to_vec();
    links[carrier].points.push(Point { name: WHEEL.into(), local });
    let rim = Point { name: "rim".into(), local: Vec2::new(0.5 * distance, 0.0) };
    let axle = Point { name: WHEEL.into(), local: Vec2::zeros() };
    let mass = random.number(0.3, 2.0);
    links.push(Link {
        name: WHEEL.into(),
        points: vec![axle, rim],
        mass,
        mass_centre: Vec2::new(0.1 * distance, 0.02 * distance),
        inertia: 0.05 * mass * distance * distance,
    });
    let mut all = joints.to_vec();
    let [one, other] = [JointSide { link: carrier, local }, JointSide { link: wheel, local: Vec2::zeros() }];
    all.push(Joint { name: WHEEL.into(), kind: JointKind::Revolute, first: one, second: other, drawn: None });
    let joint = JointId(joints.len());
    let design = TransmissionDesign {
        name: "pair".into(),
        kind,
        links: [first, wheel],
        carrier,
        joint,
        start,
        efficiency: [1.0; 2],
    };
    let mechanism = Mechanism::new(links, all).ok()?.with_transmissions(vec![design]).ok()?;
    let mut pose = case.start.clone();
    let placed = mechanism.joints()[joint].driven(wheel, &pose.0[carrier], Input::Turn, start);
    pose.0 = pose.0.iter().copied().chain([placed]).collect();
    let parts = CaseParts { mechanism, start: pose, ..case.clone().into_parts() };
    restructured(case, parts)
}

/// The case with changed parts and with the structure of the changed mechanism.
/// A group that also exists in `case` keeps its assembly mode.
fn restructured(case: &Case, mut parts: CaseParts) -> Option<Case> {
    parts.structure = Structure::of(&parts.mechanism, &parts.drives.joints()).ok()?;
    let mode = |own: &linkage::mechanism::Group| match own.kind {
        GroupKind::Driven => AssemblyMode::Only,
        GroupKind::Higher => AssemblyMode::Followed,
        GroupKind::Rrr | GroupKind::Rrp | GroupKind::Rpr | GroupKind::Rpp | GroupKind::Prp => {
            let same = case.structure.groups.find(|group| group.links == own.links);
            same.map_or(AssemblyMode::Only, |same| case.modes[same])
        }
    };
    parts.modes = parts.structure.groups.iter().map(mode).collect();
    Case::new(parts).ok()
}

fn kind(random: &mut RandomSource, distance: f64) -> TransmissionKind {
    if random.index(3) == 0 {
        let radii = [0, 1].map(|_| distance * random.number(0.1, 0.45));
        return TransmissionKind::Belt { radii, crossed: random.yes(), slack: random.number(0.0, 20.0) };
    }
    if random.index(3) == 0 {
        let curve = |random: &mut RandomSource| CamCurve::ALL[random.index(CamCurve::ALL.len())];
        let lift = random.number(-0.3, 0.3);
        let segments = vec![
            CamSegment { to: random.number(1.5, 2.5), lift, curve: curve(random) },
            CamSegment { to: random.number(2.6, 3.5), lift, curve: CamCurve::Cycloidal },
            CamSegment { to: TAU, lift: 0.0, curve: curve(random) },
        ];
        let contact = CamContact::Roller { centre: Vec2::new(0.5 * distance, 0.0), radius: 0.05 * distance };
        return TransmissionKind::Cam { law: CamLaw::of(segments).expect("the angles ascend to a turn"), contact };
    }
    let first = 10.0 + random.index(30) as f64;
    // The two numbers of teeth differ, because an internal gear pair requires different numbers.
    let second = first * random.number(1.2, 3.0);
    let teeth = if random.yes() { [first, second] } else { [second, first] };
    let signed = |own: f64, other: f64| if own > other { -own } else { own };
    let teeth = if random.yes() { teeth } else { [signed(teeth[0], teeth[1]), signed(teeth[1], teeth[0])] };
    TransmissionKind::Gears { teeth, pressure_angle: random.number(0.0, 0.5) }
}
