//! Vectors of the plane.

pub(crate) use nalgebra::Vector2;

/// A vector of the plane (SI units, world axes unless stated otherwise).
pub(crate) type Vec2 = Vector2<f64>;

/// Vector product of two vectors of the plane: its component along z.
pub(crate) fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// `v` turned by +90 degrees.
pub(crate) fn turned(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

/// `v` turned by the angle of the unit vector `d`.
pub(crate) fn rotated(d: Vec2, v: Vec2) -> Vec2 {
    Vec2::new(d.x * v.x - d.y * v.y, d.x * v.y + d.y * v.x)
}

/// The larger number, or NaN if one of the numbers is NaN.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// Position and direction of a frame: its origin, and the unit vector of its x axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    pub(crate) origin: Vec2,
    pub(crate) direction: Vec2,
}

impl Placement {
    /// The point with the coordinates `local` in this frame.
    pub(crate) fn point(&self, local: Vec2) -> Vec2 {
        self.origin + rotated(self.direction, local)
    }

    /// World placement of a frame that has the placement `inner` in this frame.
    pub(crate) fn placed(&self, inner: &Placement) -> Placement {
        Placement { origin: self.point(inner.origin), direction: rotated(self.direction, inner.direction) }
    }
}
