//! Plane vectors.

use std::ops::{Add, Mul, Neg, Sub};

use linkage::math::Vec2;

use super::scalar::Scalar;

/// A vector in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vector<S> {
    pub(crate) x: S,
    pub(crate) y: S,
}

impl<S: Scalar> Vector<S> {
    pub(crate) const ZERO: Self = Vector { x: S::ZERO, y: S::ZERO };
    pub(crate) const X: Self = Vector { x: S::ONE, y: S::ZERO };

    pub(crate) fn of(v: Vec2) -> Self {
        Vector { x: S::of(v.x), y: S::of(v.y) }
    }

    /// Unit vector at an angle (rad).
    pub(crate) fn unit(angle: S) -> Self {
        let (y, x) = angle.sin_cos();
        Vector { x, y }
    }

    pub(crate) fn dot(self, other: Self) -> S {
        self.x * other.x + self.y * other.y
    }

    pub(crate) fn cross(self, other: Self) -> S {
        self.x * other.y - self.y * other.x
    }

    pub(crate) fn norm(self) -> S {
        self.dot(self).sqrt()
    }

    /// Turned by +90 degrees.
    pub(crate) fn turned(self) -> Self {
        Vector { x: -self.y, y: self.x }
    }

    /// `self` rotated by the direction `by`: the product of `self` and `by` as complex numbers.
    pub(crate) fn rotated(self, by: Self) -> Self {
        Vector { x: by.x * self.x - by.y * self.y, y: by.x * self.y + by.y * self.x }
    }

    /// `self` rotated backwards by the direction `by`.
    pub(crate) fn rotated_back(self, by: Self) -> Self {
        self.rotated(Vector { x: by.x, y: -by.y })
    }
}

impl<S: Scalar> Add for Vector<S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Vector { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<S: Scalar> Sub for Vector<S> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Vector { x: self.x - other.x, y: self.y - other.y }
    }
}

impl<S: Scalar> Neg for Vector<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Vector { x: -self.x, y: -self.y }
    }
}

impl<S: Scalar> Mul<S> for Vector<S> {
    type Output = Self;
    fn mul(self, factor: S) -> Self {
        Vector { x: self.x * factor, y: self.y * factor }
    }
}
