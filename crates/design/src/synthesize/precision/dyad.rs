//! Dyads in standard form, for three, four or five positions.
//!
//! A dyad is a chain of two vectors: X from a fixed pivot to a pin, and Y from the pin to a point.
//! The displacements d_j of this point from position 1 to position j are given.
//! The rotations of the two vectors are complex numbers of magnitude 1.
//! The rotations k_j of Y are given, and the rotations u_j of X are unknown:
//!
//! ```text
//! X (u_j - 1) + Y (k_j - 1) = d_j,   j = 2 .. n
//! ```
//!
//! (Sandor and Erdman, Advanced Mechanism Design, vol. 2, 1984, chapter 2.)
//! X and Y exist if the matrix of the rows (u_j - 1, k_j - 1, d_j) has rank 2.
//! With the minors `M_ij = (k_i - 1) d_j - (k_j - 1) d_i`, three rows p, q, r give the compatibility condition
//!
//! ```text
//! u_r M_pq = E_r + u_q M_pr,   E_r = M_pq - M_pr - (u_p - 1) M_qr.
//! ```
//!
//! Because u_r and u_q have the magnitude 1, the condition becomes `2 Re(A_r u_q) + B_r = 0`
//! with `A_r = conj(E_r) M_pr` and `B_r = |E_r|^2 + |M_pr|^2 - |M_pq|^2`.
//!
//! - Three positions: no condition; u_2 and u_3 are free.
//! - Four positions: u_p is free, and the condition has up to two roots u_q (Burmester's curve).
//! - Five positions: there are two conditions, for the rows r and s.
//!   The two conditions are linear in (u_q, conj u_q), so
//!   `u_q (A_r conj A_s - conj(A_r) A_s) = B_s conj A_r - B_r conj A_s`.
//!   The magnitude of u_q is 1 where `F = |B_s A_r - B_r A_s|^2 - 4 Im(A_r conj A_s)^2` is zero.
//!   Because u_p has the magnitude 1, u_p A is a polynomial of degree 1 in u_p, and u_p B one of degree 2.
//!   F is therefore a real trigonometric polynomial of degree 3 in the angle of u_p, with up to six roots.
//!   Two roots are trivial (all u_j = 1, and all u_j = k_j), with infinite X and Y. Up to four dyads remain.
//!
//! For five positions, Newton's method makes the dyads more exact.
//! The equations of this iteration contain no u_j: `|X + d_j - Y (k_j - 1)| = |X|`.
//! Every dyad is verified by these equations.

use linkage::math::dense::Lu;
use linkage::math::{Complex, KeepNan, harmonic};
use std::f64::consts::TAU;

/// Number of grid steps per turn if one rotation is free.
const STEPS_OF_ONE: usize = 180;
/// Number of grid steps per turn for each rotation if two rotations are free.
const STEPS_OF_TWO: usize = 24;
/// Largest change of |X| between position 1 and any other position, divided by |X| + |Y| + the largest displacement.
const PASSED: f64 = 1e-10;
/// Smallest and largest permitted magnitude of X, divided by the largest displacement.
/// Vectors outside this range cannot be built, or come from the trivial roots.
const SIZES: [f64; 2] = [1e-6, 1e4];
/// Relative difference below which two dyads are the same.
const SAME: f64 = 1e-7;
/// Relative magnitude below which all minors count as zero.
const DEGENERATE: f64 = 1e-12;

/// A dyad in standard form.
#[derive(Clone, Debug, PartialEq)]
pub struct StandardDyad {
    /// Vector X in position 1 (m). The rotations of X were unknown.
    pub free: Complex,
    /// Vector Y in position 1 (m). The rotations of Y were given.
    pub given: Complex,
    /// Rotations of X from position 1 to every position, as complex numbers of magnitude 1. The first one is 1.
    pub turns: Vec<Complex>,
}

/// The rows of the standard form. Displacements are divided by the largest displacement.
struct Rows {
    /// k_j - 1 of positions 2 to n.
    turns: Vec<Complex>,
    /// d_j of positions 2 to n.
    ways: Vec<Complex>,
    /// Largest displacement (m).
    size: f64,
}

/// Dyads whose vector Y has the rotations `turns`, and whose end has the displacements `ways` (m).
/// Rotations and displacements count from position 1, so the first rotation is 1 and the first displacement is 0.
/// The two lists have one entry for each of the three to five positions.
/// Free rotations are scanned on a fixed grid.
///
/// Returns `None` if the positions determine no dyad: all of them are rotations about one point, or translations.
pub fn dyads(turns: &[Complex], ways: &[Complex]) -> Option<Vec<StandardDyad>> {
    let size = ways.iter().map(|way| way.norm()).fold(0.0, f64::larger);
    let less = |turn: &Complex| turn - 1.0;
    let rows = Rows {
        turns: turns[1..].iter().map(less).collect(),
        ways: ways[1..].iter().map(|way| way / size).collect(),
        size,
    };
    let order = rows.order()?;
    let found = match order.rest.as_slice() {
        [] => rows.scanned(),
        [r] => rows.on_curve(&order, *r),
        [r, s, ..] => rows.isolated(&order, [*r, *s]),
    };
    Some(found.into_iter().map(|dyad| rows.in_metres(dyad)).collect())
}

/// Rows in the order of the elimination. First, u_p is scanned on a grid or is a root of F; u_q follows from u_p, and
/// the rotations of the other rows follow last.
struct Elimination {
    p: usize,
    q: usize,
    rest: Vec<usize>,
}

impl Rows {
    fn minor(&self, i: usize, j: usize) -> Complex {
        self.turns[i] * self.ways[j] - self.turns[j] * self.ways[i]
    }

    /// The order of elimination with the largest divisors; `None` if all minors are zero.
    fn order(&self) -> Option<Elimination> {
        let all = 0..self.turns.len();
        let pairs = all.clone().flat_map(|p| all.clone().map(move |q| (p, q))).filter(|(p, q)| p != q);
        let rest = |p: usize, q: usize| all.clone().filter(move |&r| r != p && r != q);
        let weight = |(p, q): (usize, usize)| {
            let others: f64 = rest(p, q).map(|r| self.minor(p, r).norm()).sum();
            self.minor(p, q).norm() * if all.len() > 2 { others } else { 1.0 }
        };
        let (p, q) = pairs.max_by(|&a, &b| weight(a).total_cmp(&weight(b)))?;
        let largest = self.minor(p, q).norm();
        (largest > DEGENERATE).then(|| Elimination { p, q, rest: rest(p, q).collect() })
    }

    /// A_r and B_r of the condition `2 Re(A_r u_q) + B_r = 0`, and E_r.
    fn condition(&self, order: &Elimination, r: usize, turn: Complex) -> (Complex, f64, Complex) {
        let &Elimination { p, q, .. } = order;
        let [pq, pr, qr] = [self.minor(p, q), self.minor(p, r), self.minor(q, r)];
        let e = pq - pr - (turn - 1.0) * qr;
        (e.conj() * pr, e.norm_sqr() + pr.norm_sqr() - pq.norm_sqr(), e)
    }

    /// Dyads of three positions. The two free rotations are scanned on a grid.
    fn scanned(&self) -> Vec<StandardDyad> {
        let grid = || steps(STEPS_OF_TWO);
        let pairs = grid().flat_map(|a| grid().map(move |b| [a, b]));
        pairs.filter_map(|turns| self.verified(self.vectors(&turns)?)).collect()
    }

    /// Dyads of four positions: points of Burmester's curve.
    fn on_curve(&self, order: &Elimination, r: usize) -> Vec<StandardDyad> {
        let of = |turn: Complex| {
            let (a, b, _) = self.condition(order, r, turn);
            unit_roots(a, b)
                .into_iter()
                .flatten()
                .filter_map(move |other| self.verified(self.vectors(&self.all_turns(order, turn, other))?))
        };
        steps(STEPS_OF_ONE).flat_map(of).collect()
    }

    /// Dyads of five positions.
    fn isolated(&self, order: &Elimination, [r, s]: [usize; 2]) -> Vec<StandardDyad> {
        let both = |angle: f64| [r, s].map(|row| self.condition(order, row, Complex::from_polar(1.0, angle)));
        let terms = |angle: f64| {
            let [(a, b, _), (c, d, _)] = both(angle);
            [(d * a - b * c).norm_sqr(), 4.0 * (a * c.conj()).im.powi(2)]
        };
        let scale = (0..8).flat_map(|k| terms(TAU * f64::from(k) / 8.0)).fold(0.0, f64::larger);
        let roots = harmonic::zeros(3, scale, |angle| terms(angle)[0] - terms(angle)[1]).unwrap_or_default();
        let mut found: Vec<StandardDyad> = Vec::new();
        for angle in roots {
            let turn = Complex::from_polar(1.0, angle);
            let others = both(angle).into_iter().flat_map(|(a, b, _)| unit_roots(a, b)).flatten();
            let starts = others.filter_map(|other| self.vectors(&self.all_turns(order, turn, other)));
            for dyad in starts.filter_map(|start| self.verified(self.polished(start)?)) {
                if !found.iter().any(|own| is_same(own, &dyad)) {
                    found.push(dyad);
                }
            }
        }
        found
    }

    /// The rotations u_j of all rows, computed from u_p and u_q. Only for a solution do all of them have the magnitude
    /// 1.
    fn all_turns(&self, order: &Elimination, p: Complex, q: Complex) -> Vec<Complex> {
        let turn = |row: usize| match row {
            _ if row == order.p => p,
            _ if row == order.q => q,
            _ => {
                let e = self.condition(order, row, p).2;
                (e + q * self.minor(order.p, row)) / self.minor(order.p, order.q)
            }
        };
        (0..self.turns.len()).map(turn).collect()
    }

    /// X and Y from the two rows with the largest determinant.
    fn vectors(&self, turns: &[Complex]) -> Option<[Complex; 2]> {
        let determinant = |i: usize, j: usize| (turns[i] - 1.0) * self.turns[j] - (turns[j] - 1.0) * self.turns[i];
        let pairs = (0..turns.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
        let (i, j) = pairs.max_by(|&a, &b| determinant(a.0, a.1).norm().total_cmp(&determinant(b.0, b.1).norm()))?;
        let [x, y] = [
            self.ways[i] * self.turns[j] - self.ways[j] * self.turns[i],
            (turns[i] - 1.0) * self.ways[j] - (turns[j] - 1.0) * self.ways[i],
        ];
        let found = [x, y].map(|value| value / determinant(i, j));
        found.iter().all(|value| value.is_finite()).then_some(found)
    }

    /// Displacements of the end of X: g_j = d_j - Y (k_j - 1).
    fn ends(&self, y: Complex) -> impl Iterator<Item = Complex> + '_ {
        self.turns.iter().zip(&self.ways).map(move |(turn, way)| way - y * turn)
    }

    /// Newton's method for five positions: solves `|g_j|^2 + 2 Re(conj(X) g_j) = 0` for X and Y.
    fn polished(&self, [mut x, mut y]: [Complex; 2]) -> Option<[Complex; 2]> {
        let mut matrix = Lu::new(4);
        for _ in 0..30 {
            matrix.clear();
            let mut step = [0.0; 4];
            for (row, (end, turn)) in self.ends(y).zip(&self.turns).enumerate() {
                let [by_x, by_y] = [2.0 * end, -2.0 * (end + x) * turn.conj()];
                [by_x.re, by_x.im, by_y.re, by_y.im]
                    .into_iter()
                    .enumerate()
                    .for_each(|(column, value)| matrix.add(row, column, value));
                step[row] = -(end.norm_sqr() + 2.0 * (x.conj() * end).re);
            }
            if !matrix.factor() {
                return None;
            }
            matrix.solve(&mut step);
            x += Complex::new(step[0], step[1]);
            y += Complex::new(step[2], step[3]);
            if !(step.iter().map(|value| value.abs()).fold(0.0, f64::larger) > 1e-15 * (x.norm() + y.norm())) {
                break;
            }
        }
        (x.is_finite() && y.is_finite()).then_some([x, y])
    }

    /// The dyad of X and Y, if |X| is the same in all positions.
    fn verified(&self, [x, y]: [Complex; 2]) -> Option<StandardDyad> {
        let [least, most] = SIZES;
        if !(x.norm() >= least && x.norm() <= most && y.norm() <= most) {
            return None;
        }
        let limit = PASSED * (1.0 + x.norm() + y.norm());
        let mut turns = vec![Complex::new(1.0, 0.0)];
        for end in self.ends(y) {
            let length = (x + end).norm();
            if !((length - x.norm()).abs() <= limit) {
                return None;
            }
            turns.push((x + end) / x * (x.norm() / length));
        }
        Some(StandardDyad { free: x, given: y, turns })
    }

    fn in_metres(&self, dyad: StandardDyad) -> StandardDyad {
        StandardDyad { free: dyad.free * self.size, given: dyad.given * self.size, ..dyad }
    }
}

fn is_same(a: &StandardDyad, b: &StandardDyad) -> bool {
    let size = a.free.norm() + a.given.norm();
    (a.free - b.free).norm() + (a.given - b.given).norm() <= SAME * size
}

/// Rotations by multiples of a `count`-th of a turn, except the rotation by zero.
fn steps(count: usize) -> impl Iterator<Item = Complex> {
    (1..count).map(move |k| Complex::from_polar(1.0, TAU * k as f64 / count as f64))
}

/// The numbers u of magnitude 1 with `2 Re(a u) + b = 0`.
/// If the equation has no solution only because of rounding errors, the nearest double root is returned.
fn unit_roots(a: Complex, b: f64) -> Option<[Complex; 2]> {
    let cos = -b / (2.0 * a.norm());
    (cos.abs() <= 1.0 + 1e-6).then(|| {
        let half = cos.smaller(1.0).larger(-1.0).acos();
        [half, -half].map(|angle| Complex::from_polar(1.0, angle - a.arg()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turns(angles: &[f64]) -> Vec<Complex> {
        angles.iter().map(|angle| Complex::from_polar(1.0, *angle)).collect()
    }

    /// A dyad with given vectors and rotations, and its displacements.
    fn known(positions: usize) -> (StandardDyad, Vec<Complex>, Vec<Complex>) {
        let (free, given) = (Complex::new(0.7, -0.4), Complex::new(0.3, 0.9));
        let [own, others] =
            [[0.0, 0.5, 1.1, 2.0, -0.8], [0.0, 0.3, 0.2, -0.7, 1.4]].map(|all| turns(&all[..positions]));
        let ways = own.iter().zip(&others).map(|(u, k)| free * (u - 1.0) + given * (k - 1.0)).collect();
        (StandardDyad { free, given, turns: own }, others, ways)
    }

    #[test]
    fn five_positions_give_the_known_dyad() {
        let (known, turns, ways) = known(5);
        let found = dyads(&turns, &ways).unwrap();
        assert!(!found.is_empty() && found.len() <= 4, "{found:?}");
        assert!(found.iter().any(|own| (own.free - known.free).norm() + (own.given - known.given).norm() < 1e-12));
    }

    /// All u_j = 1, and all u_j = k_j, are zeros of F.
    #[test]
    fn the_resultant_has_the_two_trivial_roots() {
        let (_, turns, ways) = known(5);
        let rows =
            Rows { turns: turns[1..].iter().map(|turn| turn - 1.0).collect(), ways: ways[1..].to_vec(), size: 1.0 };
        let order = rows.order().unwrap();
        for turn in [Complex::new(1.0, 0.0), rows.turns[order.p] + 1.0, Complex::from_polar(1.0, 2.5)] {
            let [(a, b, _), (c, d, _)] = [order.rest[0], order.rest[1]].map(|row| rows.condition(&order, row, turn));
            let value = (d * a - b * c).norm_sqr() - 4.0 * (a * c.conj()).im.powi(2);
            let is_root = turn != Complex::from_polar(1.0, 2.5);
            assert_eq!(value.abs() < 1e-14, is_root, "{turn}: {value:e}");
        }
    }

    #[test]
    fn every_scanned_dyad_meets_its_equations() {
        for positions in [3, 4] {
            let (_, turns, ways) = known(positions);
            let found = dyads(&turns, &ways).unwrap();
            assert!(found.len() > 50, "{}", found.len());
            for own in found {
                for ((u, k), way) in own.turns.iter().zip(&turns).zip(&ways) {
                    let rest = own.free * (u - 1.0) + own.given * (k - 1.0) - way;
                    assert!(rest.norm() < 1e-9 * (1.0 + own.free.norm() + own.given.norm()), "{own:?}");
                }
            }
        }
    }

    #[test]
    fn translations_and_one_rotation_determine_no_dyad() {
        let (_, turns, ways) = known(5);
        assert_eq!(dyads(&[Complex::new(1.0, 0.0); 5], &ways), None);
        let rotation: Vec<Complex> = turns.iter().map(|turn| Complex::new(2.0, 1.0) * (turn - 1.0)).collect();
        assert_eq!(dyads(&turns, &rotation), None);
        assert_eq!(dyads(&turns, &[Complex::default(); 5]), None);
    }
}
