//! Dimensions: the lengths and angles that define the links of a mechanism and its ground.
//!
//! A link with n points has 2 n - 3 lengths. If all points are on one line, the link has n - 1 lengths.
//! On the ground, the dimensions are the horizontal and vertical distances of the other points from the first pivot.
//! Guide angles that are multiples of 90 degrees, and distances of zero, get no number: the drawing itself shows them.

use std::f64::consts::{FRAC_PI_2, PI};

use super::body::{corners, places};
use super::picture::{millimetres, short};
use super::pins::pivots;
use linkage::math::{KeepNan, Vec2, cross};
use linkage::mechanism::{CamContact, GROUND, JointId, LinkId, Mechanism, TransmissionKind};

/// Two points count as one if their distance is below this fraction of the link's size. Distances below this limit are
/// zero.
const SAME: f64 = 1e-9;
/// Angles below this (rad) are zero.
const ALIGNED: f64 = 1e-7;

/// A number in a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Dimension {
    /// The link that has this dimension. Positions of pivots and fixed guides are dimensions of the ground.
    pub link: LinkId,
    /// What the number measures.
    pub measure: Measure,
    /// The number as written: a length in mm or an angle in degrees, with four digits.
    pub text: String,
}

/// What a dimension measures. Points are given by their indices in the result of [`places`](crate::places).
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// Distance between two points of a link. The list of lengths determines one point after another.
    Length {
        /// The point from which the length is measured. Earlier lengths determine this point.
        from: usize,
        /// The point that the length determines. On a line, the length suffices; otherwise the neighbouring length in
        /// the list is needed too.
        to: usize,
        /// Where the length is drawn.
        line: DimensionLine,
    },
    /// Horizontal or vertical distance of points of the ground from the first pivot.
    Offset {
        /// 0 for horizontal, 1 for vertical.
        axis: usize,
        /// The first pivot.
        from: usize,
        /// All points that have this distance from the first pivot.
        to: Vec<usize>,
        /// Row of the dimension line: the number of shorter distances on the same side.
        row: usize,
    },
    /// Angle between a guide and a line of its link, at most 90 degrees.
    Angle {
        /// The prismatic joint.
        joint: JointId,
        /// Vertex of the angle in the frame of the link (m).
        at: Vec2,
        /// Directions of the line and of the guide (rad) in the frame of the link.
        sides: [f64; 2],
    },
    /// Radius of a wheel.
    Radius {
        /// Axle of the wheel in the frame of the link (m).
        at: Vec2,
        /// The radius (m).
        radius: f64,
    },
}

/// Where a length is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DimensionLine {
    /// Beside an edge of the link.
    Edge,
    /// Along a thin line between the two points.
    Across,
    /// Along a dimension line outside the link. The number is the row of the line; row 0 is nearest to the link.
    Outside(usize),
}

/// All dimensions of a mechanism.
#[must_use]
pub fn dimensions(mechanism: &Mechanism) -> Vec<Dimension> {
    let mut all = offsets(mechanism);
    for link in mechanism.links().ids() {
        if link != GROUND {
            all.extend(lengths(mechanism, link));
        }
        all.extend(angles(mechanism, link));
    }
    all.extend(radii(mechanism));
    all
}

/// Largest distance of a point from the first point (m).
fn extent(all: &[Vec2]) -> f64 {
    all.iter().map(|at| (at - all[0]).norm()).fold(0.0, f64::larger)
}

/// Indices of the points of a link, without the points that coincide with an earlier point.
fn distinct(all: &[Vec2]) -> Vec<usize> {
    let size = extent(all);
    let is_new = |k: usize| all[..k].iter().all(|other| (other - all[k]).norm() > SAME * size);
    (0..all.len()).filter(|&k| is_new(k)).collect()
}

fn lengths(mechanism: &Mechanism, link: LinkId) -> Vec<Dimension> {
    let (all, hull) = (places(mechanism, link), corners(mechanism, link));
    let own = distinct(&all);
    let pairs = match hull.len() {
        0 | 1 => Vec::new(),
        2 => on_a_line(&all, &own),
        _ => {
            // A corner may coincide with an earlier point.
            let near = SAME * extent(&all);
            let index = |corner: &Vec2| own.iter().copied().find(|&k| (all[k] - corner).norm() <= near);
            let mut hull: Vec<usize> = hull.iter().filter_map(index).collect();
            hull.dedup();
            if hull.len() > 1 && hull.first() == hull.last() {
                hull.pop();
            }
            in_a_plane(&all, &own, &hull)
        }
    };
    let of = |(from, to, line): (usize, usize, DimensionLine)| {
        let text = millimetres((all[to] - all[from]).norm());
        Dimension { link, measure: Measure::Length { from, to, line }, text }
    };
    pairs.into_iter().map(of).collect()
}

/// Lengths from the first point of a bar to all other points.
/// Lengths on the same side of the first point are drawn in separate rows.
fn on_a_line(all: &[Vec2], own: &[usize]) -> Vec<(usize, usize, DimensionLine)> {
    let (Some(&first), true) = (own.first(), own.len() > 1) else { return Vec::new() };
    let mut others: Vec<usize> = own[1..].to_vec();
    let way = |k: usize| all[k] - all[first];
    others.sort_by(|a, b| way(*a).norm().total_cmp(&way(*b).norm()));
    let row = |index: usize| (0..index).filter(|&k| way(others[k]).dot(&way(others[index])) > 0.0).count();
    let line = |index: usize| if others.len() == 1 { DimensionLine::Edge } else { DimensionLine::Outside(row(index)) };
    (0..others.len()).map(|index| (first, others[index], line(index))).collect()
}

/// Lengths that divide the hull of a plate into triangles, followed by two lengths for every other point.
fn in_a_plane(all: &[Vec2], own: &[usize], hull: &[usize]) -> Vec<(usize, usize, DimensionLine)> {
    let count = hull.len();
    // All triangles have one corner in common. The thinnest triangle decides how exactly the lengths define the plate.
    let corner = |apex: usize, k: usize| hull[(apex + k) % count];
    let worst = |apex: usize| {
        (2..count).map(|k| sine(all, corner(apex, k), corner(apex, 0), corner(apex, k - 1))).fold(1.0, f64::smaller)
    };
    let apex = (0..count).max_by(|a, b| worst(*a).total_cmp(&worst(*b)).then(b.cmp(a))).unwrap_or(0);
    let mut found = vec![(corner(apex, 0), corner(apex, 1), DimensionLine::Edge)];
    for k in 2..count {
        let last = if k + 1 == count { DimensionLine::Edge } else { DimensionLine::Across };
        found.push((corner(apex, k - 1), corner(apex, k), DimensionLine::Edge));
        found.push((corner(apex, 0), corner(apex, k), last));
    }
    let mut known = hull.to_vec();
    for &place in own.iter().filter(|place| !hull.contains(place)) {
        let pairs = known.iter().flat_map(|&a| known.iter().map(move |&b| [a, b])).filter(|[a, b]| a < b);
        let best = pairs.max_by(|[a, b], [c, d]| {
            sine(all, place, *a, *b).total_cmp(&sine(all, place, *c, *d)).then([c, d].cmp(&[a, b]))
        });
        found.extend(best.into_iter().flatten().map(|from| (from, place, DimensionLine::Across)));
        known.push(place);
    }
    found
}

/// Sine of the angle at the point `at` between the directions to two other points.
/// The errors of the two distances to `at` are magnified by 1 / sine.
fn sine(all: &[Vec2], at: usize, a: usize, b: usize) -> f64 {
    let (a, b) = (all[a] - all[at], all[b] - all[at]);
    cross(a, b).abs() / (a.norm() * b.norm())
}

fn offsets(mechanism: &Mechanism) -> Vec<Dimension> {
    let all = places(mechanism, GROUND);
    let first = pivots(mechanism).first().and_then(|pivot| all.iter().position(|at| at == pivot)).unwrap_or(0);
    let size = all.iter().map(|at| (at - all[first]).norm()).fold(0.0, f64::larger);
    let along = |axis: usize| {
        let way = |k: usize| all[k][axis] - all[first][axis];
        let mut ways: Vec<(f64, Vec<usize>)> = Vec::new();
        for k in (0..all.len()).filter(|&k| way(k).abs() > SAME * size) {
            match ways.iter_mut().find(|(own, _)| (own - way(k)).abs() <= SAME * size) {
                Some((_, to)) => to.push(k),
                None => ways.push((way(k), vec![k])),
            }
        }
        ways.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        let row = |index: usize| ways[..index].iter().filter(|own| own.0 * ways[index].0 > 0.0).count();
        let of = |(index, (way, to)): (usize, &(f64, Vec<usize>))| {
            let measure = Measure::Offset { axis, from: first, to: to.clone(), row: row(index) };
            Dimension { link: GROUND, measure, text: millimetres(way.abs()) }
        };
        ways.iter().enumerate().map(of).collect::<Vec<_>>()
    };
    [0, 1].into_iter().flat_map(along).collect()
}

/// Angles of a link's guides, except multiples of 90 degrees.
/// On the ground, an angle is measured from the horizontal.
/// On another link, an angle is measured from the line between the guide's point and the point farthest from it.
/// On a link with a single point, an angle is measured from the link's first guide.
fn angles(mechanism: &Mechanism, link: LinkId) -> Vec<Dimension> {
    let all = places(mechanism, link);
    let size = extent(&all);
    let mut first: Option<Vec2> = (link == GROUND).then(Vec2::x);
    let mut found: Vec<Dimension> = Vec::new();
    for (joint, own) in mechanism.joints().entries() {
        let (Some(at), Some(axis)) = (own.on(link), own.axis_on(link)) else { continue };
        let arm = all.iter().map(|place| place - at).max_by(|a, b| a.norm().total_cmp(&b.norm()));
        let arm = arm.filter(|arm| link != GROUND && arm.norm() > SAME * size);
        let base = arm.or(first);
        first = first.or(Some(axis));
        let Some(base) = base else { continue };
        let from = base.y.atan2(base.x);
        let turn = acute(axis.y.atan2(axis.x) - from);
        let is_plain = turn.abs() < ALIGNED || FRAC_PI_2 - turn.abs() < ALIGNED;
        let sides = [from, from + turn];
        let is_known = |other: &Dimension| match other.measure {
            Measure::Angle { at: place, sides: known, .. } => place == at && known == sides,
            Measure::Length { .. } | Measure::Offset { .. } | Measure::Radius { .. } => false,
        };
        if !is_plain && !found.iter().any(is_known) {
            let text = format!("{}°", short(turn.abs().to_degrees()));
            found.push(Dimension { link, measure: Measure::Angle { joint, at, sides }, text });
        }
    }
    found
}

/// Converts the angle between two directions to the angle between two lines: above -90 degrees and at most 90 degrees.
fn acute(angle: f64) -> f64 {
    let turn = angle.rem_euclid(PI);
    if turn > FRAC_PI_2 { turn - PI } else { turn }
}

/// Radii of wheels, and of the rollers of cam followers.
fn radii(mechanism: &Mechanism) -> Vec<Dimension> {
    let mut found: Vec<Dimension> = Vec::new();
    for own in mechanism.transmissions().iter() {
        let roller = match own.design.kind {
            TransmissionKind::Cam { contact: CamContact::Roller { centre, radius }, .. } => {
                Some((own.members[1].link, centre, radius))
            }
            TransmissionKind::Cam { contact: CamContact::Flat(_), .. }
            | TransmissionKind::Gears { .. }
            | TransmissionKind::Rack { .. }
            | TransmissionKind::Screw { .. }
            | TransmissionKind::Belt { .. } => None,
        };
        let wheels = own.members.iter().filter(|wheel| wheel.radius > 0.0);
        for (link, at, radius) in wheels.map(|wheel| (wheel.link, wheel.local, wheel.radius)).chain(roller) {
            let text = format!("r {}", millimetres(radius));
            let own = Dimension { link, measure: Measure::Radius { at, radius }, text };
            if !found.contains(&own) {
                found.push(own);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counted(points: &[(f64, f64)]) -> usize {
        let all: Vec<Vec2> = points.iter().map(|&(x, y)| Vec2::new(x, y)).collect();
        in_a_plane(&all, &distinct(&all), &[0, 1, 2]).len()
    }

    #[test]
    fn a_plate_has_two_lengths_for_each_place_after_the_first_two() {
        assert_eq!(counted(&[(0.0, 0.0), (2.0, 0.0), (0.0, 1.0)]), 3);
        assert_eq!(counted(&[(0.0, 0.0), (2.0, 0.0), (0.0, 1.0), (0.4, 0.2), (1.0, 0.0)]), 7);
        // A point that coincides with an earlier point needs no length.
        assert_eq!(counted(&[(0.0, 0.0), (2.0, 0.0), (0.0, 1.0), (2.0, 1e-12)]), 3);
    }

    #[test]
    fn lengths_on_both_sides_of_the_first_place_share_rows() {
        let all: Vec<Vec2> = [0.0, 1.0, 3.0, -2.0].map(|x| Vec2::new(x, 0.0)).to_vec();
        let rows: Vec<DimensionLine> = on_a_line(&all, &[0, 1, 2, 3]).into_iter().map(|own| own.2).collect();
        assert_eq!(rows, [DimensionLine::Outside(0), DimensionLine::Outside(0), DimensionLine::Outside(1)]);
    }

    #[test]
    fn angles_between_lines_are_at_most_a_right_angle() {
        for (angle, turn) in [(0.3, 0.3), (PI - 0.3, -0.3), (-PI - 0.2, -0.2), (FRAC_PI_2, FRAC_PI_2)] {
            assert!((acute(angle) - turn).abs() < 1e-12, "{angle}");
        }
    }
}
