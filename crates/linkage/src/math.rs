//! Mathematics without physics: plane vectors, rigid motion fields, dense linear systems, quantiles, interpolation,
//! splines, zeros and extremes.

pub mod angle;
pub mod centre;
pub mod curve;
pub mod dense;
pub mod extremum;
pub mod harmonic;
pub mod interpolate;
pub mod keep_nan;
pub mod motion;
pub mod piecewise;
pub mod projective;
pub mod quadrature;
pub mod root;
pub mod statistics;
pub mod tally;

pub use curve::{Curve, FormulaCurve, Smooth};
pub use keep_nan::{KeepNan, largest_size};
pub use motion::Motion;
pub use piecewise::Piecewise;

/// Vector in the plane XOY.
pub type Vec2 = nalgebra::Vector2<f64>;

/// Complex number, as a vector of the plane or a rotation.
pub type Complex = nalgebra::Complex<f64>;

/// Matrix of any size, for quantities that are computed in only a few poses.
pub type Matrix = nalgebra::DMatrix<f64>;

/// Column of any length.
pub type ColumnVector = nalgebra::DVector<f64>;

/// z component of the vector product a x b.
#[inline]
#[must_use]
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// `v` turned by +90 degrees: the vector product of the unit vector z with `v`.
#[inline]
#[must_use]
pub fn turned(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

/// Unit vector at `angle` (rad, counter-clockwise from +x).
#[inline]
#[must_use]
pub fn unit(angle: f64) -> Vec2 {
    let (sin, cos) = angle.sin_cos();
    Vec2::new(cos, sin)
}

/// A number just below `x`: smaller by a little more than the rounding error of |x| + 1.
#[must_use]
pub fn just_below(x: f64) -> f64 {
    if x.is_finite() { x - 16.0 * f64::EPSILON * (x.abs() + 1.0) } else { x }
}

/// Lower left and upper right corner of the smallest box that contains the points.
/// If there are no points, the lower left corner is at plus infinity and the upper right corner at minus infinity.
#[must_use]
pub fn corners(points: impl IntoIterator<Item = Vec2>) -> [Vec2; 2] {
    let none = [Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)];
    points.into_iter().fold(none, |[low, high], at| [low.inf(&at), high.sup(&at)])
}

/// Rotates `v` by the direction `d` = (cos, sin): the product of `v` and `d` as complex numbers.
#[inline]
#[must_use]
pub fn rotated(d: Vec2, v: Vec2) -> Vec2 {
    Vec2::new(d.x * v.x - d.y * v.y, d.x * v.y + d.y * v.x)
}
