//! Revolute pairs: pins, pivots on the ground, and several pins at one point.

use super::mark::{Mark, MarkRole};
use linkage::math::Vec2;
use linkage::mechanism::{GROUND, JointSide, LinkId, Mechanism};

/// Radius of a pin, and spacing of the rings around it, in units of the sketch.
pub const PIN: f64 = 1.2;
const RING: f64 = 0.9;

/// Revolute joints at a common point: the point in the frame of each link, and the number of joints.
struct Place {
    sides: Vec<JointSide>,
    joints: usize,
}

/// Groups revolute pairs by their common points. Joints at the same point of one link coincide in every pose.
fn shared(mechanism: &Mechanism) -> Vec<Place> {
    let mut all: Vec<Place> = Vec::new();
    for joint in mechanism.joints().iter().filter(|joint| joint.is_pin()) {
        let sides = [joint.first, joint.second];
        let (same, mut rest): (Vec<Place>, Vec<Place>) =
            all.into_iter().partition(|place| place.sides.iter().any(|side| sides.contains(side)));
        let joints = 1 + same.iter().map(|place| place.joints).sum::<usize>();
        let mut merged: Vec<JointSide> = same.into_iter().flat_map(|place| place.sides).collect();
        merged.extend(sides.iter().filter(|side| !merged.contains(side)).copied().collect::<Vec<_>>());
        rest.push(Place { sides: merged, joints });
        all = rest;
    }
    all
}

/// Positions (m) of the revolute pairs that join a link to the ground, each position once.
pub fn pivots(mechanism: &Mechanism) -> Vec<Vec2> {
    let on_ground = |place: &Place| place.sides.iter().find(|side| side.link == GROUND).map(|side| side.local);
    shared(mechanism).iter().filter_map(on_ground).collect()
}

/// The marks of all pins and pivots, each with its link. A pin is drawn once, on the first of its links.
pub fn marks(mechanism: &Mechanism, unit: f64) -> Vec<(LinkId, Mark)> {
    let mut marks = Vec::new();
    for place in shared(mechanism) {
        let Some(side) = place.sides.iter().min_by_key(|side| side.link) else { continue };
        if side.link == GROUND {
            marks.extend(pivot(side.local, unit).into_iter().map(|mark| (GROUND, mark)));
        }
        marks.push((side.link, Mark::circle(MarkRole::Pin, side.local, PIN * unit)));
        for ring in 1..place.joints {
            let radius = (PIN + RING * ring as f64) * unit;
            marks.push((side.link, Mark::circle(MarkRole::CoincidentPin, side.local, radius)));
        }
    }
    marks
}

/// A pivot on the ground: triangle, line and hatching.
pub fn pivot(at: Vec2, unit: f64) -> Vec<Mark> {
    let corner = |x: f64, y: f64| at + Vec2::new(x, y) * unit;
    let mut marks = vec![
        Mark::area(MarkRole::Pivot, [at, corner(-2.4, -4.4), corner(2.4, -4.4)]),
        Mark::line(MarkRole::Pivot, [corner(-4.0, -4.4), corner(4.0, -4.4)]),
    ];
    marks.extend((0..6).map(|k| {
        let x = -2.7 + 1.25 * f64::from(k);
        Mark::line(MarkRole::Pivot, [corner(x, -4.4), corner(x - 1.2, -6.0)])
    }));
    marks
}
