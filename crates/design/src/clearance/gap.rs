//! Distance of two bodies at the middle of a part of the range, with a lower bound over the whole part.
//!
//! The library parry2d computes the nearest points.
//! The bound depends only on the direction between the nearest points.
//! The distance of two convex parts along a fixed direction is the distance of their extreme corners along this
//! direction.
//! Along any direction, this distance is a valid bound. The bound holds over the whole part of the range, because every
//! corner moves uniformly, up to a proven error.
//! A wrong pair of nearest points therefore makes the bound weaker, but never wrong.

use linkage::math::{KeepNan, Vec2, turned};
use linkage::mechanism::LinkId;
use parry2d_f64::math::{Pose, Rot2, Vector};
use parry2d_f64::query::{self, ClosestPoints};
use parry2d_f64::shape::{ConvexPolygon, Segment, Shape};

use super::tube::{Slice, Track};
use scenario::clearance::Outline;

/// If the distance of two convex parts exceeds this multiple of the mechanism's size, their nearest points are not
/// computed.
const FAR: f64 = 1e9;

/// If two convex parts are nearer than this multiple of the mechanism's size, the normals of their sides are also tried
/// as directions of the bound.
/// The direction between the nearest points of such close parts is too inaccurate.
const CLOSE: f64 = 1e-5;

/// Outline of a body, prepared for distance queries.
pub struct Solid {
    /// Link of the body. A body of the housing has the ground as its link.
    pub link: LinkId,
    /// Rounding radius (m).
    pub radius: f64,
    pub(super) pieces: Vec<Piece>,
    scale: f64,
}

pub(super) struct Piece {
    corners: Vec<Vec2>,
    centre: Vec2,
    reach: f64,
    shape: Box<dyn Shape>,
}

/// Solid with its motion over a part of the range.
pub struct PlacedSolid {
    pose: Pose,
    pieces: Vec<PlacedPiece>,
}

struct PlacedPiece {
    corners: Vec<Track>,
    centre: Vec2,
    /// Largest displacement of a corner from its position at the middle of the part (m).
    moves: f64,
}

/// Distance of two bodies over a part of the range.
#[derive(Clone, Copy, Debug)]
pub struct Gap {
    /// Upper bound of the distance at the middle (m). The bound is 0 if the bodies meet.
    /// The bound is infinite if all convex parts are farther apart than the argument `enough` of the function `gap`.
    pub now: f64,
    /// Nearest points at the middle, on the first and the second body (m).
    pub points: [Vec2; 2],
    /// Lower bound of the distance over the part of the range (m). The bound may be negative.
    /// The bound is proven only if the field `sound` of the slice is true.
    pub least: f64,
}

impl Solid {
    /// Prepares an outline of a link for distance queries.
    /// The library parry2d receives lengths in units of `scale` (m), because its tolerances are absolute.
    pub fn new(link: LinkId, outline: &Outline, scale: f64) -> Self {
        let pieces = outline.parts().iter().map(|part| Piece::new(part, scale)).collect();
        Solid { link, radius: outline.radius(), pieces, scale }
    }

    /// Computes the solid's pose at the middle of a part of the range, and the motion of its corners over the part.
    pub fn placed(&self, slice: &Slice) -> PlacedSolid {
        let tube = &slice.tubes[self.link];
        let (origin, direction) = tube.frame();
        let origin = origin / self.scale;
        let rotation = Rot2::from_cos_sin_unchecked(direction.x, direction.y);
        let piece = |piece: &Piece| {
            let corners: Vec<Track> = piece.corners.iter().map(|&corner| tube.point(corner)).collect();
            let moves = corners.iter().map(|corner| corner.reach(slice.half)).fold(0.0, f64::larger);
            PlacedPiece { corners, centre: tube.point(piece.centre).at, moves }
        };
        PlacedSolid {
            pose: Pose::from_parts(Vector::new(origin.x, origin.y), rotation),
            pieces: self.pieces.iter().map(piece).collect(),
        }
    }
}

impl Piece {
    fn new(corners: &[Vec2], scale: f64) -> Self {
        let centre = corners.iter().sum::<Vec2>() / corners.len() as f64;
        let reach = corners.iter().map(|corner| (corner - centre).norm()).fold(0.0, f64::larger);
        let foreign = |corner: &Vec2| Vector::new(corner.x / scale, corner.y / scale);
        let segment = || Box::new(Segment::new(foreign(&corners[0]), foreign(&corners[corners.len() - 1])));
        let shape: Box<dyn Shape> = if corners.len() < 3 {
            segment()
        } else {
            match ConvexPolygon::from_convex_polyline_unmodified(corners.iter().map(foreign).collect()) {
                Some(polygon) => Box::new(polygon),
                None => segment(),
            }
        };
        Piece { corners: corners.to_vec(), centre, reach, shape }
    }
}

/// Computes the distance of two solids over a part of the range.
/// Nearest points are computed only for pairs of pieces that can come nearer than `enough` (m).
/// `asked` counts these pairs.
pub fn gap(
    [a, b]: [&Solid; 2],
    places: [&PlacedSolid; 2],
    slice: &Slice,
    rounding: f64,
    enough: f64,
    asked: &mut usize,
) -> Gap {
    let radii = a.radius + b.radius;
    let mut found = Gap { now: f64::INFINITY, points: [Vec2::zeros(); 2], least: f64::INFINITY };
    for (one, own) in a.pieces.iter().zip(&places[0].pieces) {
        for (two, other) in b.pieces.iter().zip(&places[1].pieces) {
            let between = (own.centre - other.centre).norm() - one.reach - two.reach - radii;
            let sure = between - own.moves - other.moves - rounding;
            if sure > enough.smaller(found.now) {
                found.least = found.least.smaller(sure);
                continue;
            }
            *asked += 1;
            let [p, q] = closest([one, two], [own, other], places, a.scale);
            let core = (p - q).norm();
            let now = (core - radii).larger(0.0);
            if now < found.now || !found.now.is_finite() {
                let normal = if core > 0.0 { (p - q) / core } else { Vec2::zeros() };
                (found.now, found.points) = (now, [p - normal * a.radius, q + normal * b.radius]);
                if now == 0.0 {
                    let middle = (found.points[0] + found.points[1]) / 2.0;
                    found.points = [middle; 2];
                }
            }
            let mut least = f64::NEG_INFINITY;
            let mut ask = |normal: Vec2| {
                let apart = apart(&own.corners, &other.corners, normal, slice.half);
                least = least.larger(apart);
            };
            if core > 0.0 {
                ask((p - q) / core);
            }
            if core < CLOSE * a.scale {
                // The nearest points are so close that the direction between them is only rounding error.
                // The normals of the sides are therefore tried too.
                // If two convex parts can be separated, the normal of one of their sides separates them.
                normals(&own.corners, -1.0, &mut ask);
                normals(&other.corners, 1.0, &mut ask);
            }
            found.least = found.least.smaller(least - radii - rounding);
        }
    }
    found
}

/// Returns the nearest points of two pieces at the middle (m). If the pieces meet, both points are the same.
fn closest(pieces: [&Piece; 2], placed: [&PlacedPiece; 2], places: [&PlacedSolid; 2], scale: f64) -> [Vec2; 2] {
    let shapes = pieces.map(|piece| &*piece.shape);
    match query::closest_points(&places[0].pose, shapes[0], &places[1].pose, shapes[1], FAR) {
        Ok(ClosestPoints::WithinMargin(p, q)) => [p, q].map(|point| Vec2::new(point.x, point.y) * scale),
        Ok(ClosestPoints::Intersecting) => {
            let middle = (placed[0].centre + placed[1].centre) / 2.0;
            [middle; 2]
        }
        // The centres of the pieces replace the nearest points.
        // The replacement is valid because any two points of the pieces give an upper bound of the distance.
        Ok(ClosestPoints::Disjoint) | Err(_) => placed.map(|piece| piece.centre),
    }
}

/// Calls `ask` with the normals of a convex part's sides: outward for `sign` 1, inward for -1.
/// For a segment, both normals are passed.
fn normals(corners: &[Track], sign: f64, ask: &mut impl FnMut(Vec2)) {
    let count = corners.len();
    for k in 0..count {
        let along = corners[(k + 1) % count].at - corners[k].at;
        if along.norm() > 0.0 {
            ask(turned(along).normalize() * -sign);
        }
    }
}

/// Lower bound of the distance of two convex parts along `normal` (m), for crank angles within `half` of the middle.
/// The bound is the smallest projection of the first part's corners minus the largest projection of the second part's
/// corners.
/// This difference is a concave function of the crank angle, so its smallest value lies at the first or last crank
/// angle.
fn apart(first: &[Track], second: &[Track], normal: Vec2, half: f64) -> f64 {
    let at = |by: f64| {
        let low = first.iter().map(|corner| normal.dot(&corner.at) + normal.dot(&corner.rate) * by - corner.error);
        let high = second.iter().map(|corner| normal.dot(&corner.at) + normal.dot(&corner.rate) * by + corner.error);
        low.fold(f64::INFINITY, f64::smaller) - high.fold(f64::NEG_INFINITY, f64::larger)
    };
    at(-half).smaller(at(half))
}
