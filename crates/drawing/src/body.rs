//! Links: bars, plates, mass centres and traced points.

use std::collections::BTreeSet;

use super::mark::{Mark, MarkRole};
use linkage::math::{KeepNan, Vec2, cross, turned, unit};
use linkage::mechanism::{GROUND, LinkId, Mechanism};

/// Sizes in units of the sketch. `WELD` is the radius of the half disc that marks a bar as continuous.
/// `MASS` is the radius of a mass centre's circle, and `TRACER` half the width of a traced point's cross.
const WELD: f64 = 2.0;
const MASS: f64 = 1.7;
const TRACER: f64 = 1.1;
/// Number of straight pieces that represent a quarter of a circle.
const QUARTER: usize = 6;

/// Positions on a link (m, link frame): first its points, then the positions of joints at which it has no named point.
pub fn places(mechanism: &Mechanism, link: LinkId) -> Vec<Vec2> {
    let points = mechanism.links()[link].points.iter().map(|point| point.local);
    let all = points.chain(mechanism.joints().iter().filter_map(|joint| joint.on(link)));
    // Positive and negative zero are the same position. Adding 0.0 gives both the same bits.
    let mut seen = BTreeSet::new();
    all.filter(|place| seen.insert([place.x, place.y].map(|own| (own + 0.0).to_bits()))).collect()
}

/// Corners of a link: the corners of its convex hull, or the two ends of a bar.
pub fn corners(mechanism: &Mechanism, link: LinkId) -> Vec<Vec2> {
    hull(places(mechanism, link))
}

/// A point on a link at which a symbol does not hide a joint: the middle of a plate, or the middle of the longest piece
/// of a bar.
/// `None` if the plate or the piece is shorter than `least` (m).
pub fn free(mechanism: &Mechanism, link: LinkId, least: f64) -> Option<Vec2> {
    let (mut places, corners) = (places(mechanism, link), corners(mechanism, link));
    if let [first, _] = corners[..] {
        places.sort_by(|a, b| (a - first).norm().total_cmp(&(b - first).norm()));
        let pieces = places.windows(2).map(|pair| ((pair[1] - pair[0]).norm(), (pair[0] + pair[1]) / 2.0));
        return pieces.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|piece| piece.0 >= least).map(|piece| piece.1);
    }
    let middle = corners.iter().sum::<Vec2>() / corners.len().max(1) as f64;
    (corners.len() > 2 && size(mechanism, link) >= least).then_some(middle)
}

/// The bar or plate of a moving link, its mass centre and its traced points.
pub fn marks(mechanism: &Mechanism, link: LinkId, unit: f64) -> Vec<Mark> {
    let corners = corners(mechanism, link);
    let mut marks = Vec::new();
    match corners.len() {
        0 | 1 => {}
        2 => {
            marks.push(Mark::line(MarkRole::Bar, corners.clone()));
            let along = (corners[1] - corners[0]).normalize();
            let pins = mechanism.joints().iter().filter(|joint| joint.is_pin()).filter_map(|joint| joint.on(link));
            let mut inner: Vec<Vec2> = pins.filter(|at| !corners.contains(at)).collect();
            inner.dedup();
            marks.extend(
                inner.into_iter().map(|at| Mark::area(MarkRole::Weld, sector(at, WELD * unit, along, 2 * QUARTER))),
            );
        }
        _ => marks.push(Mark::area(MarkRole::Plate, corners.clone())),
    }
    marks.extend(traced(mechanism, link).into_iter().flat_map(|at| tracer(at, unit)));
    let body = &mechanism.links()[link];
    if body.mass > 0.0 {
        let (at, radius) = (body.mass_centre, MASS * unit);
        let near = nearest(&corners, at);
        if (at - near).norm() > radius {
            marks.push(Mark::line(MarkRole::MassCentre, [at, near]));
        }
        marks.push(Mark::circle(MarkRole::MassCentre, at, radius));
        for side in [1.0, -1.0].map(|side| Vec2::new(side, 0.0)) {
            let mut quarter = sector(at, radius, side, QUARTER);
            quarter.push(at);
            marks.push(Mark::area(MarkRole::MassQuarter, quarter));
        }
    }
    marks
}

/// The point of a bar or plate that is nearest to `at`.
/// The result is `at` itself if `at` lies inside a plate, or if there are no corners.
fn nearest(corners: &[Vec2], at: Vec2) -> Vec2 {
    let edges = || corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&a, &b)| [a, b]);
    // The corners of a plate are counter-clockwise.
    if corners.len() != 1 && edges().all(|[a, b]| cross(b - a, at - a) > 0.0) {
        return at;
    }
    let foot = |[a, b]: [Vec2; 2]| {
        let length = (b - a).norm_squared();
        let share = if length > 0.0 { (at - a).dot(&(b - a)) / length } else { 0.0 };
        a + (b - a) * share.clamp(0.0, 1.0)
    };
    edges().map(foot).min_by(|a, b| (a - at).norm().total_cmp(&(b - at).norm())).unwrap_or(at)
}

/// Named points of a link that are not joints.
pub fn traced(mechanism: &Mechanism, link: LinkId) -> Vec<Vec2> {
    let is_joint = |at: Vec2| mechanism.joints().iter().any(|joint| joint.on(link) == Some(at));
    let points = mechanism.links()[link].points.iter().map(|point| point.local);
    points.filter(|&at| !is_joint(at)).collect()
}

/// The cross of a traced point.
pub fn tracer(at: Vec2, unit: f64) -> [Mark; 2] {
    let half = Vec2::new(TRACER, TRACER) * unit;
    [half, turned(half)].map(|half| Mark::line(MarkRole::Tracer, [at - half, at + half]))
}

/// Points on a circle, counter-clockwise from the direction `from`, in `steps` steps of 90 deg / [`QUARTER`].
fn sector(centre: Vec2, radius: f64, from: Vec2, steps: usize) -> Vec<Vec2> {
    let start = from.y.atan2(from.x);
    let step = std::f64::consts::FRAC_PI_2 / QUARTER as f64;
    (0..=steps).map(|k| centre + unit(start + step * k as f64) * radius).collect()
}

/// Largest distance between two points of a link (m); infinite for the ground.
pub fn size(mechanism: &Mechanism, link: LinkId) -> f64 {
    if link == GROUND {
        return f64::INFINITY;
    }
    let places = places(mechanism, link);
    places.iter().flat_map(|a| places.iter().map(move |b| (a - b).norm())).fold(0.0, f64::larger)
}

/// Convex hull of the points `places`, counter-clockwise (Andrew 1979).
/// If all points are on one line, the result is the two ends of the line.
fn hull(mut places: Vec<Vec2>) -> Vec<Vec2> {
    places.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let far = places.iter().map(|at| (at - places[0]).norm_squared()).fold(0.0, f64::larger);
    let half = |order: &mut dyn Iterator<Item = &Vec2>| {
        let mut chain: Vec<Vec2> = Vec::new();
        for &place in order {
            while let [.., a, b] = chain[..]
                && cross(b - a, place - b) <= 1e-6 * far
            {
                chain.pop();
            }
            chain.push(place);
        }
        chain.pop();
        chain
    };
    let mut corners = half(&mut places.iter());
    corners.extend(half(&mut places.iter().rev()));
    if corners.is_empty() { places } else { corners }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mass_centres_off_their_link_have_a_nearest_point_on_it() {
        let [a, b, c] = [(0.0, 0.0), (2.0, 0.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
        let at = Vec2::new(0.5, -1.0);
        assert_eq!(nearest(&[a, b, c], at), Vec2::new(0.5, 0.0));
        assert_eq!((nearest(&[a, b], at), nearest(&[c], at), nearest(&[], at)), (Vec2::new(0.5, 0.0), c, at));
        assert_eq!(nearest(&[a, b, c], Vec2::new(0.5, 0.5)), Vec2::new(0.5, 0.5));
    }

    #[test]
    fn hulls_of_bars_and_plates() {
        let at = |points: &[(f64, f64)]| hull(points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()).len();
        assert_eq!(at(&[(0.0, 0.0), (2.0, 2.0), (1.0, 1.0)]), 2);
        assert_eq!(at(&[(0.0, 0.0), (2.0, 0.0), (1.0, 1.0), (1.0, 0.2)]), 3);
        assert_eq!((at(&[(0.0, 0.0)]), at(&[])), (1, 0));
        // A plate must not be mistaken for a bar if it lies far from the origin of its frame.
        assert_eq!(at(&[(1e4, 0.0), (1e4 + 1.0, 0.0), (1e4, 1.0)]), 3);
    }
}
