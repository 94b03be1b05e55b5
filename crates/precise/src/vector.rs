//! Plane vectors of long numbers.

use std::ops::{Add, Mul, Neg, Sub};

use linkage::math::Vec2;

use super::Long;

/// A vector in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vector {
    pub(crate) x: Long,
    pub(crate) y: Long,
}

impl Vector {
    pub(crate) const ZERO: Vector = Vector { x: Long::ZERO, y: Long::ZERO };
    pub(crate) const X: Vector = Vector { x: Long::ONE, y: Long::ZERO };

    pub(crate) fn of(v: Vec2) -> Vector {
        Vector { x: Long::of(v.x), y: Long::of(v.y) }
    }

    /// Unit vector at an angle (rad).
    pub(crate) fn unit(angle: Long) -> Vector {
        let (y, x) = angle.sin_cos();
        Vector { x, y }
    }

    pub(crate) fn dot(self, other: Vector) -> Long {
        self.x * other.x + self.y * other.y
    }

    pub(crate) fn cross(self, other: Vector) -> Long {
        self.x * other.y - self.y * other.x
    }

    pub(crate) fn norm(self) -> Long {
        self.dot(self).sqrt()
    }

    /// Turned by +90 degrees.
    pub(crate) fn turned(self) -> Vector {
        Vector { x: -self.y, y: self.x }
    }

    /// `self` rotated by the direction `by`: the product of `self` and `by` as complex numbers.
    pub(crate) fn rotated(self, by: Vector) -> Vector {
        Vector { x: by.x * self.x - by.y * self.y, y: by.x * self.y + by.y * self.x }
    }

    /// `self` rotated backwards by the direction `by`.
    pub(crate) fn rotated_back(self, by: Vector) -> Vector {
        self.rotated(Vector { x: by.x, y: -by.y })
    }
}

impl Add for Vector {
    type Output = Vector;
    fn add(self, other: Vector) -> Vector {
        Vector { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Sub for Vector {
    type Output = Vector;
    fn sub(self, other: Vector) -> Vector {
        Vector { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Neg for Vector {
    type Output = Vector;
    fn neg(self) -> Vector {
        Vector { x: -self.x, y: -self.y }
    }
}

impl Mul<Long> for Vector {
    type Output = Vector;
    fn mul(self, factor: Long) -> Vector {
        Vector { x: self.x * factor, y: self.y * factor }
    }
}
