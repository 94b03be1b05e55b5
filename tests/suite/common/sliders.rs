//! Mechanisms with prismatic joints, built by hand, with their motion in closed form.
//! Every kind of dyad with prismatic joints occurs, RPP twice: without and with rotation.
//! No frame or axis is parallel to the world's axes, and no mass centre is at a joint.
//! A wrong sign or a missing rotation therefore changes the computed motion.

pub mod double;

use super::assert_within;
use double::{oldham, scotch_yoke, slotted_crank};
use linkage::case::{Case, CaseParts, Grid, Wanted};
use linkage::drive::{Drive, MotionLaw};
use linkage::math::{Vec2, rotated, turned, unit};
use linkage::mechanism::{
    AssemblyMode, Group, GroupKind, Joint, JointId, JointKind, JointSide, Link, LinkId, LinkPose, Mechanism, Point,
    Pose, Structure,
};

/// Crank speed (rad/s).
pub const SPEED: f64 = 10.0;
/// Length of the cranks (m).
pub const CRANK: f64 = 0.1;

/// Direction of the guides on the ground (rad).
const GUIDE: f64 = 0.3;

/// A mechanism, and its closed form.
pub struct Sample {
    pub name: &'static str,
    pub case: Case,
    /// Slide of `joint` and angle of `link` as functions of the crank angle (rad), which increases at the rate `SPEED`.
    pub exact: fn(f64) -> Exact,
    pub joint: &'static str,
    pub link: &'static str,
}

/// Values with their first and second time derivatives (m, rad, s).
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    pub slide: [f64; 3],
    pub angle: [f64; 3],
}

fn link(name: &str, points: &[(&str, Vec2)], [mass, x, y, inertia]: [f64; 4]) -> Link {
    let points = points.iter().map(|&(name, local)| Point { name: name.into(), local }).collect();
    Link { name: name.into(), points, mass, mass_centre: Vec2::new(x, y), inertia }
}

fn joint(name: &str, kind: JointKind, first: (usize, Vec2), second: (usize, Vec2)) -> Joint {
    let [first, second] = [first, second].map(|(link, local)| JointSide { link: LinkId(link), local });
    Joint { name: name.into(), kind, first, second, drawn: None }
}

fn along(first: f64, second: f64) -> JointKind {
    JointKind::Prismatic { axes: [unit(first), unit(second)] }
}

/// The same case with the two links of each joint named in the reverse order.
/// The mode of an RPR dyad states which link of the pair is ahead, so the mode changes too.
pub fn swapped(case: &Case) -> Case {
    let swap = |joint: &Joint| {
        let kind = match joint.kind {
            JointKind::Prismatic { axes: [first, second] } => JointKind::Prismatic { axes: [second, first] },
            kind => kind,
        };
        Joint { kind, first: joint.second, second: joint.first, ..joint.clone() }
    };
    let joints = case.mechanism.joints().iter().map(swap).collect();
    let mechanism = Mechanism::new(case.mechanism.links().to_vec(), joints).unwrap();
    let mode = |(group, &mode): (&Group, &AssemblyMode)| match (group.kind, mode) {
        (GroupKind::Rpr, AssemblyMode::Ahead) => AssemblyMode::Behind,
        (GroupKind::Rpr, AssemblyMode::Behind) => AssemblyMode::Ahead,
        _ => mode,
    };
    let modes = case.structure.groups.iter().zip(&case.modes).map(mode).collect();
    case.with(|parts| (parts.mechanism, parts.modes) = (mechanism, modes)).unwrap()
}

/// The case with its crank as link 1, driven at joint 0.
fn case(links: Vec<Link>, joints: Vec<Joint>, mode: AssemblyMode, start: f64, to: f64, pose: Vec<LinkPose>) -> Case {
    let mechanism = Mechanism::new(links, joints).unwrap();
    let structure = Structure::of(&mechanism, &[JointId(0)]).unwrap();
    let drive = Drive::prescribed(JointId(0), LinkId(1), 0.0, start, MotionLaw::ConstantSpeed(SPEED));
    let cranks = (0..=72).map(|k| start + (to - start) * f64::from(k) / 72.0).collect();
    let case = Case::new(CaseParts {
        mechanism,
        structure,
        drives: drive.clone().into(),
        loads: Vec::new(),
        gravity: Vec2::new(0.0, -9.81),
        start: Pose(pose.into()),
        modes: vec![mode],
        grid: Grid::of_inputs(&drive, cranks),
        wanted: Wanted::ALL,
        only: None,
    });
    let case = case.unwrap();
    let closure = case.start.closure(&case.mechanism);
    assert_within!(closure, 1e-15, "the start pose is off by {closure:e} m");
    case
}

const TURN: f64 = std::f64::consts::TAU;
const PIN: JointKind = JointKind::Revolute;

fn crank() -> Link {
    link("crank", &[("O", Vec2::zeros()), ("A", Vec2::new(CRANK, 0.0))], [0.8, 0.03, 0.01, 2e-3])
}

/// All samples.
pub fn all() -> [Sample; 5] {
    [slider_crank(), swinging_guide(), scotch_yoke(), slotted_crank(), oldham()]
}

const ROD: f64 = 0.35;
const OFFSET: f64 = 0.02;
/// Axis of the slider in its link's frame, and position of the joint in this frame.
const SLIDER_AXIS: f64 = -0.5;
const SLIDER_PLACE: Vec2 = Vec2::new(0.02, 0.015);

/// RRP: crank 0.1 m, rod 0.35 m, slider whose pin moves on a line 0.02 m beside the crank's pivot.
///
/// With the crank at phi from the guide and sin(beta) = (e - a sin(phi)) / l: s = a cos(phi) + l cos(beta).
/// Both equations are differentiated twice (the formulas of a piston compressor, here with an offset).
pub fn slider_crank() -> Sample {
    // The joint points on the slider and on the guide have the same distance from the path of the pin.
    let from_pin = rotated(unit(-SLIDER_AXIS), SLIDER_PLACE);
    let guide = rotated(unit(GUIDE), Vec2::new(0.25, OFFSET + from_pin.y));
    let links = vec![
        link("ground", &[("O", Vec2::zeros()), ("G", guide)], [0.0; 4]),
        crank(),
        link("rod", &[("A", Vec2::zeros()), ("B", Vec2::new(ROD, 0.0))], [1.5, 0.15, 0.02, 0.02]),
        link("slider", &[("B", Vec2::zeros()), ("S", SLIDER_PLACE)], [2.0, 0.01, -0.02, 3e-3]),
    ];
    let joints = vec![
        joint("O", PIN, (0, Vec2::zeros()), (1, Vec2::zeros())),
        joint("A", PIN, (1, Vec2::new(CRANK, 0.0)), (2, Vec2::zeros())),
        joint("B", PIN, (2, Vec2::new(ROD, 0.0)), (3, Vec2::zeros())),
        joint("guide", along(GUIDE, SLIDER_AXIS), (0, guide), (3, SLIDER_PLACE)),
    ];
    let exact = |crank: f64| {
        let phi = crank - GUIDE;
        let beta = ((OFFSET - CRANK * phi.sin()) / ROD).asin();
        let (sin, cos) = beta.sin_cos();
        let spin = -CRANK * SPEED * phi.cos() / (ROD * cos);
        let alpha = (CRANK * SPEED * SPEED * phi.sin() + ROD * spin * spin * sin) / (ROD * cos);
        let place = CRANK * phi.cos() + ROD * cos;
        let speed = -CRANK * SPEED * phi.sin() - ROD * spin * sin;
        let second = -CRANK * SPEED * SPEED * phi.cos() - ROD * spin * spin * cos - ROD * alpha * sin;
        let ahead = rotated(unit(-SLIDER_AXIS), SLIDER_PLACE).x - 0.25;
        Exact { slide: [place + ahead, speed, second], angle: [GUIDE + beta, spin, alpha] }
    };
    let start = 0.7;
    let tip = unit(start) * CRANK;
    let rod = LinkPose { origin: tip, angle: exact(start).angle[0] };
    let slider = LinkPose { origin: rod.point(Vec2::new(ROD, 0.0)), angle: GUIDE - SLIDER_AXIS };
    let pose = vec![LinkPose::GROUND, LinkPose { origin: Vec2::zeros(), angle: start }, rod, slider];
    let case = case(links, joints, AssemblyMode::Ahead, start, start + TURN, pose);
    Sample { name: "slider-crank", case, exact, joint: "guide", link: "rod" }
}

/// The slider-crank with a rod of 0.11 m.
/// The rod is too short if the crank's tip is farther than 0.11 m from the slider's line.
/// From the start onwards, this first happens when the crank is at 180 deg + asin(0.09 / 0.1) = 244.158 deg from the
/// guide.
/// The crank angle, measured from the world's x axis, is then 261.347 deg.
pub fn short_rod() -> Case {
    let rod = 0.11;
    let case = slider_crank().case;
    let (mut links, mut joints) = (case.mechanism.links().to_vec(), case.mechanism.joints().to_vec());
    let end = Vec2::new(rod, 0.0);
    (links[2].points[1].local, joints[2].first.local) = (end, end);
    let angle = GUIDE + ((OFFSET - CRANK * (case.crank().start - GUIDE).sin()) / rod).asin();
    let changed = case.with(|parts| {
        parts.mechanism = Mechanism::new(links, joints).unwrap();
        let pose = &mut parts.start.0;
        pose[LinkId(2)].angle = angle;
        pose[LinkId(3)].origin = pose[LinkId(2)].point(end);
    });
    changed.unwrap()
}

const PIVOT: Vec2 = Vec2::new(0.25, 0.05);
const ROCKER_AXIS: f64 = 0.4;
const BLOCK_AXIS: f64 = -0.6;
const ROCKER_PLACE: Vec2 = Vec2::new(0.05, 0.01);
const BLOCK_PLACE: Vec2 = Vec2::new(-0.01, 0.02);

/// RPR: crank of 0.1 m, block on the crank pin; the block slides on a rocker that turns about (0.25, 0.05).
///
/// With the guide at eta, A = C + t e + h n (h constant): v . n = t eta', v . e = t' - h eta',
/// a . n = t eta'' + 2 t' eta' - h eta'^2, a . e = t'' - t eta'^2 - h eta''.
pub fn swinging_guide() -> Sample {
    let links = vec![
        link("ground", &[("O", Vec2::zeros()), ("C", PIVOT)], [0.0; 4]),
        crank(),
        link("block", &[("A", Vec2::zeros()), ("Q", BLOCK_PLACE)], [0.5, 0.01, 0.005, 1e-3]),
        link(
            "rocker",
            &[("C", Vec2::zeros()), ("D", ROCKER_PLACE), ("E", Vec2::new(0.4, 0.1))],
            [2.5, 0.2, 0.03, 0.03],
        ),
    ];
    let joints = vec![
        joint("O", PIN, (0, Vec2::zeros()), (1, Vec2::zeros())),
        joint("A", PIN, (1, Vec2::new(CRANK, 0.0)), (2, Vec2::zeros())),
        joint("slot", along(BLOCK_AXIS, ROCKER_AXIS), (2, BLOCK_PLACE), (3, ROCKER_PLACE)),
        joint("C", PIN, (0, PIVOT), (3, Vec2::zeros())),
    ];
    let exact = |crank: f64| {
        let tip = unit(crank) * CRANK;
        let rocker_place = rotated(unit(-ROCKER_AXIS), ROCKER_PLACE);
        let block_place = rotated(unit(-BLOCK_AXIS), BLOCK_PLACE);
        let (arm, h) = (tip - PIVOT, rocker_place.y - block_place.y);
        let t = (arm.norm_squared() - h * h).sqrt();
        let eta = arm.y.atan2(arm.x) - h.atan2(t);
        let (e, n) = (unit(eta), turned(unit(eta)));
        let (v, a) = (turned(tip) * SPEED, -tip * SPEED * SPEED);
        let spin = v.dot(&n) / t;
        let speed = v.dot(&e) + h * spin;
        let alpha = (a.dot(&n) - 2.0 * speed * spin + h * spin * spin) / t;
        let second = a.dot(&e) + t * spin * spin + h * alpha;
        // The slide is measured from the block, the joint's first link, to the rocker.
        let slide = rocker_place.x - (t + block_place.x);
        let turns = if eta < 0.0 { TURN } else { 0.0 };
        Exact { slide: [slide, -speed, -second], angle: [eta - ROCKER_AXIS + turns, spin, alpha] }
    };
    let start = 0.7;
    let rocker = exact(start).angle[0];
    let pose = vec![
        LinkPose::GROUND,
        LinkPose { origin: Vec2::zeros(), angle: start },
        LinkPose { origin: unit(start) * CRANK, angle: rocker + ROCKER_AXIS - BLOCK_AXIS },
        LinkPose { origin: PIVOT, angle: rocker },
    ];
    let case = case(links, joints, AssemblyMode::Behind, start, start + TURN, pose);
    Sample { name: "swinging guide", case, exact, joint: "slot", link: "rocker" }
}
