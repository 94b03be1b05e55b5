//! Points and lines of the projective plane, where parallel lines meet at infinity.

use super::{Vec2, turned};

/// Smallest sine of the angle between the vectors of two different points, or of two different lines.
/// Below this sine, the two points or lines count as equal, because their line or intersection would have too few
/// correct digits.
const SAME: f64 = 1e-7;
/// A point farther from the origin than this (units of length) counts as a point at infinity.
const FAR: f64 = 1e9;

/// A point or a line as a unit vector. Opposite vectors mean the same point or line.
/// A point (x, y, w) stands for (x / w, y / w); w = 0 for a point at infinity in the direction (x, y).
/// A line (a, b, c) contains the points with a x + b y + c w = 0.
/// The caller chooses the origin and the unit of length so that coordinates are of the order of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projective([f64; 3]);

impl Projective {
    /// The point at `at`.
    #[must_use]
    pub fn point(at: Vec2) -> Self {
        Self::unit([at.x, at.y, 1.0])
    }

    /// The point at infinity in a direction.
    #[must_use]
    pub fn at_infinity(direction: Vec2) -> Self {
        Self::unit([direction.x, direction.y, 0.0])
    }

    /// The line through `at` with a direction.
    #[must_use]
    pub fn line(at: Vec2, direction: Vec2) -> Self {
        let normal = turned(direction);
        Self::unit([normal.x, normal.y, -normal.dot(&at)])
    }

    /// The line through two points, or the intersection of two lines.
    /// The second value is the sine of the angle between the unit vectors of the two points or lines.
    /// `None` if the two points or the two lines are equal, up to rounding errors.
    #[must_use]
    pub fn with(self, other: Self) -> Option<(Self, f64)> {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        let product = [b * f - c * e, c * d - a * f, a * e - b * d];
        let sine = product.iter().map(|part| part * part).sum::<f64>().sqrt();
        (sine > SAME).then(|| (Self::unit(product), sine))
    }

    /// The position of a point.
    ///
    /// # Errors
    /// For a point at infinity, a unit vector in the direction of the point.
    pub fn place(self) -> std::result::Result<Vec2, Vec2> {
        let [x, y, w] = self.0;
        let at = Vec2::new(x, y);
        if at.norm() <= FAR * w.abs() { Ok(at / w) } else { Err(at.normalize()) }
    }

    fn unit(parts: [f64; 3]) -> Self {
        let size = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
        Projective(parts.map(|part| part / size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_meet_and_parallel_lines_meet_at_infinity() {
        let [a, b, c, d] = [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]].map(|at| Projective::point(at.into()));
        let (rising, falling) = (a.with(b).unwrap().0, c.with(d).unwrap().0);
        let (meeting, sine) = rising.with(falling).unwrap();
        assert!((meeting.place().unwrap() - Vec2::new(0.5, 0.5)).norm() < 1e-15 && sine > 0.9);
        let shifted = Projective::line(Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0));
        let away = rising.with(shifted).unwrap().0.place().unwrap_err();
        assert!((away.x.abs() - 0.5f64.sqrt()).abs() < 1e-15 && (away.x - away.y).abs() < 1e-15);
        assert!(a.with(a).is_none() && rising.with(rising).is_none());
        // The line through two points at infinity is the line at infinity.
        // The line at infinity meets any other line at infinity in the direction of the other line.
        let [x, y] = [Vec2::x(), Vec2::y()].map(Projective::at_infinity);
        let direction = x.with(y).unwrap().0.with(rising).unwrap().0.place().unwrap_err();
        assert!((direction.x - direction.y).abs() < 1e-15);
    }
}
