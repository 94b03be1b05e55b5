//! The numbers in which the equations of a mechanism are solved.

use std::f64::consts::PI;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use linkage::case::CaseNumber;
use linkage::drive::Course;

/// A number in which the equations of a mechanism are solved: a double, a double-double, or a number with derivatives.
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// A full turn (rad).
    const TURN: Self;
    /// Largest change of a pose, divided by the mechanism's size, after which the pose counts as settled.
    const SETTLED: f64;
    /// If a step does not halve the change of a pose, this larger limit applies instead of `SETTLED`.
    const ROUNDING: f64;

    /// A matrix that is prepared for solving.
    type Factors: Debug;

    /// Exactly this double.
    fn of(value: f64) -> Self;

    /// The nearest double of the value.
    fn value(self) -> f64;

    /// Square root of a number that is not negative.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Sine and cosine of an angle (rad).
    fn sin_cos(self) -> (Self, Self);

    /// Prepares a square matrix, given by its rows; `None` if the matrix is singular.
    fn factors(rows: Vec<Vec<Self>>) -> Option<Self::Factors>;

    /// The solution of the linear system with this right-hand side.
    fn solution(factors: &Self::Factors, right: &[Self]) -> Vec<Self>;
}

/// Converts a number of the case to a scalar, which may have derivatives.
pub type Lift<'a, S> = &'a dyn Fn(CaseNumber, f64) -> S;

/// Gives the derivatives of a table of a load. The arguments are the index of the load and the index of the table. The
/// result has one pair for each direction in which the table has a derivative. The first part of the pair is a number
/// with the value 0 and the derivative 1 in this direction. The second part is the derivative of the table, as a table.
pub type LiftTable<'a, S> = &'a dyn Fn(usize, usize) -> Vec<(S, Course)>;

/// Angle (rad) of a direction. Whole turns are added so that the angle is as near as possible to `near` (rad).
/// The angle is the sum of an approximation in doubles and a remainder, which has the missing digits and the
/// derivatives.
pub(crate) fn angle_of<S: Scalar>([x, y]: [S; 2], near: f64) -> S {
    let rough = y.value().atan2(x.value());
    let (sin, cos) = S::of(rough).sin_cos();
    // The remainder is the rounding error of `rough`. The remainder is so small that its sine has the same value.
    let rest = cos * y - sin * x;
    let turns = ((near - rough) / (2.0 * PI)).round();
    S::of(rough) + rest + S::TURN * S::of(turns)
}
