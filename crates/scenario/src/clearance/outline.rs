//! Outlines of links and of the housing: lines and polygons, rounded by a radius.

use linkage::math::{KeepNan, Vec2, cross, turned};
use linkage::mechanism::ring;
use parry2d_f64::transformation::{convex_hull, hertel_mehlhorn_idx};

/// Upper limit of the number of corners of an outline. The work grows with the square of this number: one distance for
/// every pair of parts, and one crossing test for every pair of sides.
pub const MOST_CORNERS: usize = 500;
/// If the distance of two corners, divided by the outline's extent, is below this limit, the corners coincide.
/// If the distance of a corner from a side, divided by the outline's extent, is below this limit, the corner lies on
/// the side.
const TOUCHING: f64 = 1e-9;

/// Reason why corners do not form a polygon. Corners are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flaw {
    /// Fewer corners than three.
    Few(usize),
    /// More corners than [`MOST_CORNERS`].
    Many(usize),
    /// Two corners at the same position.
    Repeated([usize; 2]),
    /// Two sides that touch or cross. Each side is given by the corner at which it begins.
    Crossing([usize; 2]),
    /// A polygon without area: all corners are on one line.
    Flat,
    /// A coordinate that is NaN or infinite, or a radius that is negative.
    NoNumber,
}

/// An outline in the frame of its link: all points within a radius of a line, or of a polygon with its interior.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    corners: Vec<Vec2>,
    solid: bool,
    radius: f64,
    parts: Vec<Vec<Vec2>>,
}

impl Outline {
    /// A line through the given points (m), rounded by `radius` (m).
    /// The outline is a chain of capsules, or a disc around a single point.
    ///
    /// # Errors
    /// [`Flaw::Few`] without a point, [`Flaw::Many`], [`Flaw::NoNumber`].
    pub fn line(places: &[Vec2], radius: f64) -> Result<Outline, Flaw> {
        check(places, radius, 1)?;
        let parts = match places {
            [one] => vec![vec![*one]],
            _ => places.windows(2).map(<[Vec2]>::to_vec).collect(),
        };
        Ok(Outline { corners: places.to_vec(), solid: false, radius, parts })
    }

    /// A polygon with the given corners (m) and its interior, rounded by `radius` (m, may be 0).
    /// The polygon need not be convex, and its corners may be in either sense of rotation.
    ///
    /// # Errors
    /// A [`Flaw`] of the corners or the radius.
    pub fn polygon(corners: &[Vec2], radius: f64) -> Result<Outline, Flaw> {
        check(corners, radius, 3)?;
        check_simple(corners)?;
        let mut corners = corners.to_vec();
        if area(&corners) < 0.0 {
            corners.reverse();
        }
        let parts = convex_parts(&corners).ok_or(Flaw::Flat)?;
        Ok(Outline { corners, solid: true, radius, parts })
    }

    /// The default outline of a link: capsules of `radius` (m) along the [`ring`] of its points, and the area between
    /// the capsules.
    /// The outline of a bar is one capsule. The outline of a single point is a disc.
    ///
    /// # Errors
    /// [`Flaw::Few`] without a point, [`Flaw::Many`], [`Flaw::NoNumber`].
    pub fn of_points(places: &[Vec2], radius: f64) -> Result<Outline, Flaw> {
        check(places, radius, 1)?;
        let extent = extent(places);
        let mut apart: Vec<Vec2> = Vec::new();
        for &place in places {
            if apart.iter().all(|known| (known - place).norm() > TOUCHING * extent) {
                apart.push(place);
            }
        }
        let (line, closed) = ring(&apart);
        if !closed {
            // All points lie on one line, so the two ends of the line suffice.
            let ends = if line.len() > 1 { vec![line[0], line[line.len() - 1]] } else { line };
            return Outline::line(&ends, radius);
        }
        Outline::polygon(&line, radius).or_else(|_| Outline::polygon(&hull(&apart), radius))
    }

    /// Corners of the line or polygon (m). The corners of a polygon are in counter-clockwise order.
    #[must_use]
    pub fn corners(&self) -> &[Vec2] {
        &self.corners
    }

    /// Whether the interior belongs to the outline: true for a polygon, false for a line.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        self.solid
    }

    /// Radius of the rounding (m).
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Convex parts whose union is the outline without the rounding (m).
    /// The parts are points, segments, and counter-clockwise polygons.
    #[must_use]
    pub fn parts(&self) -> &[Vec<Vec2>] {
        &self.parts
    }

    /// Sides of the outline (m), each as a pair of ends. A single point is a side without length.
    pub fn sides(&self) -> impl Iterator<Item = [Vec2; 2]> + '_ {
        let count = self.corners.len();
        let sides = if self.solid { count } else { (count - 1).max(1) };
        (0..sides).map(move |k| [self.corners[k], self.corners[(k + 1) % count]])
    }

    /// Signed distance of a point from the outline (m), negative inside, and the direction in which the distance grows.
    /// If the point moves, the distance changes by at most the displacement of the point.
    #[must_use]
    pub fn distance(&self, place: Vec2) -> (f64, Vec2) {
        let (mut least, mut away, mut inside) = (f64::INFINITY, Vec2::new(1.0, 0.0), false);
        for [a, b] in self.sides() {
            let off = place - nearest(place, [a, b]);
            let distance = off.norm();
            if distance < least {
                let outward = || (-turned(b - a)).try_normalize(0.0).unwrap_or(away);
                (least, away) = (distance, if distance > 0.0 { off / distance } else { outward() });
            }
            if self.solid && (a.y > place.y) != (b.y > place.y) {
                inside ^= (cross(b - a, place - a) > 0.0) == (b.y > a.y);
            }
        }
        if inside { (-least - self.radius, -away) } else { (least - self.radius, away) }
    }

    /// Largest distance of a corner from the origin, plus the radius of the rounding (m).
    #[must_use]
    pub fn extent(&self) -> f64 {
        self.corners.iter().map(|corner| corner.norm()).fold(0.0, f64::larger) + self.radius
    }
}

/// The nearest point of a segment to a given point.
#[must_use]
pub fn nearest(place: Vec2, [a, b]: [Vec2; 2]) -> Vec2 {
    let along = b - a;
    let length = along.norm_squared();
    if length > 0.0 { a + along * ((place - a).dot(&along) / length).clamp(0.0, 1.0) } else { a }
}

fn extent(places: &[Vec2]) -> f64 {
    places.iter().map(|place| (place - places[0]).norm()).fold(0.0, f64::larger)
}

fn check(places: &[Vec2], radius: f64, least: usize) -> Result<(), Flaw> {
    match places.len() {
        few if few < least => Err(Flaw::Few(few)),
        many if many > MOST_CORNERS => Err(Flaw::Many(many)),
        _ if !(radius >= 0.0 && radius.is_finite()) => Err(Flaw::NoNumber),
        _ if places.iter().any(|place| !(place.x.is_finite() && place.y.is_finite())) => Err(Flaw::NoNumber),
        _ => Ok(()),
    }
}

/// Checks that the sides of a polygon meet only at their common corners.
fn check_simple(corners: &[Vec2]) -> Result<(), Flaw> {
    let (count, near) = (corners.len(), TOUCHING * extent(corners));
    let side = |k: usize| [corners[k], corners[(k + 1) % count]];
    for i in 0..count {
        if let Some(j) = (i + 1..count).find(|&j| (corners[i] - corners[j]).norm() <= near) {
            return Err(Flaw::Repeated([i, j]));
        }
    }
    if !(0..count).any(|k| {
        let ([a, b], c) = (side(k), corners[(k + 2) % count]);
        cross(b - a, c - a).abs() > near * (b - a).norm()
    }) {
        return Err(Flaw::Flat);
    }
    for i in 0..count {
        for j in i + 1..count {
            let is_next = j == i + 1 || (i == 0 && j == count - 1);
            let touch = if is_next {
                // Neighbouring sides share a corner. Such sides touch at further points only if one side folds back
                // onto the other.
                // The free end of one side then lies on the other side, so only the free ends are tested.
                let (one, two) = if j == i + 1 { (side(i), side(j)) } else { (side(j), side(i)) };
                [(one, two[1]), (two, one[0])].iter().any(|&(own, end)| (end - nearest(end, own)).norm() <= near)
            } else {
                meet(side(i), side(j), near)
            };
            if touch {
                return Err(Flaw::Crossing([i, j]));
            }
        }
    }
    Ok(())
}

/// Whether two segments cross, or come nearer to each other than `near` (m).
fn meet([a, b]: [Vec2; 2], [c, d]: [Vec2; 2], near: f64) -> bool {
    let apart = |p: Vec2, q: Vec2, r: Vec2, s: Vec2| (cross(q - p, r - p) > 0.0) == (cross(q - p, s - p) > 0.0);
    let crossing = !apart(a, b, c, d) && !apart(c, d, a, b);
    let ends = [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])];
    crossing || ends.iter().any(|&(end, other)| (end - nearest(end, other)).norm() <= near)
}

/// Vectors of the geometry library.
type Foreign = parry2d_f64::math::Vector;

/// Corners of the convex hull, counter-clockwise.
fn hull(places: &[Vec2]) -> Vec<Vec2> {
    convex_hull(&foreign(places)).into_iter().map(|place| Vec2::new(place.x, place.y)).collect()
}

fn foreign(places: &[Vec2]) -> Vec<Foreign> {
    places.iter().map(|place| Foreign::new(place.x, place.y)).collect()
}

/// Convex parts of a simple counter-clockwise polygon. `None` if the polygon has too little area to be divided.
///
/// Ear clipping gives triangles (Meisters 1975). The triangles are merged as long as the parts stay convex (Hertel and
/// Mehlhorn 1983).
fn convex_parts(corners: &[Vec2]) -> Option<Vec<Vec<Vec2>>> {
    let triangles = triangles(corners)?;
    let of = |part: &Vec<u32>| part.iter().map(|&k| corners[k as usize]).collect::<Vec<Vec2>>();
    let parts: Vec<Vec<Vec2>> = hertel_mehlhorn_idx(&foreign(corners), &triangles).iter().map(of).collect();
    // The result of the library is checked, because distances are computed from these parts.
    if parts.iter().all(|part| is_convex(part)) && agree(corners, &parts) {
        return Some(parts);
    }
    let parts: Vec<Vec<Vec2>> = triangles.iter().map(|triangle| of(&triangle.to_vec())).collect();
    agree(corners, &parts).then_some(parts)
}

/// Area of a polygon, positive counter-clockwise.
fn area(corners: &[Vec2]) -> f64 {
    let around = |k: usize| cross(corners[k] - corners[0], corners[(k + 1) % corners.len()] - corners[0]);
    (0..corners.len()).map(around).sum::<f64>() / 2.0
}

/// Whether the areas of the parts add up to the area of the whole.
fn agree(corners: &[Vec2], parts: &[Vec<Vec2>]) -> bool {
    let (whole, sum) = (area(corners), parts.iter().map(|part| area(part)).sum::<f64>());
    (whole - sum).abs() <= 1e-9 * whole && whole > 0.0
}

fn is_convex(part: &[Vec2]) -> bool {
    let count = part.len();
    (0..count).all(|k| {
        let [a, b, c] = [part[k], part[(k + 1) % count], part[(k + 2) % count]];
        cross(b - a, c - b) >= -1e-12 * (b - a).norm() * (c - b).norm()
    })
}

fn triangles(corners: &[Vec2]) -> Option<Vec<[u32; 3]>> {
    let mut left: Vec<usize> = (0..corners.len()).collect();
    let mut found = Vec::with_capacity(corners.len());
    while left.len() > 3 {
        let count = left.len();
        let around = |k: usize| [left[(k + count - 1) % count], left[k], left[(k + 1) % count]];
        // The widest ear is cut first, because slivers would make the parts thin.
        let ear = (0..count).filter(|&k| is_ear(corners, &left, around(k))).max_by(|&i, &j| {
            let width = |k: usize| sine(around(k).map(|corner| corners[corner]));
            width(i).total_cmp(&width(j)).then(j.cmp(&i))
        });
        let flat = || (0..count).find(|&k| sine(around(k).map(|corner| corners[corner])).abs() < 1e-12);
        match ear {
            Some(ear) => {
                found.push(around(ear).map(|corner| corner as u32));
                left.remove(ear);
            }
            // A corner on the line between its neighbours is removed, because it does not change the outline.
            None => {
                left.remove(flat()?);
            }
        }
    }
    found.push([left[0], left[1], left[2]].map(|corner| corner as u32));
    Some(found)
}

/// Sine of the angle at the middle corner. The sine is positive where the polygon is convex.
fn sine([a, b, c]: [Vec2; 3]) -> f64 {
    cross(b - a, c - b) / ((b - a).norm() * (c - b).norm())
}

fn is_ear(corners: &[Vec2], left: &[usize], own: [usize; 3]) -> bool {
    let [a, b, c] = own.map(|corner| corners[corner]);
    let inside = |p: Vec2| cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
    sine([a, b, c]) > 1e-12 && !left.iter().any(|other| !own.contains(other) && inside(corners[*other]))
}
