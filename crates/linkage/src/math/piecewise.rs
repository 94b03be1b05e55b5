//! A function through given points.
//! Between neighbouring points, the function is a straight line or a cubic piece of a spline.

use crate::math::KeepNan;

/// Two knots count as equal if they differ by at most this fraction of the period.
const EQUAL: f64 = 1e-12;

/// Cubic pieces between ascending knots.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Piecewise {
    /// Knots.
    /// The number of knots is the number of pieces plus one.
    knots: Vec<f64>,
    /// For each piece: coefficients of the powers 0 to 3 of (x - first knot of the piece).
    pieces: Vec<[f64; 4]>,
    periodic: bool,
}

impl Piecewise {
    /// Straight lines through `(x, y)`, repeated with `period`.
    /// The values of x ascend, all within one period; two of them may be equal. At least one point is needed.
    /// At two points with the same x the function jumps.
    /// At this x the function has the value of the second point.
    pub fn periodic_lines(points: &[(f64, f64)], period: f64) -> Self {
        let (knots, values) = closed(points, period);
        let pieces = (1..knots.len())
            .map(|k| {
                let (rise, width) = (values[k] - values[k - 1], knots[k] - knots[k - 1]);
                [values[k - 1], if width > EQUAL * period { rise / width } else { 0.0 }, 0.0, 0.0]
            })
            .collect();
        Piecewise { knots, pieces, periodic: true }
    }

    /// Moves all jumps to smaller x by `by`. The function must consist of straight lines.
    /// The line after a jump is extended back to the moved jump.
    pub fn with_jumps_before(mut self, by: f64) -> Self {
        let last = self.pieces.len();
        let period = self.knots[last] - self.knots[0];
        for k in (0..last).filter(|&k| self.knots[k + 1] - self.knots[k] <= EQUAL * period).collect::<Vec<_>>() {
            let next = if k + 1 == last { 0 } else { k + 1 };
            self.pieces[next][0] -= by * self.pieces[next][1];
            self.knots[next] -= by;
            self.knots[k + 1] = if next == 0 { self.knots[0] + period } else { self.knots[next] };
            self.knots[k] = self.knots[k + 1];
        }
        self
    }

    /// The periodic cubic spline through `(x, y)`, with continuous first and second derivatives.
    /// De Boor, "A practical guide to splines", 1978, chapter IV.
    /// The values of x ascend, all within one period. At least one point is needed.
    pub fn periodic_spline(points: &[(f64, f64)], period: f64) -> Self {
        let (knots, values) = closed(points, period);
        let n = points.len();
        let (h, slope) = differences(&knots, &values);
        let before = |k: usize| (k + n - 1) % n;
        let rows =
            (0..n).map(|k| [h[before(k)], 2.0 * (h[before(k)] + h[k]), h[k], 6.0 * (slope[k] - slope[before(k)])]);
        let mut second = solve_cyclic(rows.collect());
        second.push(second[0]);
        Piecewise { pieces: of_second_derivatives(&values, &h, &slope, &second), knots, periodic: true }
    }

    /// The cubic spline through `(x, y)` with given slopes at its ends. Its first two derivatives are continuous.
    /// De Boor, chapter IV, as for the periodic spline.
    /// The values of x ascend. At least two points are needed. The outer pieces continue beyond the ends.
    pub fn clamped_spline(points: &[(f64, f64)], [first, last]: [f64; 2]) -> Self {
        let (knots, values): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        let (h, slope) = differences(&knots, &values);
        let n = knots.len();
        let rows = (0..n).map(|k| match k {
            0 => [0.0, 2.0 * h[0], h[0], 6.0 * (slope[0] - first)],
            k if k + 1 == n => [h[k - 1], 2.0 * h[k - 1], 0.0, 6.0 * (last - slope[k - 1])],
            k => [h[k - 1], 2.0 * (h[k - 1] + h[k]), h[k], 6.0 * (slope[k] - slope[k - 1])],
        });
        let second = solve_tridiagonal(&rows.collect::<Vec<_>>());
        Piecewise { pieces: of_second_derivatives(&values, &h, &slope, &second), knots, periodic: false }
    }

    /// Value and first two derivatives at `x`.
    #[inline]
    #[must_use]
    pub fn at(&self, x: f64) -> [f64; 3] {
        let (first, last) = (self.knots[0], self.knots[self.pieces.len()]);
        let x =
            if self.periodic && !(x >= first && x < last) { first + (x - first).rem_euclid(last - first) } else { x };
        let piece = self.knots.partition_point(|&knot| knot <= x).clamp(1, self.pieces.len()) - 1;
        let (d, [a, b, c, e]) = (x - self.knots[piece], self.pieces[piece]);
        [a + d * (b + d * (c + d * e)), b + d * (2.0 * c + d * 3.0 * e), 2.0 * c + d * 6.0 * e]
    }

    /// This function multiplied by `factor`.
    pub fn times(&self, factor: f64) -> Self {
        let pieces = self.pieces.iter().map(|piece| piece.map(|coefficient| factor * coefficient)).collect();
        Piecewise { pieces, knots: self.knots.clone(), periodic: self.periodic }
    }

    /// The knots. For a periodic function, the knots of one period with both ends.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Whether the knots and the values at the knots are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.knots.iter().all(|&knot| knot.is_finite() && self.at(knot).iter().all(|own| own.is_finite()))
    }

    /// Smallest and largest value of the first derivative, at the knots and between the knots.
    #[must_use]
    pub fn slopes(&self) -> [f64; 2] {
        let mut found = [f64::INFINITY, f64::NEG_INFINITY];
        for (piece, ends) in self.pieces.iter().zip(self.knots.windows(2)) {
            let [_, b, c, e] = *piece;
            let h = ends[1] - ends[0];
            let turn = if e == 0.0 { 0.0 } else { (-c / (3.0 * e)).clamp(0.0, h) };
            for d in [0.0, turn, h] {
                let slope = b + d * (2.0 * c + d * 3.0 * e);
                found = [found[0].smaller(slope), found[1].larger(slope)];
            }
        }
        found
    }
}

/// Knots and values of one period. The first point is repeated at the end, one period later.
fn closed(points: &[(f64, f64)], period: f64) -> (Vec<f64>, Vec<f64>) {
    let (x, y) = points[0];
    points.iter().copied().chain([(x + period, y)]).unzip()
}

/// Lengths and slopes of the straight lines between neighbouring points.
fn differences(knots: &[f64], values: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let h: Vec<f64> = knots.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let slope = values.windows(2).zip(&h).map(|(pair, h)| (pair[1] - pair[0]) / h).collect();
    (h, slope)
}

fn of_second_derivatives(values: &[f64], h: &[f64], slope: &[f64], second: &[f64]) -> Vec<[f64; 4]> {
    let piece = |k: usize| {
        let (from, to) = (second[k], second[k + 1]);
        [values[k], slope[k] - h[k] * (2.0 * from + to) / 6.0, from / 2.0, (to - from) / (6.0 * h[k])]
    };
    (0..h.len()).map(piece).collect()
}

/// Solves a system of diagonally dominant rows `[below, on, above the diagonal, right-hand side]`.
fn solve_tridiagonal(rows: &[[f64; 4]]) -> Vec<f64> {
    let (mut above, mut found) = (vec![0.0; rows.len()], vec![0.0; rows.len()]);
    for (k, &[below, on, over, right]) in rows.iter().enumerate() {
        let (share, known) = if k == 0 { (0.0, 0.0) } else { (above[k - 1], found[k - 1]) };
        let pivot = on - below * share;
        (above[k], found[k]) = (over / pivot, (right - below * known) / pivot);
    }
    for k in (1..rows.len()).rev() {
        found[k - 1] -= above[k - 1] * found[k];
    }
    found
}

/// Solves a cyclic system by the Sherman-Morrison formula. The rows have the same form as in `solve_tridiagonal`.
/// `below` in the first row is the coefficient of the last column.
/// `above` in the last row is the coefficient of the first column.
fn solve_cyclic(mut rows: Vec<[f64; 4]>) -> Vec<f64> {
    let n = rows.len();
    if n == 1 {
        return vec![0.0];
    }
    if n == 2 {
        let ([b, d, a, r], [p, e, q, s]) = (rows[0], rows[1]);
        let (over, under) = (a + b, p + q);
        let determinant = d * e - over * under;
        return vec![(r * e - over * s) / determinant, (d * s - under * r) / determinant];
    }
    let (corner, other) = (rows[0][0], rows[n - 1][2]);
    let gamma = -rows[0][1];
    rows[0][1] -= gamma;
    rows[n - 1][1] -= corner * other / gamma;
    let mut found = solve_tridiagonal(&rows);
    rows.iter_mut().for_each(|row| row[3] = 0.0);
    (rows[0][3], rows[n - 1][3]) = (gamma, other);
    let update = solve_tridiagonal(&rows);
    let share = (found[0] + corner * found[n - 1] / gamma) / (1.0 + update[0] + corner * update[n - 1] / gamma);
    found.iter_mut().zip(&update).for_each(|(found, update)| *found -= share * update);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [(f64, f64); 5] = [(-1.0, 2.0), (0.5, -1.0), (0.9, 3.0), (2.5, 0.0), (4.0, 1.0)];

    #[test]
    fn lines_go_through_their_points_and_repeat() {
        let lines = Piecewise::periodic_lines(&POINTS, 6.0);
        for (x, y) in POINTS {
            assert_eq!(lines.at(x)[0], y);
            assert!((lines.at(x - 18.0)[0] - y).abs() < 1e-13);
        }
        assert!((lines.at(4.5)[0] - 1.5).abs() < 1e-15 && lines.at(4.5)[1] == 1.0 && lines.at(4.5)[2] == 0.0);
    }

    #[test]
    fn equal_places_are_jumps() {
        let lines = Piecewise::periodic_lines(&[(0.0, 1.0), (2.0, 2.0), (2.0, 5.0), (6.0, 3.0)], 6.0);
        let cases =
            [(2.0, 5.0), (2.0 - 1e-12, 2.0), (4.0, 4.0), (6.0 - 1e-12, 3.0), (6.0, 1.0), (-4.0, 5.0), (12.0, 1.0)];
        for (x, y) in cases {
            assert!((lines.at(x)[0] - y).abs() < 1e-11, "{x}");
        }
    }

    #[test]
    fn splines_are_smooth_at_every_knot() {
        for count in 1..=POINTS.len() {
            let spline = Piecewise::periodic_spline(&POINTS[..count], 6.0);
            for &(x, y) in &POINTS[..count] {
                let [before, after] = [x - 1e-9, x + 1e-9].map(|x| spline.at(x));
                assert!((spline.at(x)[0] - y).abs() < 1e-14, "{count} {x}");
                for k in 0..3 {
                    assert!((before[k] - after[k]).abs() < 1e-6, "{count} {x} {before:?} {after:?}");
                }
            }
        }
    }

    #[test]
    fn a_clamped_spline_reproduces_a_cubic() {
        let (cubic, slope) = (|x: f64| 1.0 + x * (2.0 - x * (0.5 + 0.3 * x)), |x: f64| 2.0 - x * (1.0 + 0.9 * x));
        let points = [-1.0, 0.0, 0.3, 2.0].map(|x| (x, cubic(x)));
        let spline = Piecewise::clamped_spline(&points, [slope(-1.0), slope(2.0)]);
        for x in [-1.0, -0.7, 0.1, 0.3, 1.9, 2.0] {
            let [y, first, second] = spline.at(x);
            assert!((y - cubic(x)).abs() < 1e-14 && (first - slope(x)).abs() < 1e-14, "{x}");
            assert!((second + 1.0 + 1.8 * x).abs() < 1e-13, "{x}");
        }
    }

    #[test]
    fn a_periodic_spline_approximates_a_sine() {
        let points: Vec<(f64, f64)> =
            (0..32).map(|k| f64::from(k) * std::f64::consts::TAU / 32.0).map(|x| (x, x.sin())).collect();
        let spline = Piecewise::periodic_spline(&points, std::f64::consts::TAU);
        for k in 0..100 {
            let x = 0.07 * f64::from(k);
            // The error of a cubic spline with the spacing h is at most 5 / 384 h^4 times the largest fourth
            // derivative. The fourth derivative of the sine is at most 1.
            assert!((spline.at(x)[0] - x.sin()).abs() < 5.0 / 384.0 * 0.196_35f64.powi(4));
        }
        let [least, most] = spline.slopes();
        assert!((least + 1.0).abs() < 1e-4 && (most - 1.0).abs() < 1e-4, "{least} {most}");
    }
}
