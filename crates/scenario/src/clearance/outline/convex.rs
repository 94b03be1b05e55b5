//! A polygon as a union of convex ones.

use linkage::math::{Vec2, cross};
use parry2d_f64::transformation::{convex_hull, hertel_mehlhorn_idx};

/// Vectors of the library of shapes.
type Foreign = parry2d_f64::math::Vector;

/// Corners of the convex hull, counter-clockwise.
pub(super) fn hull(places: &[Vec2]) -> Vec<Vec2> {
    convex_hull(&foreign(places)).into_iter().map(|place| Vec2::new(place.x, place.y)).collect()
}

fn foreign(places: &[Vec2]) -> Vec<Foreign> {
    places.iter().map(|place| Foreign::new(place.x, place.y)).collect()
}

/// Convex parts of a simple counter-clockwise polygon; `None` if it cannot be divided, for want of an area.
///
/// Triangles by clipping ears (Meisters 1975), put together where that stays convex (Hertel and Mehlhorn 1983).
pub(super) fn parts(corners: &[Vec2]) -> Option<Vec<Vec<Vec2>>> {
    let triangles = triangles(corners)?;
    let of = |part: &Vec<u32>| part.iter().map(|&k| corners[k as usize]).collect::<Vec<Vec2>>();
    let parts: Vec<Vec<Vec2>> = hertel_mehlhorn_idx(&foreign(corners), &triangles).iter().map(of).collect();
    // The parts are what distances are found with: what the library puts together is not taken on trust.
    if parts.iter().all(|part| is_convex(part)) && agree(corners, &parts) {
        return Some(parts);
    }
    let parts: Vec<Vec<Vec2>> = triangles.iter().map(|triangle| of(&triangle.to_vec())).collect();
    agree(corners, &parts).then_some(parts)
}

/// Area of a polygon, positive counter-clockwise.
pub(super) fn area(corners: &[Vec2]) -> f64 {
    let around = |k: usize| cross(corners[k] - corners[0], corners[(k + 1) % corners.len()] - corners[0]);
    (0..corners.len()).map(around).sum::<f64>() / 2.0
}

/// Whether parts have together the area of the whole.
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
        // The widest ear first: slivers would make the parts thin.
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
            // A corner on the line between its neighbours bounds nothing.
            None => {
                left.remove(flat()?);
            }
        }
    }
    found.push([left[0], left[1], left[2]].map(|corner| corner as u32));
    Some(found)
}

/// Sine of the angle at the middle corner, positive where the polygon is convex.
fn sine([a, b, c]: [Vec2; 3]) -> f64 {
    cross(b - a, c - b) / ((b - a).norm() * (c - b).norm())
}

fn is_ear(corners: &[Vec2], left: &[usize], own: [usize; 3]) -> bool {
    let [a, b, c] = own.map(|corner| corners[corner]);
    let inside = |p: Vec2| cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
    sine([a, b, c]) > 1e-12 && !left.iter().any(|other| !own.contains(other) && inside(corners[*other]))
}
