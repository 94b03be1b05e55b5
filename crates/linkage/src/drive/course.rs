//! A quantity that may depend on the crank angle.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::math::Piecewise;

/// A constant, or a table of values against the crank angle.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// The value, the same at every crank angle.
    Constant(f64),
    /// A periodic function of the crank angle (rad, in the scenario's convention).
    Table {
        /// The function. Its period is `turns` revolutions of the crank.
        function: Arc<Piecewise>,
        /// Period in revolutions of the crank.
        turns: u32,
    },
}

impl Course {
    /// Returns a table through points of crank angle (rad) and value.
    /// There must be at least one point. The crank angles ascend and lie within `turns` revolutions.
    /// After `turns` revolutions the table repeats.
    /// If `smooth` is true, the function is a periodic cubic spline with continuous second derivatives.
    /// Otherwise straight lines join the points.
    #[must_use]
    pub fn table(points: &[(f64, f64)], turns: u32, smooth: bool) -> Self {
        let of = if smooth { Piecewise::periodic_spline } else { Piecewise::periodic_lines };
        Course::Table { function: Arc::new(of(points, TAU * f64::from(turns))), turns }
    }

    /// Value at the crank angle `crank` (rad).
    #[inline]
    #[must_use]
    pub fn at(&self, crank: f64) -> f64 {
        match self {
            Course::Constant(value) => *value,
            Course::Table { function, .. } => function.at(crank)[0],
        }
    }

    /// Whether all numbers are finite and, for a table, the period is above zero.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        match self {
            Course::Constant(value) => value.is_finite(),
            Course::Table { function, turns } => *turns > 0 && function.knots().iter().all(|knot| knot.is_finite()),
        }
    }

    /// Returns this quantity multiplied by `factor`.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        match self {
            Course::Constant(value) => Course::Constant(factor * value),
            Course::Table { function, turns } => {
                Course::Table { function: Arc::new(function.times(factor)), turns: *turns }
            }
        }
    }

    /// Breakpoints of the function (crank angles) in one period, and the period in revolutions.
    /// Between two breakpoints the function is a single polynomial.
    /// `None` for a constant.
    #[must_use]
    pub fn knots(&self) -> Option<(&[f64], u32)> {
        match self {
            Course::Constant(_) => None,
            Course::Table { function, turns } => Some((function.knots(), *turns)),
        }
    }
}
