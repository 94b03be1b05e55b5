//! Prismatic pairs: block on rails, block in a slot, piston in a cylinder.

use super::body::places;
use super::mark::{Mark, MarkRole};
use super::pins::pivots;
use super::travel::Travels;
use linkage::math::{KeepNan, Vec2, cross, turned};
use linkage::mechanism::{GROUND, Guise, Joint, JointId, JointSide, LinkId, Mechanism};

/// Half length and half width of a block, in units of the sketch. `FIXED` is for a fixed guide, `MOVING` for a moving
/// guide.
/// The sizes differ, so that two blocks at the same point are both visible.
const FIXED: [f64; 2] = [5.0, 3.2];
const MOVING: [f64; 2] = [3.8, 2.0];
/// Clearance between a block and the wall beside it, in units of the sketch.
const PLAY: f64 = 0.5;
/// Gap between a piston and the head of its cylinder, in units of the sketch.
const HEAD: f64 = 2.5;
/// Length of hatching lines, and their spacing along the rail, in units of the sketch.
const HATCH: f64 = 1.6;
const PITCH: f64 = 2.0;
/// Largest length of a centre line beyond the end of the rail (in units of the sketch). Centre lines are extended
/// towards the guide's point on the ground.
const AXIS: f64 = 150.0;
/// Rails are interrupted within a box around each pivot. Lengths are in units of the sketch.
/// `BELOW` is the distance of the box's centre below the pin. `BOX` is half the box's width, and half its height.
const BELOW: f64 = 2.0;
const BOX: [f64; 2] = [5.2, 5.0];
/// If one of these words occurs in the name of the joint or of one of its links, the pair is a piston in a cylinder.
const CYLINDERS: [&str; 4] = ["bore", "cylinder", "piston", "plunger"];
/// A point of a link counts as on the axis if its distance from the axis is at most this fraction of the link's extent.
/// The extent is the largest distance of the link's points from the block's point.
const ON_AXIS: f64 = 1e-6;

/// The guide of a joint and the block that slides on it.
struct Guide {
    guide: JointSide,
    block: JointSide,
    /// Unit vectors along the guide, in the frame of the guide's link and in the frame of the block's link.
    axes: [Vec2; 2],
    /// Ends of the block's travel, as distances from the guide's point along the axis (m).
    travel: [f64; 2],
    /// Half length and half width of the block (m).
    half: [f64; 2],
    is_cylinder: bool,
    unit: f64,
}

/// The marks of all guides and blocks, each with its link.
pub fn marks(mechanism: &Mechanism, travels: &Travels, unit: f64) -> Vec<(LinkId, Mark)> {
    let guide = |(index, joint): (JointId, &Joint)| {
        let [guide, block] = mechanism.guide_and_block(joint)?;
        let axes = [joint.axis_on(guide.link)?, joint.axis_on(block.link)?];
        let half = if guide.link == GROUND { FIXED } else { MOVING }.map(|part| part * unit);
        let is_cylinder = is_cylinder(mechanism, joint, guide, block, axes[1]);
        Some(Guide { guide, block, axes, travel: travels.of(index).unwrap_or([0.0; 2]), half, is_cylinder, unit })
    };
    let guides = mechanism.joints().entries().filter_map(guide);
    let mut drawn: Vec<[Vec2; 2]> = Vec::new();
    let pivots = pivots(mechanism);
    let mut marks = Vec::new();
    for guide in guides {
        marks.extend(guide.block().into_iter().map(|mark| (guide.block.link, mark)));
        let is_fixed = guide.guide.link == GROUND;
        let of_guide = if is_fixed { guide.fixed(&pivots, &mut drawn) } else { guide.moving() };
        marks.extend(of_guide.into_iter().map(|mark| (guide.guide.link, mark)));
    }
    marks
}

/// Whether a prismatic pair is drawn as a piston in a cylinder.
/// If the joint states how it is drawn, this statement decides.
/// Otherwise, the pair is a cylinder if the name of the joint or of a link contains one of the words [`CYLINDERS`].
/// A pair is also a cylinder if the guide moves and all points of the block's link lie on the axis.
fn is_cylinder(mechanism: &Mechanism, joint: &Joint, guide: JointSide, block: JointSide, axis: Vec2) -> bool {
    if let Some(guise) = joint.drawn {
        return guise == Guise::Cylinder;
    }
    let links = [guide, block].map(|side| mechanism.links()[side.link].name.as_str());
    let has_word = |name: &str| CYLINDERS.iter().any(|word| name.to_lowercase().contains(word));
    let rod: Vec<Vec2> = places(mechanism, block.link).iter().map(|at| at - block.local).collect();
    let far = rod.iter().map(|arm| arm.norm()).fold(0.0, f64::larger);
    let is_rod = far > 0.0 && rod.iter().all(|arm| cross(axis, *arm).abs() <= ON_AXIS * far);
    has_word(&joint.name) || links.into_iter().any(has_word) || guide.link != GROUND && is_rod
}

impl Guide {
    /// Half width of the gap in which the block moves (m).
    fn gap(&self) -> f64 {
        self.half[1] + PLAY * self.unit
    }

    /// Distances from the guide's point to both ends of the range that the block covers (m).
    fn covered(&self) -> [f64; 2] {
        [self.travel[0] - self.half[0], self.travel[1] + self.half[0]]
    }

    /// The corners of a strip around the guide, in the frame of the guide's link.
    fn strip(&self, [from, to]: [f64; 2], half: f64) -> [Vec2; 4] {
        let aside = turned(self.axes[0]) * half;
        let [start, end] = [from, to].map(|way| self.guide.local + self.axes[0] * way);
        [start + aside, start - aside, end - aside, end + aside]
    }

    fn block(&self) -> Vec<Mark> {
        let [long, wide] = self.half;
        let (along, aside) = (self.axes[1] * long, turned(self.axes[1]) * wide);
        let at = self.block.local;
        let role = if self.is_cylinder { MarkRole::Piston } else { MarkRole::Block };
        let mut marks =
            vec![Mark::area(role, [along + aside, aside - along, -along - aside, along - aside].map(|arm| at + arm))];
        if self.is_cylinder {
            let ring = |share: f64| {
                let end = along * (self.head() * share);
                Mark::line(MarkRole::Piston, [at + end + aside, at + end - aside])
            };
            marks.extend([0.45, 0.7].map(ring));
        }
        marks
    }

    /// Side of a cylinder's closed end: 1 in the direction of the axis, -1 in the opposite direction.
    /// The closed end is the end that is farther from the guide's point.
    /// The rod that moves the piston comes through the open end, usually from a crank at the guide's point.
    fn head(&self) -> f64 {
        if self.travel[1] + self.travel[0] >= 0.0 { 1.0 } else { -1.0 }
    }

    /// Ends of a cylinder: the ends of the range that the piston covers, extended by a gap at the cylinder's head.
    fn barrel(&self) -> [f64; 2] {
        let [from, to] = self.covered();
        if self.head() > 0.0 { [from, to + HEAD * self.unit] } else { [from - HEAD * self.unit, to] }
    }

    /// Marks of a moving guide: a slot, or a cylinder that is open opposite its head.
    /// If the slot or cylinder does not reach the guide's point, a bar connects it with this point.
    fn moving(&self) -> Vec<Mark> {
        let ([from, to], play) = (self.covered(), PLAY * self.unit);
        let ends = if self.is_cylinder { self.barrel() } else { [from - play, to + play] };
        let strip = self.strip(ends, self.gap());
        let guide = match self.is_cylinder {
            true => Mark::line(MarkRole::Cylinder, self.open(strip)),
            false => Mark::area(MarkRole::Slot, strip),
        };
        self.lead(ends).into_iter().chain([guide]).collect()
    }

    /// The corners of a strip, in order: from the strip's open end, around its closed end, and back.
    fn open(&self, [a, b, c, d]: [Vec2; 4]) -> [Vec2; 4] {
        if self.head() > 0.0 { [a, d, c, b] } else { [d, a, b, c] }
    }

    /// The bar from the guide's point to a slot or cylinder that does not reach this point.
    fn lead(&self, [from, to]: [f64; 2]) -> Option<Mark> {
        let near = 0.0_f64.clamp(from, to);
        let ends = [0.0, near].map(|way| self.guide.local + self.axes[0] * way);
        (near != 0.0).then(|| Mark::line(MarkRole::Bar, ends))
    }

    /// Marks of a fixed guide: its hatched rails or its hatched bore, and its centre line.
    /// Rails are interrupted at pivots.
    /// Where a rail lies on an earlier rail, the later rail is not hatched, because the lines of a second hatching
    /// would fill the gaps of the first.
    fn fixed(&self, pivots: &[Vec2], drawn: &mut Vec<[Vec2; 2]>) -> Vec<Mark> {
        let u = self.unit;
        let (role, ends) =
            if self.is_cylinder { (MarkRole::Bore, self.barrel()) } else { (MarkRole::Rail, self.covered()) };
        let near = 0.0_f64.clamp(ends[0] - AXIS * u, ends[1] + AXIS * u);
        let centre = [ends[0].smaller(near) - 2.0 * u, ends[1].larger(near) + 2.0 * u];
        let mut marks = vec![Mark::line(MarkRole::Axis, centre.map(|way| self.guide.local + self.axes[0] * way))];
        let [a, b, c, d] = self.open(self.strip(ends, self.gap()));
        // The path along the walls runs from the open end over the head and back.
        // The hatching is on the outer side of a wall. This side may be to the left or to the right of the path.
        let walls = if self.is_cylinder { vec![[a, b], [b, c], [c, d]] } else { vec![[a, b], [c, d]] };
        let middle = (a + b + c + d) / 4.0;
        for wall in walls {
            let normal = turned((wall[1] - wall[0]).normalize());
            let out = if normal.dot(&(wall[0] - middle)) > 0.0 { normal } else { -normal };
            for piece in pieces(wall, pivots, u) {
                marks.push(Mark::line(role, piece));
                let along = (piece[1] - piece[0]).normalize();
                let free = feet(piece, u).filter(|foot| !drawn.iter().any(|other| lies_on(*foot, other, u)));
                marks.extend(free.map(|foot| Mark::line(MarkRole::Hatch, [foot, foot + (out - along) * (HATCH * u)])));
                drawn.push(piece);
            }
        }
        marks
    }
}

/// The parts of a rail outside the boxes of all pivots.
fn pieces(rail: [Vec2; 2], pivots: &[Vec2], unit: f64) -> Vec<[Vec2; 2]> {
    pivots.iter().fold(vec![rail], |pieces, pivot| {
        let centre = pivot - Vec2::new(0.0, BELOW * unit);
        let half = Vec2::from(BOX) * unit;
        let cut = |piece: [Vec2; 2]| match inside(&piece, centre, half) {
            None => vec![piece],
            Some(shares) => {
                let [from, to] = shares.map(|share| piece[0] + (piece[1] - piece[0]) * share);
                vec![[piece[0], from], [to, piece[1]]]
            }
        };
        pieces.into_iter().flat_map(cut).filter(|[a, b]| (b - a).norm() > PITCH * unit).collect()
    })
}

/// Fractions of a segment's length at which the segment enters and leaves the box around `centre` (Liang and Barsky
/// 1984).
pub fn inside(segment: &[Vec2; 2], centre: Vec2, half: Vec2) -> Option<[f64; 2]> {
    let (start, end) = (segment[0] - centre, segment[1] - centre);
    let along = end - start;
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        if along[axis] == 0.0 {
            if start[axis].abs() >= half[axis] {
                return None;
            }
            continue;
        }
        let (a, b) = ((-half[axis] - start[axis]) / along[axis], (half[axis] - start[axis]) / along[axis]);
        from = from.larger(a.smaller(b));
        to = to.smaller(a.larger(b));
    }
    (to > from).then_some([from, to])
}

/// Start points of the hatching lines of a rail.
fn feet([start, end]: [Vec2; 2], unit: f64) -> impl Iterator<Item = Vec2> {
    let (hatch, pitch) = (HATCH * unit, PITCH * unit);
    let (length, axis) = ((end - start).norm(), (end - start).normalize());
    let strokes = ((length - hatch) / pitch).floor().larger(0.0) + 1.0;
    let inset = (length - hatch - pitch * (strokes - 1.0)) / 2.0 + hatch;
    (0..strokes as usize).map(move |k| start + axis * (inset + pitch * k as f64))
}

/// Whether the start point of a hatching line lies on a rail from `a` to `b`.
fn lies_on(foot: Vec2, &[a, b]: &[Vec2; 2], unit: f64) -> bool {
    let axis = (b - a).normalize();
    let way = (foot - a).dot(&axis);
    turned(axis).dot(&(foot - a)).abs() < 0.1 * unit && way > 0.0 && way < (b - a).norm()
}
