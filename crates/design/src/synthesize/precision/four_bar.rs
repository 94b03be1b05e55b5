//! A four-bar that passes precision points, with checks of its assembly mode, the order of the positions, its crank and
//! its transmission angle.
//!
//! Let f, a, b and c be the lengths of frame, crank, coupler and rocker, and x the crank's angle from the line of the
//! pivots.
//! The diagonal AC then has the length d with `d^2 = f^2 + a^2 - 2 f a cos x`.
//! The dyad (b, c) can be assembled for `|b - c| <= d <= b + c`.
//! The angle x of a driven crank stays in one interval for which this is true, and the dyad keeps its assembly mode.
//! (For example Hunt, Kinematic Geometry of Mechanisms, 1978, section 4.1.)

use crate::synthesize::transmission_angle;
use analytic::range::{FourBar, FourBarType};
use linkage::math::{Complex, KeepNan};
use linkage::mechanism::AssemblyMode;
use std::f64::consts::{PI, TAU};

/// Lengths below this fraction of the longest length count as zero.
const POINTLIKE: f64 = 1e-6;
/// Largest change of the coupler's length between the positions, relative to the longest length.
const PASSED: f64 = 1e-9;
/// Largest angle (rad) by which rounding may put a position outside the reachable interval.
const AT_LIMIT: f64 = 1e-7;

/// A link from the ground to the coupler: the crank or the rocker.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct GroundLink {
    /// Pivot on the ground (m).
    pub(super) pivot: Complex,
    /// Pin on the coupler in position 1 (m).
    pub(super) pin: Complex,
    /// Rotations of the link from position 1 to every position, as complex numbers of magnitude 1.
    pub(super) turns: Vec<Complex>,
}

impl GroundLink {
    fn arm(&self) -> Complex {
        self.pin - self.pivot
    }

    fn pins(&self) -> impl Iterator<Item = Complex> + '_ {
        self.turns.iter().map(|turn| self.pivot + self.arm() * turn)
    }
}

/// Range of the crank angle, measured from position 1 (rad, counter-clockwise positive).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CrankTravel {
    /// The crank turns fully. In the sense `sense`, it passes the positions in their order if this is possible.
    FullTurn {
        /// +1 counter-clockwise, -1 clockwise.
        sense: f64,
    },
    /// The crank does not turn fully. It moves from the first of these two angles to the second. The range contains all
    /// positions that the crank reaches from position 1.
    Between([f64; 2]),
}

/// The checks of a four-bar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBarChecks {
    /// Lengths of frame, crank, coupler and rocker (m).
    pub lengths: [f64; 4],
    /// Grashof's type.
    pub of_type: FourBarType,
    /// Assembly mode of the dyad (coupler, rocker) in position 1.
    pub mode: AssemblyMode,
    /// Crank angles of the motion through the positions.
    pub travel: CrankTravel,
    /// Smallest transmission angle over the motion `travel` (rad), at most a right angle.
    pub transmission: f64,
    /// Ratio of the longest length to the shortest of the four `lengths`.
    /// The longest length is the largest of the four `lengths` and of the working point's distances from the two pins.
    pub ratio: f64,
    /// Whether the driven crank reaches all positions in one assembly mode, without a dead point between them.
    pub keeps_branch: bool,
    /// Whether the positions are passed in their order.
    pub keeps_order: bool,
}

impl FourBarChecks {
    /// Whether the crank turns fully.
    #[must_use]
    pub fn turns_fully(&self) -> bool {
        matches!(self.travel, CrankTravel::FullTurn { .. })
    }

    /// Checks the four-bar of a crank and a rocker. `point` is the working point in position 1.
    /// `None` if a link has no length, if the coupler's length changes between the positions, or if a number overflows.
    pub(super) fn of([crank, rocker]: [&GroundLink; 2], point: Option<Complex>) -> Option<Self> {
        let (frame, coupler) = (rocker.pivot - crank.pivot, rocker.pin - crank.pin);
        let lengths = [frame, crank.arm(), coupler, rocker.arm()].map(|arm| arm.norm());
        let reach = point.into_iter().flat_map(|point| [point - crank.pin, point - rocker.pin]);
        let [least, most] =
            [lengths.into_iter().fold(f64::INFINITY, f64::smaller), lengths.into_iter().fold(0.0, f64::larger)];
        if !(least > POINTLIKE * most && most.is_finite()) {
            return None;
        }
        let angles: Vec<f64> = crank.turns.iter().map(|turn| (crank.arm() * turn / frame).arg()).collect();
        let side = |[a, b]: [Complex; 2]| ((rocker.pivot - a).conj() * (b - a)).im > 0.0;
        let sides: Vec<bool> = crank.pins().zip(rocker.pins()).map(|(a, b)| side([a, b])).collect();
        let is_rigid = |(a, b): (Complex, Complex)| ((b - a).norm() - lengths[2]).abs() <= PASSED * most;
        if !crank.pins().zip(rocker.pins()).all(is_rigid) {
            return None;
        }
        let has_one_mode = sides.iter().all(|own| *own == sides[0]);
        let motion = Motion::of(lengths, &angles);
        let transmission = motion.transmission(lengths, angles[0]);
        transmission.is_finite().then(|| FourBarChecks {
            lengths,
            of_type: FourBar::of_lengths(lengths).of_type,
            mode: if sides[0] { AssemblyMode::Left } else { AssemblyMode::Right },
            travel: motion.travel,
            transmission,
            ratio: reach.map(|arm| arm.norm()).fold(most, f64::larger) / least,
            keeps_branch: has_one_mode && motion.is_one_interval,
            keeps_order: motion.is_in_order,
        })
    }
}

/// Motion of a crank through its positions.
struct Motion {
    travel: CrankTravel,
    is_one_interval: bool,
    is_in_order: bool,
}

impl Motion {
    /// The motion through these crank angles, measured from the line of the pivots (rad).
    fn of(lengths: [f64; 4], angles: &[f64]) -> Self {
        let intervals = reachable(lengths);
        if intervals.is_empty() {
            let forwards = is_cyclic(angles, 1.0);
            let sense = if forwards || !is_cyclic(angles, -1.0) { 1.0 } else { -1.0 };
            let is_in_order = is_cyclic(angles, sense);
            return Motion { travel: CrankTravel::FullTurn { sense }, is_one_interval: true, is_in_order };
        }
        let inside = |[from, to]: [f64; 2]| -> Vec<f64> {
            angles.iter().filter_map(|&angle| within(angle, from - AT_LIMIT, to + AT_LIMIT)).collect()
        };
        // The first interval that contains the first position. Rounding may put this position outside all intervals.
        let has_first =
            |&interval: &[f64; 2]| within(angles[0], interval[0] - AT_LIMIT, interval[1] + AT_LIMIT).is_some();
        let own = intervals.into_iter().find(has_first).map(inside).unwrap_or_default();
        let start = own.first().copied().unwrap_or(angles[0]);
        let [least, most] =
            [own.iter().copied().fold(start, f64::smaller), own.iter().copied().fold(start, f64::larger)];
        let rises = own.is_sorted();
        let ends = if rises || own.last() > own.first() { [least, most] } else { [most, least] };
        Motion {
            travel: CrankTravel::Between(ends.map(|end| end - start)),
            is_one_interval: own.len() == angles.len(),
            is_in_order: rises || own.iter().rev().is_sorted(),
        }
    }

    /// Smallest transmission angle (rad). The transmission angle has its extremes at the ends of the motion, and where
    /// the crank is on the line of the pivots.
    /// `first` is the crank's angle from the line of the pivots in position 1 (rad).
    fn transmission(&self, [frame, crank, coupler, rocker]: [f64; 4], first: f64) -> f64 {
        let diagonal = |x: f64| (frame * frame + crank * crank - 2.0 * frame * crank * x.cos()).larger(0.0).sqrt();
        let [from, to] = match self.travel {
            CrankTravel::FullTurn { .. } => [first, first + TAU],
            CrankTravel::Between(ends) => ends.map(|end| first + end),
        };
        let [from, to] = [from.smaller(to), from.larger(to)];
        let in_line = (-3..=4).map(|k| PI * f64::from(k)).filter(|x| *x > from && *x < to);
        in_line.chain([from, to]).map(|x| transmission_angle(diagonal(x), coupler, rocker)).fold(PI / 2.0, f64::smaller)
    }
}

/// Intervals of the crank's angle from the line of the pivots (rad) in which the dyad can be assembled.
/// The list is empty if the crank turns fully.
fn reachable([frame, crank, coupler, rocker]: [f64; 4]) -> Vec<[f64; 2]> {
    let angle = |distance: f64| {
        let cos = (frame * frame + crank * crank - distance * distance) / (2.0 * frame * crank);
        (cos.abs() < 1.0).then(|| cos.acos())
    };
    match [angle((coupler - rocker).abs()), angle(coupler + rocker)] {
        [None, None] => vec![],
        [Some(inner), None] => vec![[inner, TAU - inner]],
        [None, Some(outer)] => vec![[-outer, outer]],
        [Some(inner), Some(outer)] => vec![[inner, outer], [-outer, -inner]],
    }
}

/// The angle in an interval (rad) that differs from `angle` by whole turns; `None` if there is no such angle.
fn within(angle: f64, from: f64, to: f64) -> Option<f64> {
    (-1..=1).map(|k| angle + TAU * f64::from(k)).find(|own| *own >= from && *own <= to)
}

/// Whether a rotation in one sense passes these angles (rad) in their order within one turn.
fn is_cyclic(angles: &[f64], sense: f64) -> bool {
    angles.windows(2).map(|pair| (sense * (pair[1] - pair[0])).rem_euclid(TAU)).sum::<f64>() < TAU
}

/// The coordinate frame of a link in position 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionFrame {
    /// Origin (m).
    pub origin: Complex,
    /// Angle of the x axis (rad, counter-clockwise).
    pub angle: f64,
}

impl PositionFrame {
    /// Converts a point (m) to the coordinates of the link. A coordinate below the rounding error is set to zero.
    #[must_use]
    pub fn local(&self, point: Complex) -> Complex {
        let at = (point - self.origin) * Complex::from_polar(1.0, -self.angle);
        let least = 4.0 * f64::EPSILON * (point.norm() + self.origin.norm());
        let shown = |value: f64| if value.abs() <= least { 0.0 } else { value };
        Complex::new(shown(at.re), shown(at.im))
    }
}

/// A four-bar that passes all positions.
#[derive(Clone, Debug, PartialEq)]
pub struct PrecisionFourBar {
    /// Pivots O of the crank and C of the rocker (m).
    pub pivots: [Complex; 2],
    /// Pins A of the crank and B of the rocker on the coupler in position 1 (m).
    pub pins: [Complex; 2],
    /// Working point P of the coupler in position 1 (m); `None` for a function generator.
    pub point: Option<Complex>,
    /// Frames of crank, coupler and rocker in position 1.
    pub frames: [PositionFrame; 3],
    /// Rotations of the crank from position 1 to every position (rad), along the travel: in the sense of a full turn,
    /// or inside the travel's limits. For a position outside these limits, the rotation is between -pi and pi.
    pub crank_turns: Vec<f64>,
    /// The checks.
    pub checks: FourBarChecks,
}

/// What the task gives about the frames of the links. The x axis of a link whose angle is not given points from its
/// pivot to its pin. That of the coupler points from the crank's pin to the rocker's pin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct GivenFrames {
    /// Working point of the coupler in position 1 (m).
    pub(super) point: Option<Complex>,
    /// Crank angle in position 1 (rad).
    pub(super) crank: Option<f64>,
    /// Angle of the coupler in position 1 (rad). If it is given, the working point is the origin of the coupler's
    /// frame.
    pub(super) coupler: Option<f64>,
    /// Rocker angle in position 1 (rad).
    pub(super) rocker: Option<f64>,
}

impl PrecisionFourBar {
    pub(super) fn of([crank, rocker]: [&GroundLink; 2], given: &GivenFrames, checks: FourBarChecks) -> Self {
        let coupler = rocker.pin - crank.pin;
        let along = |origin: Complex, arm: Complex, angle: Option<f64>| PositionFrame {
            origin,
            angle: angle.unwrap_or_else(|| arm.arg()),
        };
        let origin = given.coupler.and(given.point).unwrap_or(crank.pin);
        let turn = |turn: &Complex| match checks.travel {
            CrankTravel::FullTurn { sense } => sense * (sense * turn.arg()).rem_euclid(TAU),
            CrankTravel::Between([from, to]) => {
                let [least, most] = [from.smaller(to) - AT_LIMIT, from.larger(to) + AT_LIMIT];
                within(turn.arg(), least, most).unwrap_or_else(|| turn.arg())
            }
        };
        PrecisionFourBar {
            pivots: [crank.pivot, rocker.pivot],
            pins: [crank.pin, rocker.pin],
            point: given.point,
            frames: [
                along(crank.pivot, crank.arm(), given.crank),
                along(origin, coupler, given.coupler),
                along(rocker.pivot, rocker.arm(), given.rocker),
            ],
            crank_turns: [0.0].into_iter().chain(crank.turns[1..].iter().map(turn)).collect(),
            checks,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reachable_angles_follow_from_the_lengths() {
        // Crank-rocker, double-crank.
        assert_eq!(reachable([4.0, 1.0, 3.5, 3.0]), Vec::<[f64; 2]>::new());
        assert_eq!(reachable([1.0, 4.0, 3.5, 3.0]), Vec::<[f64; 2]>::new());
        // The dyad is stretched at the diagonal 4 = 1.5 + 2.5, so cos x = (9 + 4 - 16) / 12. The dyad is folded at the
        // diagonal 1 = 3 - 2.
        let [[from, to]] = reachable([3.0, 2.0, 1.5, 2.5])[..] else { panic!("one interval") };
        assert!((to + from).abs() < 1e-15 && (to - (-0.25f64).acos()).abs() < 1e-15);
        // Both limits: double-rocker.
        assert_eq!(reachable([3.0, 2.5, 1.0, 3.0]).len(), 2);
    }

    #[test]
    fn order_is_cyclic() {
        assert!(is_cyclic(&[0.0, 2.0, 4.0, 6.0], 1.0) && !is_cyclic(&[0.0, 2.0, 4.0, 6.0], -1.0));
        assert!(is_cyclic(&[5.0, 0.5, 4.9], 1.0) && !is_cyclic(&[5.0, 0.5, 5.1], 1.0));
        assert!(is_cyclic(&[3.0, 2.0, 1.0], -1.0) && !is_cyclic(&[0.0, 2.0, 1.0, 3.0], 1.0));
    }

    /// A crank whose positions lie on both sides of a dead point cannot be driven from one side to the other.
    #[test]
    fn a_dead_point_between_positions_is_a_branch_defect() {
        let link = |pivot: f64, arm: f64, angles: [f64; 3]| GroundLink {
            pivot: pivot.into(),
            pin: pivot + arm * Complex::from_polar(1.0, angles[0]),
            turns: angles.iter().map(|angle| Complex::from_polar(1.0, angle - angles[0])).collect(),
        };
        // Rocker angles of the four-bar (3, 2, 1.5, 2.5) at a crank angle. The sign of `side` selects the mode.
        let rocker = |crank: f64, side: f64| {
            let pin = 2.0 * Complex::from_polar(1.0, crank);
            let diagonal: Complex = Complex::from(3.0) - pin;
            let d = diagonal.norm();
            let half = ((1.5f64.powi(2) + d * d - 2.5f64.powi(2)) / (3.0 * d)).acos();
            (pin + diagonal / d * 1.5 * Complex::from_polar(1.0, side * half) - 3.0).arg()
        };
        let cranks = [0.8, 0.5, 1.2];
        let of = |sides: [f64; 3]| {
            let rockers = [0, 1, 2].map(|k| rocker(cranks[k], sides[k]));
            FourBarChecks::of([&link(0.0, 2.0, cranks), &link(3.0, 2.5, rockers)], None).unwrap()
        };
        let same = of([1.0; 3]);
        assert!(same.keeps_branch && !same.keeps_order && !same.turns_fully() && same.mode == AssemblyMode::Left);
        let CrankTravel::Between([from, to]) = same.travel else { panic!("{same:?}") };
        assert!((from + 0.3).abs() < 1e-12 && (to - 0.4).abs() < 1e-12, "{same:?}");
        assert!(!of([1.0, 1.0, -1.0]).keeps_branch && of([-1.0; 3]).mode == AssemblyMode::Right);
    }
}
