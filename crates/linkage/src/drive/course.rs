//! A quantity that may depend on the crank angle, or on the slide of the first drive.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::math::{Piecewise, just_below};

/// The jumps of a table are moved back by this angle (rad) or slide (m).
/// The displacement of the jumps is much larger than rounding errors.
/// At the stated input of a jump, all solvers therefore find the value after the jump.
const BEFORE: f64 = 4e-9;

/// Beyond its ends, a table over a slide keeps its end values over a certain distance.
/// The distance is this number times (1 m + |first slide| + |last slide|).
const FAR: f64 = 100.0;

/// A knot of a table is a jump if the difference of the values on its two sides exceeds this number times the sum of
/// their magnitudes.
const EQUAL: f64 = 1e-12;

/// A constant, or a table of values against the crank angle or the slide of the first drive.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// The value, the same for every input.
    Constant(f64),
    /// A function of the input of the first drive: crank angle (rad, in the scenario's convention) or slide (m).
    Table {
        /// The function. The function of a table over a slide is stored with a period far longer than the table.
        function: Arc<Piecewise>,
        /// Period in revolutions of the crank; `None` for a table over a slide.
        turns: Option<u32>,
    },
}

impl Course {
    /// Returns a table through points of crank angle (rad) and value.
    /// There must be at least one point. The crank angles ascend and lie within `turns` revolutions.
    /// After `turns` revolutions the table repeats.
    /// If `smooth` is true, the function is a periodic cubic spline with continuous second derivatives.
    /// If `smooth` is false, straight lines join the points.
    /// Two points with the same crank angle make a jump.
    /// A last point that lies one period after the first point also makes a jump.
    /// At the crank angle of a jump, the table has the value after the jump.
    #[must_use]
    pub fn table(points: &[(f64, f64)], turns: u32, smooth: bool) -> Self {
        let period = TAU * f64::from(turns);
        let function = if smooth {
            Piecewise::periodic_spline(points, period)
        } else {
            Piecewise::periodic_lines(points, period).with_jumps_before(BEFORE)
        };
        Course::Table { function: Arc::new(function), turns: Some(turns) }
    }

    /// Returns a table through points of slide (m) and value, joined by straight lines.
    /// There must be at least one point. The slides ascend. Beyond its ends the table keeps its first and last value.
    /// Two points with the same slide make a jump, as in [`Course::table`].
    #[must_use]
    pub fn over_slide(points: &[(f64, f64)]) -> Self {
        let [first, last] = [points[0], points[points.len() - 1]];
        let far = FAR * (1.0 + first.0.abs() + last.0.abs());
        let all: Vec<(f64, f64)> =
            points.iter().copied().chain([(last.0 + far, last.1), (first.0 + 3.0 * far, first.1)]).collect();
        let function = Piecewise::periodic_lines(&all, 4.0 * far).with_jumps_before(BEFORE);
        Course::Table { function: Arc::new(function), turns: None }
    }

    /// Value at the crank angle `crank` (rad) or slide (m).
    #[inline]
    #[must_use]
    pub fn at(&self, crank: f64) -> f64 {
        match self {
            Course::Constant(value) => *value,
            Course::Table { function, .. } => function.at(crank)[0],
        }
    }

    /// Whether a constant is finite. For a table: whether knots and values are finite and the period is above zero.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        match self {
            Course::Constant(value) => value.is_finite(),
            Course::Table { function, turns } => *turns != Some(0) && function.is_finite(),
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

    /// Inputs (rad or m) at which the table jumps, each with the period after which the jump repeats.
    pub fn jumps(&self) -> impl Iterator<Item = [f64; 2]> {
        let (knots, period) = self.knots().unwrap_or_default();
        let differs = |a: f64, b: f64| (a - b).abs() > EQUAL * (a.abs() + b.abs());
        let jumps = knots
            .windows(2)
            .filter(move |pair| pair[1] <= pair[0] && differs(self.at(just_below(pair[0])), self.at(pair[0])));
        jumps.map(move |pair| [pair[0], period])
    }

    /// Breakpoints of the function (rad or m) in one period, and the period.
    /// Between two breakpoints the function is a single polynomial.
    /// `None` for a constant.
    #[must_use]
    pub fn knots(&self) -> Option<(&[f64], f64)> {
        match self {
            Course::Constant(_) => None,
            Course::Table { function, .. } => {
                let knots = function.knots();
                Some((knots, knots[knots.len() - 1] - knots[0]))
            }
        }
    }

    /// Period of a table over the crank angle, in revolutions of the crank; `None` for a constant or a table over a
    /// slide.
    #[must_use]
    pub fn turns(&self) -> Option<u32> {
        if let Course::Table { turns, .. } = self { *turns } else { None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_jumps_between_points_at_one_crank_angle_and_at_the_end_of_its_period() {
        let turn = |degrees: f64| degrees.to_radians();
        let points = [(30.0, 1.0), (90.0, 2.0), (90.0, 5.0), (390.0, 4.0)].map(|(x, y)| (turn(x), y));
        let table = Course::table(&points, 1, false);
        let jumps: Vec<[f64; 2]> = table.jumps().collect();
        assert_eq!(jumps, [[turn(90.0) - BEFORE, TAU], [turn(30.0) - BEFORE + TAU, TAU]]);
        // The lines between the jumps are unchanged, although the jumps were moved.
        assert!((table.at(turn(240.0)) - 4.5).abs() < 1e-15 && (table.at(turn(60.0)) - 1.5).abs() < 1e-15);
        for (x, y) in [(90.0, 5.0), (90.0 - 1e-6, 2.0), (30.0, 1.0), (390.0 - 1e-6, 4.0), (-270.0, 5.0)] {
            assert!((table.at(turn(x)) - y).abs() < 1e-7, "{x}");
            // Despite a rounding error of the crank angle, the value is on the correct side of the jump.
            assert!((table.at(turn(x) - 1e-12) - y).abs() < 1e-7, "{x}");
        }
        assert_eq!(Course::table(&points[..2], 1, true).jumps().count(), 0);
    }
}
