//! Checks of the given positions, for all kinds of precision points.

use crate::sentences;
use std::ops::RangeInclusive;

use crate::synthesize::wrong;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{Complex, KeepNan};

/// Numbers of positions for which closed forms exist.
const COUNTS: RangeInclusive<usize> = 3..=5;
/// Two positions coincide if neither their distance nor their difference in rotation is above this limit.
/// The distance is divided by the largest displacement; the difference in rotation is in rad.
const APART: f64 = 1e-9;

/// Checks the number of positions and that their numbers are finite.
///
/// # Errors
/// [`ErrorKind::Input`] with the reason.
pub(super) fn check_positions(key: &str, count: usize, numbers: impl IntoIterator<Item = f64>) -> Result<()> {
    if !COUNTS.contains(&count) {
        let message = sentences::found_so_many_positions(&count, &COUNTS.start(), &COUNTS.end());
        return Err(wrong(key, message, sentences::GIVE_THREE_TO_FIVE_POSITIONS));
    }
    if !numbers.into_iter().all(f64::is_finite) {
        return Err(wrong(key, sentences::A_COORDINATE_OR_AN_ANGLE.into(), sentences::GIVE_DECIMAL_NUMBERS));
    }
    Ok(())
}

/// Checks that no two positions coincide. A position is a point (m), a rotation, or both.
///
/// # Errors
/// [`ErrorKind::Input`] if two positions coincide. The error names the first two such positions.
pub(super) fn check_apart(key: &str, points: &[Complex], turns: &[Complex]) -> Result<()> {
    let size = points.iter().map(|point| (point - points[0]).norm()).fold(0.0, f64::larger);
    let is_same = |i: usize, j: usize| {
        let way = points.get(i).zip(points.get(j)).map_or(0.0, |(a, b)| (a - b).norm());
        let turn = turns.get(i).zip(turns.get(j)).map_or(0.0, |(a, b)| (a - b).norm());
        way <= APART * size && turn <= APART
    };
    let count = points.len().max(turns.len());
    let pair = (0..count).flat_map(|j| (0..j).map(move |i| (i, j))).find(|&(i, j)| is_same(i, j));
    pair.map_or(Ok(()), |(i, j)| {
        let message = sentences::positions_coincide(&(i + 1), &(j + 1));
        Err(wrong(key, message, sentences::LEAVE_ONE_OF_THE_POSITIONS_OUT))
    })
}

/// The error for positions that determine no dyad.
pub(super) fn no_dyad(message: &str, help: &str) -> Error {
    Error::new(ErrorKind::Geometry, message.to_string()).help(help.to_string())
}

/// Rotations from the first angle to every angle (rad).
pub(super) fn turns_from_first(angles: impl Iterator<Item = f64> + Clone) -> Vec<Complex> {
    let first = angles.clone().next().unwrap_or_default();
    angles.map(|angle| Complex::from_polar(1.0, angle - first)).collect()
}

/// Displacements from the first point to every point (m).
pub(super) fn ways_from_first(points: &[Complex]) -> Vec<Complex> {
    points.iter().map(|point| point - points[0]).collect()
}
