//! Extremes along the curve of poses: angles of links, determinants, condition numbers.
//!
//! At an extreme position of a link, the link's component of the tangent has a simple zero.
//! This component, and thus the link's angular velocity, changes sign at the extreme position.

use linkage::math::KeepNan;
use linkage::mechanism::{GroupId, LinkId};
use std::f64::consts::TAU;

use super::constraints::Constraints;
use super::singularity::{Singularity, SingularityKind, ValueAtCrank};
use super::tracking::{Point, Tracker};

/// A link counts as at rest if its tangent component, times the square of the Jacobian's smallest singular value, is at
/// most this value. The component is then rounding error.
/// The error of a pose is the rounding error divided by the singular value.
/// The error of the tangent is the error of the pose, divided by the singular value a second time.
const STILL: f64 = 50.0 * f64::EPSILON;

/// Extreme position of a link: its angular velocity changes sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExtremePosition {
    /// Crank angle (rad, in the scenario's convention), accurate to 1e-9 rad.
    pub crank: f64,
    /// Angle of the link (rad).
    pub angle: f64,
    /// Whether the angle has a maximum at this position; otherwise it has a minimum.
    pub is_greatest: bool,
}

/// Range of rotation of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkRange {
    /// The link.
    pub link: LinkId,
    /// Smallest and greatest angle of the link, each with its crank angle (rad).
    /// The angles of the link are continuous from the start pose: whole turns are not removed.
    pub angles: [ValueAtCrank; 2],
    /// Whole turns of the link until the mechanism is back at its first pose.
    /// For a crank that turns counter-clockwise, the number is positive if the link also turns counter-clockwise.
    /// The number is 0 for a link that rocks, or if the crank cannot turn fully.
    pub turns: i32,
    /// Extreme positions in ascending order of the crank angle.
    pub extremes: Vec<ExtremePosition>,
}

/// Ranges of all moving links.
pub(super) fn links(tracker: &Tracker, points: &[Point], closed: bool, count: usize) -> Vec<LinkRange> {
    (1..count).map(|link| of_link(tracker, points, closed, LinkId(link))).collect()
}

fn of_link(tracker: &Tracker, points: &[Point], closed: bool, link: LinkId) -> LinkRange {
    let angle = Constraints::angle(link);
    let rate = |point: &Point| point.tangent[angle];
    let at = |point: &Point| ValueAtCrank { crank: tracker.crank_of(&point.q), value: point.q[angle] };
    let mut extremes: Vec<ExtremePosition> = Vec::new();
    let mut add = |point: &Point, is_greatest: bool| {
        extremes.push(ExtremePosition { crank: tracker.crank_of(&point.q), angle: point.q[angle], is_greatest });
    };
    // Indices of the poses in which the link turns. If the link turns in opposite senses in two successive poses of
    // this list, there is one extreme between the two poses.
    let moving: Vec<usize> =
        (0..points.len()).filter(|&k| rate(&points[k]).abs() * points[k].sigma.powi(2) > STILL).collect();
    for pair in moving.windows(2) {
        let (a, b) = (&points[pair[0]], &points[pair[1]]);
        if rate(a) * rate(b) < 0.0 {
            match pair[1] - pair[0] {
                1 => add(&tracker.zero(a, b, rate), rate(a) > 0.0),
                _ => add(&points[(pair[0] + pair[1]) / 2], rate(a) > 0.0),
            }
        }
    }
    let last = points.len() - 1;
    // The start of a closed curve is both the first and the last pose. The loop above does not compare the last pose of
    // the list with the first, so an extreme position at the start is added separately.
    if let (true, Some(&first), Some(&end)) = (closed, moving.first(), moving.last())
        && first > 0
        && rate(&points[first]) * rate(&points[end]) < 0.0
    {
        add(&points[0], rate(&points[end]) > 0.0);
    }
    extremes.sort_by(|a, b| a.crank.total_cmp(&b.crank));
    let ends = extremes.iter().map(|extreme| ValueAtCrank { crank: extreme.crank, value: extreme.angle });
    let all: Vec<ValueAtCrank> = [at(&points[0]), at(&points[last])].into_iter().chain(ends).collect();
    let by_value = |a: &&ValueAtCrank, b: &&ValueAtCrank| a.value.total_cmp(&b.value);
    let least = all.iter().min_by(by_value).copied().unwrap_or(all[0]);
    let most = all.iter().max_by(by_value).copied().unwrap_or(all[0]);
    let turns = if closed { ((points[last].q[angle] - points[0].q[angle]) / TAU).round() as i32 } else { 0 };
    LinkRange { link, angles: [least, most], turns, extremes }
}

/// The pose with the smallest value of `f`, which is smooth along the curve.
pub(super) fn least(tracker: &Tracker, points: &[Point], closed: bool, f: &dyn Fn(&Point) -> f64) -> Point {
    let values: Vec<f64> = points.iter().map(f).collect();
    let place = (0..values.len()).min_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap_or(0);
    refined(tracker, points, closed, place, f)
}

/// The local minimum of `f` next to the pose with the index `place`.
fn refined(tracker: &Tracker, points: &[Point], closed: bool, place: usize, f: &dyn Fn(&Point) -> f64) -> Point {
    let slope = |point: &Point| {
        let step = (0.01 * point.sigma).smaller(1e-4);
        match (tracker.advance(point, step), tracker.advance(point, -step)) {
            (Some(ahead), Some(behind)) => f(&ahead) - f(&behind),
            _ => 0.0,
        }
    };
    let here = &points[place];
    let last = points.len() - 1;
    let falls = slope(here);
    let (a, b) = if falls < 0.0 {
        let next = if closed && place == last { 0 } else { place };
        (&points[next], points.get(next + 1))
    } else {
        let end = if closed && place == 0 { last } else { place };
        (points.get(end.wrapping_sub(1)).unwrap_or(here), Some(&points[end]))
    };
    match b {
        Some(b) if slope(a) * slope(b) < 0.0 => {
            let found = tracker.zero(a, b, slope);
            if f(&found) <= f(here) { found } else { here.clone() }
        }
        _ => here.clone(),
    }
}

/// Poses in which the magnitude of a group's determinant has a minimum below `bound` but above zero.
pub(super) fn contacts(tracker: &Tracker, points: &[Point], closed: bool, bound: f64) -> Vec<Singularity> {
    let last = points.len() - 1;
    let groups = points[0].measures.len();
    let mut found = Vec::new();
    for group in 0..groups {
        let size = |point: &Point| point.measures[group].determinant.abs();
        let range = if closed { 0..last } else { 1..last };
        for place in range {
            let before = size(&points[if place == 0 { last - 1 } else { place - 1 }]);
            let (here, after) = (size(&points[place]), size(&points[place + 1]));
            // This sample is near a deep minimum. The position of the minimum itself is computed below.
            if here < before && here <= after && here < 10.0 * bound {
                let lowest = refined(tracker, points, closed, place, &size);
                let contact = Singularity {
                    kind: SingularityKind::BranchContact,
                    crank: tracker.crank_of(&lowest.q),
                    group: GroupId(group),
                    determinant: lowest.measures[group].determinant,
                };
                if contact.determinant.abs() < bound {
                    found.push(contact);
                }
            }
        }
    }
    found
}
