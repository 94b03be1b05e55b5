//! Symbols of everything that acts on a mechanism: drives, motors, forces, moments, torsional springs and dampers.

use super::mark::{Mark, MarkRole, MarkShape};
use linkage::drive::{Drive, Load, On};
use linkage::math::{KeepNan, Vec2, turned, unit};
use linkage::mechanism::{GROUND, JointId, JointSide, LinkId, Mechanism};
use std::f64::consts::{PI, TAU};

/// Radius of the arrow that shows a drive's direction, in units of the sketch. `SWEEP` is the angle of its arc (rad).
/// `AHEAD` is the angle from the driven link to the arrow's start (rad).
const DRIVE: f64 = 8.0;
const SWEEP: f64 = 1.7;
const AHEAD: f64 = 0.35;
/// Distance of a slide's arrow from the joint, in units of the sketch.
const BESIDE: f64 = 5.5;
/// Radius of a motor's circle, in units of the sketch.
const MOTOR: f64 = 3.4;
/// Length of an arrow's head, in units of the sketch.
/// `HEAD_SHARE` limits this length to a fraction of the arrow's length.
/// `HALF` is half the width of the head, in units of the sketch.
const HEAD: f64 = 2.8;
const HEAD_SHARE: f64 = 0.45;
const HALF: f64 = 0.9;
/// Smallest and largest radius of a spiral in units of the sketch, its number of turns, and its number of drawn steps.
const SPIRAL: [f64; 2] = [1.9, 4.6];
const TURNS: f64 = 2.25;
const STEPS: usize = 54;
/// Radius of a torsional damper's drum, in units of the sketch.
const DRUM: f64 = 5.4;

/// A load drawn as an arrow. The arrow's size and direction are known only for a given state of the mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadSign {
    /// Index of the load in the loads of its case.
    pub load: usize,
    /// Point at which the arrow is drawn. A force is drawn at the point on which the force acts.
    /// A moment on a link is drawn at a pin of the link, else at a point or the mass centre.
    /// A load at a joint is drawn at the joint's point on a moving link.
    pub at: JointSide,
}

/// The point at which moments on a link are drawn: the link's pin on the ground.
/// If no pin is on the ground, moments are drawn at another pin of the link, else at a point, else at the mass centre.
fn place_of(mechanism: &Mechanism, link: LinkId) -> Vec2 {
    let pins = || mechanism.joints().iter().filter(|joint| joint.is_pin() && joint.on(link).is_some());
    let on_ground = pins().find(|joint| joint.other(link).link == GROUND);
    let pin = on_ground.or_else(|| pins().next()).and_then(|joint| joint.on(link));
    let point = || mechanism.links()[link].points.first().map(|point| point.local);
    pin.or_else(point).unwrap_or(mechanism.links()[link].mass_centre)
}

/// The point at which torsional springs and dampers between two links are drawn.
fn place_between(mechanism: &Mechanism, links: [LinkId; 2]) -> JointSide {
    let common = mechanism.joints().iter().find(|joint| links.iter().all(|&link| joint.on(link).is_some()));
    match common.and_then(|joint| joint.on(links[0])) {
        Some(local) => JointSide { link: links[0], local },
        None => {
            let link = if links[0] == GROUND { links[1] } else { links[0] };
            JointSide { link, local: place_of(mechanism, link) }
        }
    }
}

/// The arrow of a load. `None` for friction, and for springs and dampers between points or links.
/// These springs and dampers have symbols instead of arrows.
pub fn of_load(mechanism: &Mechanism, number: usize, load: &Load) -> Option<LoadSign> {
    match load.nature().on {
        On::Link(link) => Some(LoadSign { load: number, at: JointSide { link, local: place_of(mechanism, link) } }),
        On::Point(at) => Some(LoadSign { load: number, at }),
        On::Joint(joint, _) if !load.is_friction() => {
            let joint = &mechanism.joints()[joint];
            Some(LoadSign { load: number, at: if joint.second.link == GROUND { joint.first } else { joint.second } })
        }
        On::Points(_) | On::Links(_) | On::Joint(..) => None,
    }
}

/// The symbol of a torsional spring or damper, and the link to which the symbol is fixed. `None` for other loads.
pub fn twisted(mechanism: &Mechanism, load: &Load, u: f64) -> Option<(LinkId, Vec<Mark>)> {
    let On::Links(links) = load.nature().on else { return None };
    let JointSide { link, local } = place_between(mechanism, links);
    if !load.is_viscous() {
        let step = |k: usize| {
            let share = k as f64 / STEPS as f64;
            local + unit(TURNS * TAU * share) * ((SPIRAL[0] + (SPIRAL[1] - SPIRAL[0]) * share) * u)
        };
        return Some((link, vec![Mark::line(MarkRole::TorsionSpring, (0..=STEPS).map(step).collect::<Vec<_>>())]));
    }
    let (from, sweep) = (-0.75 * PI, 1.5 * PI);
    let vane = [DRUM - 1.0, DRUM + 1.0].map(|radius| local + unit(PI / 4.0) * (radius * u));
    let ends = [from, from + sweep].map(|angle| {
        Mark::line(MarkRole::TorsionDamper, [DRUM - 1.0, DRUM].map(|radius| local + unit(angle) * (radius * u)))
    });
    let [first, last] = ends;
    let drum = Mark::arc(MarkRole::TorsionDamper, local, DRUM * u, [from, sweep]);
    Some((link, vec![drum, Mark::line(MarkRole::TorsionDamper, vane), first, last]))
}

/// The symbols of a drive, in the frame of the driven link: an arrow in the direction of motion, and a circle for the
/// motor.
pub fn of_drive(mechanism: &Mechanism, drive: &Drive, u: f64) -> Vec<Mark> {
    let mut marks = match drive.has_moment() {
        true => of_driven(mechanism, drive.joint, drive.link, drive.sense(), u),
        false => Vec::new(),
    };
    if let (Some(_), Some(pin)) = (drive.motor(), mechanism.joints()[drive.joint].on(drive.link)) {
        marks.push(Mark::circle(MarkRole::Motor, pin, MOTOR * u));
    }
    marks
}

/// The arrow at a driven joint, in the frame of the driven link. `sense` is 1 or -1, as [`Drive::sense`].
pub fn of_driven(mechanism: &Mechanism, joint: JointId, link: LinkId, sense: f64, u: f64) -> Vec<Mark> {
    let joint = &mechanism.joints()[joint];
    let Some(pin) = joint.on(link) else { return Vec::new() };
    if let Some(axis) = joint.axis_on(link) {
        // The arrow is beside the joint and points in the direction in which the slide moves the link.
        let sign = if joint.second.link == link { sense } else { -sense };
        let marked = arrow(axis * (sign * 2.0 * DRIVE * u), u);
        let beside = pin + turned(axis) * (BESIDE * u) - axis * (sign * DRIVE * u);
        let roles = [MarkRole::Drive, MarkRole::DriveHead];
        return marked.into_iter().zip(roles).map(|(mark, role)| moved(mark, role, beside)).collect();
    }
    let places = super::body::places(mechanism, link);
    let arm = places.iter().map(|at| at - pin).max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let arm = arm.unwrap_or_else(|| Vec2::new(1.0, 0.0));
    let [arc, head] = turning(sense, DRIVE * u, arm.y.atan2(arm.x) + sense * AHEAD, u);
    vec![moved(arc, MarkRole::Drive, pin), moved(head, MarkRole::DriveHead, pin)]
}

fn moved(mark: Mark, role: MarkRole, by: Vec2) -> Mark {
    let shape = match mark.shape {
        MarkShape::Line { points, closed } => {
            MarkShape::Line { points: points.into_iter().map(|at| at + by).collect(), closed }
        }
        MarkShape::Circle { centre, radius } => MarkShape::Circle { centre: centre + by, radius },
        MarkShape::Arc { centre, radius, from, sweep } => MarkShape::Arc { centre: centre + by, radius, from, sweep },
    };
    Mark { shape, role }
}

/// An arrow from the origin to `tip` (m): its line and its head. The sketch has the unit `unit` (m).
pub fn arrow(tip: Vec2, unit: f64) -> Vec<Mark> {
    let length = tip.norm();
    if !(length > 0.0 && length.is_finite()) {
        return Vec::new();
    }
    let along = tip / length;
    let head = (HEAD * unit).smaller(HEAD_SHARE * length);
    let (base, side) = (tip - along * head, turned(along) * (head * HALF / HEAD));
    vec![
        Mark::line(MarkRole::Load, [Vec2::zeros(), tip - along * (0.7 * head)]),
        Mark::area(MarkRole::LoadHead, [tip, base + side, base - side]),
    ]
}

/// An arrow around the origin: its arc and its head. The arrow is counter-clockwise for a `sense` above 0.
/// Seen from the origin, the start of the arrow lies in the direction `from` (rad) at the distance `radius` (m).
/// `u` is the unit of the sketch (m).
pub fn turning(sense: f64, radius: f64, from: f64, u: f64) -> [Mark; 2] {
    let sense = sense.signum();
    let end = unit(from + sense * SWEEP) * radius;
    let tangent = turned(end).normalize() * sense;
    let corner = |along: f64, aside: f64| end + tangent * (along * u) + turned(tangent) * (aside * u);
    [
        Mark::arc(MarkRole::Load, Vec2::zeros(), radius, [from, sense * SWEEP]),
        Mark::area(MarkRole::LoadHead, [corner(2.6, 0.0), corner(-0.2, HALF), corner(-0.2, -HALF)]),
    ]
}
