//! The outline through the points of a link. The outline is the link's default shape in pictures.

use crate::math::{KeepNan, Vec2, cross};

/// Limit for collinear points. The reference line goes through the mean point and the point farthest from it.
/// A point's distance from the line must not exceed this fraction of the distance between mean point and farthest
/// point.
const ON_ONE_LINE: f64 = 1e-6;

/// The outline through all points, and whether it is closed.
/// The outline is a polygon without crossings, or a bar if all points are collinear.
///
/// The points of a polygon are sorted by their direction from the mean point. The points of a bar are sorted by their
/// position along the bar.
#[must_use]
pub fn ring(places: &[Vec2]) -> (Vec<Vec2>, bool) {
    let mut sorted = places.to_vec();
    let centre = places.iter().sum::<Vec2>() / (places.len() as f64).larger(1.0);
    let axis = places.iter().map(|place| place - centre).max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let axis = axis.unwrap_or_else(Vec2::zeros);
    let off = |place: &Vec2| cross(axis, place - centre).abs();
    let closed = places.len() > 2 && places.iter().any(|place| off(place) > ON_ONE_LINE * axis.norm_squared());
    if closed {
        let bearing = |place: &Vec2| (place.y - centre.y).atan2(place.x - centre.x);
        sorted.sort_by(|a, b| bearing(a).total_cmp(&bearing(b)));
    } else {
        sorted.sort_by(|a, b| axis.dot(a).total_cmp(&axis.dot(b)));
    }
    (sorted, closed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plate_is_closed_and_a_bar_is_not() {
        let [a, b, c, d] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
        assert_eq!(ring(&[a, c, b, d]), (vec![a, b, c, d], true));
        assert_eq!(ring(&[b, a]), (vec![b, a], false));
        assert_eq!(ring(&[a, b * 2.0, b]).0.len(), 3);
        assert!(!ring(&[a, b * 2.0, b]).1);
        assert_eq!(ring(&[]), (vec![], false));
    }
}
