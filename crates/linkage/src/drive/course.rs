//! A number that may depend on the crank angle.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::math::Piecewise;

/// A constant, or a table over the crank angle.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// The same at every crank angle.
    Constant(f64),
    /// A function of the crank angle (rad, as the scenario states it).
    Table {
        /// The function, periodic with so many turns.
        function: Arc<Piecewise>,
        /// Turns of the crank after which it repeats.
        turns: u32,
    },
}

impl Course {
    /// Straight lines (`smooth` false), or a periodic cubic spline with continuous second derivatives, through points of crank angle (rad)
    /// and value: ascending, at least one, within `turns` turns, after which the table repeats.
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

    /// Crank angles (rad) between which it is one polynomial, of one period, and the number of turns of that; none for a constant.
    #[must_use]
    pub fn knots(&self) -> Option<(&[f64], u32)> {
        match self {
            Course::Constant(_) => None,
            Course::Table { function, turns } => Some((function.knots(), *turns)),
        }
    }
}
