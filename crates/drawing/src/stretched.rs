//! Springs and dampers between two points. Each drawing is stretched to the distance of the two points.

use super::mark::{Mark, MarkRole};
use linkage::drive::{Load, On};
use linkage::math::Vec2;
use linkage::mechanism::JointSide;

/// Width of springs and dampers, in units of the sketch.
const WIDTH: f64 = 4.0;
/// Distance between the middle lines of parallel springs and dampers, divided by their width.
const APART: f64 = 1.25;
/// Number of teeth of a spring's zigzag.
/// `COIL` gives the fractions of the spring's length at which the teeth begin and end.
const TEETH: usize = 8;
const COIL: [f64; 2] = [0.18, 0.82];

/// A spring or damper from a point of one link to a point of another link.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretched {
    /// [`MarkRole::Spring`] or [`MarkRole::Damper`].
    pub role: MarkRole,
    /// Index of the load in the loads of its case.
    pub load: usize,
    /// End points.
    pub ends: [JointSide; 2],
    /// Width (m). In `marks`, the unit of y is this width, and the unit of x is the distance between the ends.
    pub width: f64,
    /// The drawing from (0, 0) to (1, 0); lines only.
    pub marks: Vec<Mark>,
}

impl Stretched {
    /// World position of a point of the drawing (m), given the world positions of the ends (m).
    pub fn at(&self, local: Vec2, [start, end]: [Vec2; 2]) -> Vec2 {
        let span = end - start;
        let across = if span.norm() > 0.0 { linkage::math::turned(span.normalize()) } else { Vec2::zeros() };
        start + span * local.x + across * (local.y * self.width)
    }
}

/// The springs and dampers among loads.
pub fn of_loads(loads: &[Load], unit: f64) -> Vec<Stretched> {
    let mut all: Vec<Stretched> = Vec::new();
    for (load, own) in loads.iter().enumerate() {
        let On::Points(ends) = own.nature().on else { continue };
        let role = if own.is_viscous() { MarkRole::Damper } else { MarkRole::Spring };
        all.push(Stretched { role, load, ends, width: WIDTH * unit, marks: Vec::new() });
    }
    let same = |a: &Stretched, b: &Stretched| a.ends == b.ends || a.ends == [b.ends[1], b.ends[0]];
    let aside = |(index, own): (usize, &Stretched)| {
        let together: Vec<usize> = (0..all.len()).filter(|&other| same(own, &all[other])).collect();
        let before = together.iter().filter(|&&other| other < index).count();
        let side = if all[together[0]].ends == own.ends { 1.0 } else { -1.0 };
        side * APART * (before as f64 - (together.len() as f64 - 1.0) / 2.0)
    };
    let asides: Vec<f64> = all.iter().enumerate().map(aside).collect();
    for (own, aside) in all.iter_mut().zip(asides) {
        own.marks = if own.role == MarkRole::Spring { spring(aside) } else { damper(aside) };
    }
    all
}

/// A zigzag between two straight ends, at the distance `aside` from the middle line.
fn spring(aside: f64) -> Vec<Mark> {
    let tooth = |k: usize| {
        let x = COIL[0] + (COIL[1] - COIL[0]) * (k as f64 + 0.5) / TEETH as f64;
        Vec2::new(x, aside + if k.is_multiple_of(2) { 0.5 } else { -0.5 })
    };
    let mut points = vec![Vec2::zeros(), Vec2::new(0.0, aside), Vec2::new(COIL[0], aside)];
    points.extend((0..TEETH).map(tooth));
    points.extend([Vec2::new(COIL[1], aside), Vec2::new(1.0, aside), Vec2::new(1.0, 0.0)]);
    vec![Mark::line(MarkRole::Spring, points)]
}

/// The drawing of a damper: a cup with one open end, and a piston with its rod.
fn damper(aside: f64) -> Vec<Mark> {
    let at = |x: f64, y: f64| Vec2::new(x, y + aside);
    let cup = [at(0.68, 0.5), at(0.36, 0.5), at(0.36, -0.5), at(0.68, -0.5)];
    [
        vec![Vec2::zeros(), at(0.0, 0.0), at(0.36, 0.0)],
        cup.to_vec(),
        vec![at(0.54, 0.36), at(0.54, -0.36)],
        vec![at(0.54, 0.0), at(1.0, 0.0), Vec2::new(1.0, 0.0)],
    ]
    .map(|points| Mark::line(MarkRole::Damper, points))
    .to_vec()
}
