//! Distances between outlines of links, with their derivatives.
//!
//! Let p1 and p2 be the nearest points of two convex parts, fixed in their links, and n the direction from p1 to p2.
//! The distance of the parts has the derivative n . (p2' - p1').
//! A shift of the nearest points along their sides has no first-order effect.
//! Parts that overlap have a negative distance: the depth of the overlap.

use linkage::case::Case;
use linkage::math::Vec2;
use linkage::mechanism::LinkId;
use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query::{self, Contact};
use parry2d_f64::shape::{Ball, ConvexPolygon, Segment, Shape};
use precise::{Dual, Readings, Scalar, Snapshot};
use scenario::clearance::{ClearanceQuestion, nearest};

use super::dimensions::Dimensions;

/// Largest distance at which nearest points are computed, divided by the mechanism's size.
const FAR: f64 = 1e3;
/// Radius of the disc that replaces a convex part with a single corner, divided by the mechanism's size.
const DOT: f64 = 1e-9;

/// A corner of an outline: a point of the link, whose position may vary, or a fixed position on the link (m).
#[derive(Clone, Copy)]
enum Corner {
    Point(usize),
    Fixed(Vec2),
}

/// A convex part of a body.
struct Part {
    link: LinkId,
    corners: Vec<Corner>,
    radius: f64,
}

/// The pairs of parts whose distances are limited.
pub(super) struct Gaps {
    /// For every pair of bodies, all pairs of a part of the first body and a part of the second body.
    pairs: Vec<Vec<[usize; 2]>>,
    parts: Vec<Part>,
    size: f64,
}

impl Gaps {
    /// The pairs of parts for a clearance question about the drawing.
    pub(super) fn of(question: &ClearanceQuestion, case: &Case) -> Self {
        let links = case.mechanism.links();
        let mut parts = Vec::new();
        let mut of_body = Vec::new();
        for body in &question.bodies {
            let corner = |corner: &Vec2| {
                let point = links[body.link].points.iter().position(|point| point.local == *corner);
                point.map_or(Corner::Fixed(*corner), Corner::Point)
            };
            let first = parts.len();
            parts.extend(body.outline.parts().iter().map(|corners| Part {
                link: body.link,
                corners: corners.iter().map(corner).collect(),
                radius: body.outline.radius(),
            }));
            of_body.push(first..parts.len());
        }
        let pair = |&[a, b]: &[usize; 2]| {
            of_body[a].clone().flat_map(|first| of_body[b].clone().map(move |second| [first, second])).collect()
        };
        Gaps { pairs: question.pairs.iter().map(pair).collect(), parts, size: case.mechanism.size() }
    }

    /// The distance of every pair (m) in a state.
    pub(super) fn at<const N: usize>(
        &self,
        dimensions: &Dimensions<N>,
        readings: &Readings<Dual<f64, N>>,
        state: &Snapshot<Dual<f64, N>>,
    ) -> Vec<Dual<f64, N>> {
        let place = |part: &Part| Placed::of(part, dimensions, readings, state, self.size);
        let placed: Vec<Placed<N>> = self.parts.iter().map(place).collect();
        let distance = |[a, b]: &[usize; 2]| {
            let (first, second) = (&placed[*a], &placed[*b]);
            let contact = first.contact(second, self.size);
            let radii = self.parts[*a].radius + self.parts[*b].radius;
            contact.map(|contact| first.distance(second, &contact, self.size) - Dual::of(radii))
        };
        let least = |pairs: &Vec<[usize; 2]>| {
            let all = pairs.iter().filter_map(distance);
            all.min_by(|a, b| a.value.total_cmp(&b.value)).unwrap_or(Dual::of(FAR * self.size))
        };
        self.pairs.iter().map(least).collect()
    }
}

/// A part at one state: its corners (m, world), and its shape with lengths divided by the mechanism's size.
struct Placed<const N: usize> {
    corners: Vec<[Dual<f64, N>; 2]>,
    shape: Box<dyn Shape>,
}

impl<const N: usize> Placed<N> {
    fn of(
        part: &Part,
        dimensions: &Dimensions<N>,
        readings: &Readings<Dual<f64, N>>,
        state: &Snapshot<Dual<f64, N>>,
        size: f64,
    ) -> Self {
        let local = |corner: &Corner| match corner {
            Corner::Point(point) => dimensions.local(part.link, *point),
            Corner::Fixed(place) => [Dual::of(place.x), Dual::of(place.y)],
        };
        let corners: Vec<_> = part.corners.iter().map(|own| readings.world(state, part.link, local(own))).collect();
        let scaled = |corner: &[Dual<f64, N>; 2]| Vector::new(corner[0].value / size, corner[1].value / size);
        let points: Vec<Vector> = corners.iter().map(scaled).collect();
        let segment = || Box::new(Segment::new(points[0], points[points.len() - 1]));
        let shape: Box<dyn Shape> = match points.len() {
            1 => Box::new(Ball::new(DOT)),
            2 => segment(),
            _ => ConvexPolygon::from_convex_hull(&points).map_or_else(|| segment() as _, |own| Box::new(own) as _),
        };
        Placed { corners, shape }
    }

    /// Pose of the shape. A disc for a single corner is defined about its centre; all other shapes have world
    /// coordinates.
    fn pose(&self, size: f64) -> Pose {
        match &self.corners[..] {
            [[x, y]] => Pose::translation(x.value / size, y.value / size),
            _ => Pose::identity(),
        }
    }

    /// Nearest points of two parts, or deepest points if the parts overlap, with lengths divided by the mechanism's
    /// size.
    fn contact(&self, other: &Self, size: f64) -> Option<Contact> {
        query::contact(&self.pose(size), &*self.shape, &other.pose(size), &*other.shape, FAR).ok().flatten()
    }

    /// Distance between the two points of a contact, along the contact's normal (m).
    fn distance(&self, other: &Self, contact: &Contact, size: f64) -> Dual<f64, N> {
        let normal = Vec2::new(contact.normal1.x, contact.normal1.y);
        let at = |own: &Self, point: Vector| own.material(Vec2::new(point.x, point.y) * size);
        let (first, second) = (at(self, contact.point1), at(other, contact.point2));
        (second[0] - first[0]) * Dual::of(normal.x) + (second[1] - first[1]) * Dual::of(normal.y)
    }

    /// The point on the part's sides that is nearest to a world position (m). The point keeps its fraction of the side
    /// if the corners move.
    fn material(&self, place: Vec2) -> [Dual<f64, N>; 2] {
        let at = |corner: &[Dual<f64, N>; 2]| Vec2::new(corner[0].value, corner[1].value);
        let count = self.corners.len();
        let side = |index: usize| [&self.corners[index], &self.corners[(index + 1) % count]];
        let apart = |index: &usize| (nearest(place, side(*index).map(at)) - place).norm();
        let best = (0..count).min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(0);
        let [a, b] = side(best);
        let (start, long) = (at(a), (at(b) - at(a)).norm());
        let share = if long > 0.0 { (nearest(place, [start, at(b)]) - start).norm() / long } else { 0.0 };
        [0, 1].map(|axis| a[axis] * Dual::of(1.0 - share) + b[axis] * Dual::of(share))
    }
}
