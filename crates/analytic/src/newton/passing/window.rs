//! The surroundings of a change point.
//!
//! Coordinates are polynomials through six poses with their first and second derivatives. Multipliers are polynomials
//! through sixteen poses.
//! The second derivatives are approximated by two polynomials.
//! Several half widths are tried; the half width with the smallest difference between the two polynomials is chosen.
//! The first polynomial is the osculating polynomial, differentiated twice.
//! The second polynomial passes through the second derivatives at all sixteen poses.
//! The two polynomials have different degrees and different data.
//! At the distance x from the change point, the rounding error of second derivatives grows as 1 / x^3.
//! The error of the polynomials grows with the width.

use crate::sentences;
use std::f64::consts::{PI, TAU};

use super::osculating::Osculating;
use super::spot::{Spot, place, settled, walked};
use crate::newton::steps::TRACKING_STEP;
use crate::newton::system::System;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::mechanism::{GROUND, LinkId};

/// Number of poses on each side of the change point. `CHOSEN` contains the indices of the poses used for coordinates,
/// from the outermost inwards.
const SIDE: usize = 8;
const CHOSEN: [usize; 3] = [0, 3, 6];
/// Distance of the innermost pose, divided by the half width.
const CORE: f64 = 0.2;
/// Half widths that are tried (rad).
const WIDTHS: [f64; 11] = [0.5, 0.36, 0.25, 0.18, 0.12, 0.08, 0.06, 0.04, 0.025, 0.017, 0.01];
/// If the path is lost in a window, the next half width is at most this fraction of the failing half width.
/// The cause of a lost path is another singular pose nearby, towards which multipliers may grow without bound.
const CLEAR: f64 = 0.5;
/// A change point is passed only if [`Window::error`] is below this value.
const WORST: f64 = 1e-6;
/// Number of secant steps that improve the position of a change point.
const SECANTS: usize = 4;
/// Two computed change points count as one change point if their distance is at most this fraction of the innermost
/// pose's distance from the change point.
/// Such a distance can result from rounding.
const APART: f64 = 0.01;
/// Positions at which the two polynomials for the second derivatives are compared, divided by the half width.
const COMPARED: [f64; 3] = [-0.1, 0.0, 0.1];
/// Cube root of the sum of the weights' magnitudes. This sum is about four. The polynomials amplify the rounding error
/// of the poses by this sum.
const WEIGHTS: f64 = 1.6;
/// The rounding error of accelerations is the unit roundoff, times the cube of the condition number, times this factor.
const ULPS: f64 = 16.0;

/// The surroundings of a change point.
#[derive(Clone, Debug)]
pub(in crate::newton) struct Window {
    /// The crank's angle in the world at the change point (rad).
    pub(super) at: f64,
    /// Half width (rad).
    pub(super) reach: f64,
    /// The poses, in ascending order of the angle.
    pub(super) spots: Vec<Spot>,
    /// Distances of these poses from the change point (rad).
    pub(super) places: Vec<f64>,
    /// Whole turns in each coordinate that is an angle (rad); 0 for positions.
    /// The polynomials use the coordinates without these turns, because large angles would lose digits.
    turns: Vec<f64>,
    coordinates: Osculating,
    /// Condition number that determines the rounding error in the window.
    pub(in crate::newton) condition: f64,
}

impl Window {
    /// The surroundings of a change point of a block at the angle `at` (rad).
    /// The poses are reached from the nearby spot `from`.
    pub(super) fn around(system: &mut System, from: &Spot, [at, share]: [f64; 2], block: usize) -> Result<Self> {
        let mut best: Option<(f64, Window)> = None;
        let (mut failed, mut allowed) = (None, f64::INFINITY);
        let turns = whole_turns(&from.q);
        let twists = system.twists.clone();
        let crank = turns[3 * (system.case.crank().link.index() - 1) + 2];
        for (joint, twist) in system.case.mechanism.joints().iter().zip(&mut system.twists) {
            let of = |link: LinkId| if link == GROUND { 0.0 } else { turns[3 * (link.index() - 1) + 2] };
            *twist -= of(joint.second.link) - of(joint.first.link);
        }
        let mut bare = Spot { angle: from.angle - crank, ..from.clone() };
        bare.q.iter_mut().zip(&turns).for_each(|(q, turn)| *q -= turn);
        for reach in WIDTHS {
            if share * reach > allowed {
                continue;
            }
            match Window::of_width(system, &bare, [at - crank, share * reach], block) {
                Ok(window) => {
                    let error = window.error();
                    if best.as_ref().is_none_or(|(least, _)| error < *least) {
                        best = Some((error, window));
                    }
                }
                Err(error) => {
                    failed = Some(error);
                    allowed = allowed.smaller(CLEAR * share * reach);
                }
            }
        }
        system.twists = twists;
        place(system, from)?;
        match best {
            Some((error, mut window)) if error < WORST => {
                window.at += crank;
                for spot in &mut window.spots {
                    spot.angle += crank;
                    spot.q.iter_mut().zip(&turns).for_each(|(q, turn)| *q += turn);
                }
                window.turns = turns;
                let shares = window.spots.iter().map(|spot| spot.shares[block].abs());
                let (least, most) = shares.fold((f64::INFINITY, 0.0f64), |(a, b), s| (a.smaller(s), b.larger(s)));
                // The larger of two condition numbers is stored. The first number is about the inverse of the sine of
                // the innermost pose.
                // The second number follows from the error of the second derivatives.
                // The rounding errors of all blocks that are singular together add up, so the first condition number
                // grows with the number of these blocks.
                let inner = [&window.spots[SIDE - 1].shares, &window.spots[SIDE].shares];
                let singular = inner[0].iter().zip(inner[1]).filter(|(a, b)| *a * *b < 0.0).count().max(1);
                window.condition = (WEIGHTS * (singular as f64).cbrt() * most / least / window.reach)
                    .larger((error / (ULPS * f64::EPSILON)).cbrt());
                Ok(window)
            }
            _ => {
                let at = system.case.told(system.case.crank().from_coordinate(at));
                let why = failed.map_or(String::new(), |error| format!(" ({})", error.message()));
                let message = sentences::beside_this_change_point_the_branch(&at, &why);
                Err(Error::new(ErrorKind::Numeric, message).at_input(at).help(sentences::LET_THE_GRID_END_BEFORE))
            }
        }
    }

    fn of_width(system: &mut System, from: &Spot, [at, reach]: [f64; 2], block: usize) -> Result<Self> {
        let towards = (at - from.angle).signum();
        let distance = |k: usize| {
            let place = (PI * k as f64 / (SIDE - 1) as f64).cos();
            reach * (0.5 * (1.0 + CORE * CORE) + 0.5 * (1.0 - CORE * CORE) * place).sqrt()
        };
        let mut spots: Vec<Spot> = Vec::with_capacity(2 * SIDE);
        let mut spot = from.clone();
        for k in 0..SIDE {
            spot = followed(system, &spot, at - towards * distance(k))?;
            spots.push(spot.clone());
        }
        let near = Osculating::through(&chosen(&spots, at));
        for k in (0..SIDE).rev() {
            let angle = at + towards * distance(k);
            spot = match k == SIDE - 1 {
                true => {
                    let expected = near.at(angle - at);
                    let places: Vec<f64> = expected.iter().map(|jet| jet[0]).collect();
                    let found = settled(system, angle, &places)?;
                    let slopes: Vec<f64> = expected.iter().map(|jet| jet[1]).collect();
                    check_slopes(system, &found, &slopes)?;
                    found
                }
                false => followed(system, &spot, angle)?,
            };
            spots.push(spot.clone());
        }
        spots.sort_by(|a, b| a.angle.total_cmp(&b.angle));
        let at = crossing(&spots, block).unwrap_or(at);
        // No second change point may lie between the innermost poses: reactions have poles at both change points, but
        // the position of only one is known.
        let inner = [&spots[SIDE - 1], &spots[SIDE]];
        let passes = |block: &usize| inner[0].shares[*block] * inner[1].shares[*block] < 0.0;
        for other in (0..spots[0].shares.len()).filter(passes) {
            if !crossing(&spots, other).is_some_and(|own| (own - at).abs() < APART * CORE * reach) {
                return Err(system.lost(sentences::THERE_ARE_TWO_CHANGE_POINTS));
            }
        }
        let all: Vec<(f64, [&[f64]; 3])> = [&spots[..SIDE], &spots[SIDE..]]
            .iter()
            .flat_map(|half| {
                let is_low = half[0].angle < at;
                let of = |k: usize| if is_low { k } else { SIDE - 1 - k };
                CHOSEN.map(|k| point(&half[of(k)], at))
            })
            .collect();
        let coordinates = Osculating::through(&all);
        let places = spots.iter().map(|spot| spot.angle - at).collect();
        Ok(Window { at, reach, spots, places, turns: Vec::new(), coordinates, condition: f64::INFINITY })
    }

    /// Sets a spot to the pose at an angle. Signs and determinants come from the window's outermost pose on the same
    /// side of the change point.
    pub(super) fn put(&self, angle: f64, spot: &mut Spot) {
        spot.angle = angle;
        for (index, [q, slope, curve]) in self.coordinates.at(angle - self.at).into_iter().enumerate() {
            (spot.q[index], spot.slope[index], spot.curve[index]) = (q + self.turns[index], slope, curve);
        }
        spot.signs.clone_from(&self.end(angle).signs);
        spot.shares.clone_from(&self.end(angle).shares);
    }

    /// The window's outermost pose on the side of an angle.
    pub(super) fn end(&self, angle: f64) -> &Spot {
        if angle < self.at { &self.spots[0] } else { &self.spots[self.spots.len() - 1] }
    }

    /// Relative error: largest difference of the two polynomials for the second derivatives, divided by a scale.
    /// The scale is the largest first or second derivative, but at least 1.
    fn error(&self) -> f64 {
        let (mut most, mut scale) = (0.0f64, 1.0f64);
        for x in COMPARED.map(|share| share * self.reach) {
            for (index, [_, slope, curve]) in self.coordinates.at(x).into_iter().enumerate() {
                let other = neville(&self.places, |k| self.spots[k].curve[index], x);
                most = most.larger((curve - other).abs());
                scale = scale.larger(slope.abs()).larger(curve.abs());
            }
        }
        most / scale
    }
}

/// Whole turns (rad) in each coordinate that is an angle; 0 for positions.
fn whole_turns(q: &[f64]) -> Vec<f64> {
    q.iter().enumerate().map(|(index, q)| if index % 3 == 2 { TAU * (q / TAU).round() } else { 0.0 }).collect()
}

/// Follows the branch to an angle in small steps.
fn followed(system: &mut System, from: &Spot, to: f64) -> Result<Spot> {
    let parts = ((to - from.angle).abs() / TRACKING_STEP).ceil().larger(1.0);
    let mut spot = from.clone();
    for part in 1..=parts as usize {
        let next = if part as f64 == parts { to } else { from.angle + (to - from.angle) * (part as f64 / parts) };
        spot = walked(system, &spot, next)?;
    }
    Ok(spot)
}

/// Refuses a pose beyond a change point if its velocities differ from the expected velocities.
fn check_slopes(system: &System, found: &Spot, expected: &[f64]) -> Result<()> {
    let size = system.case.mechanism.size();
    let unit = |index: usize| if index % 3 == 2 { 1.0 } else { size };
    let largest = expected.iter().enumerate().fold(1.0f64, |most, (i, slope)| most.larger(slope.abs() / unit(i)));
    for (index, (slope, expected)) in found.slope.iter().zip(expected).enumerate() {
        if !((slope - expected).abs() <= 0.05 * largest * unit(index)) {
            return Err(system.lost(sentences::VELOCITIES_JUMP_THERE_CHANGE_POINT));
        }
    }
    Ok(())
}

fn point(spot: &Spot, at: f64) -> (f64, [&[f64]; 3]) {
    (spot.angle - at, [&spot.q, &spot.slope, &spot.curve])
}

/// The poses on one side of the change point that have the indices `CHOSEN`, the outermost first.
fn chosen(spots: &[Spot], at: f64) -> Vec<(f64, [&[f64]; 3])> {
    CHOSEN.iter().map(|&k| point(&spots[k], at)).collect()
}

/// The angle at which a block's determinant is zero, by inverse interpolation.
/// `None` if the determinant keeps its sign, or is not monotonic.
fn crossing(spots: &[Spot], block: usize) -> Option<f64> {
    let shares: Vec<f64> = spots.iter().map(|spot| spot.shares[block]).collect();
    let inner = SIDE / 2..2 * SIDE - SIDE / 2;
    let rising = shares[inner.clone()].windows(2).all(|pair| pair[0] < pair[1]);
    let falling = shares[inner.clone()].windows(2).all(|pair| pair[0] > pair[1]);
    let is_crossing = shares[inner.start] * shares[inner.end - 1] < 0.0 && (rising || falling);
    if !is_crossing {
        return None;
    }
    // The first estimate comes from inverse interpolation.
    // From this estimate, the secant method finds the zero of the polynomial through the determinants at all poses.
    let first = neville(&shares[inner.clone()], |k| spots[inner.start + k].angle, 0.0);
    let places: Vec<f64> = spots.iter().map(|spot| spot.angle - first).collect();
    let share = |x: f64| neville(&places, |k| shares[k], x);
    let (mut last, mut x) = (0.1 * places[inner.end - 1], 0.0);
    for _ in 0..SECANTS {
        let (a, b) = (share(last), share(x));
        if a == b {
            break;
        }
        (last, x) = (x, x - b * (x - last) / (b - a));
    }
    Some(first + x)
}

/// The value at `x` of a polynomial (Neville's scheme). At the position `places[k]` it has the value `value(k)`.
pub(super) fn neville(places: &[f64], value: impl Fn(usize) -> f64, x: f64) -> f64 {
    let mut row: Vec<f64> = (0..places.len()).map(value).collect();
    for level in 1..places.len() {
        for k in 0..places.len() - level {
            let (a, b) = (places[k], places[k + level]);
            row[k] = ((x - b) * row[k] - (x - a) * row[k + 1]) / (a - b);
        }
    }
    row[0]
}
