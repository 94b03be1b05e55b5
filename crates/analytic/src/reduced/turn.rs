//! A crank that turns fully, and the crank angles at which links reverse.
//!
//! To find that the crank turns fully, it is enough to place the mechanism during one period. The pose solver itself
//! refuses dead points and change points.
//! The limits of cranks that do not turn fully come from the [range of motion](crate::range).
//! The analysis of the range of motion costs many times as much as one whole turn of poses.

use std::f64::consts::TAU;

use crate::PoseSolver;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::root;
use linkage::mechanism::{LinkId, PerLink};
use linkage::trajectory::Stage;

/// Number of poses in one turn of the crank. The poses are three degrees apart.
/// Even two reversals between neighbouring poses are detected, from the slopes of the angular velocity.
const POSES: u32 = 120;
/// The search for a return to the first pose ends after this number of turns of the crank. The analysis of the range of
/// motion uses the same limit, except for mechanisms with transmissions.
const MOST_TURNS: u32 = 12;
/// If the crank turns at 1 rad/s and a link turns more slowly than this (rad/s), the link's angular velocity is
/// rounding error.
const STILL: f64 = 1e-11;
/// Newton's method ends if its step (rad) is at most this value. The method converges quadratically.
const SETTLED: f64 = 1e-9;
/// Largest number of times that an interval between two poses is halved. An interval is halved if a link slows down and
/// speeds up again in it.
const HALVINGS: u32 = 20;

/// A crank that turns fully.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FullTurn {
    /// Turns of the crank after which the mechanism is back at its first pose.
    pub(super) turns: u32,
    /// Crank angles (rad) at which one of the requested links reverses, from the start until the mechanism is back at
    /// its first pose.
    pub(super) reversals: Vec<f64>,
}

/// Angular velocity of a link at a crank angle if the crank turns at 1 rad/s, and the derivative of this velocity with
/// respect to the crank angle.
#[derive(Clone, Copy, Debug)]
struct Rate {
    crank: f64,
    omega: f64,
    slope: f64,
}

impl FullTurn {
    /// Turns the crank of a case from its start until the mechanism is back at its first pose.
    /// `None` if the mechanism does not come back, or if its return is uncertain.
    pub(super) fn of(case: &Case, links: &[LinkId]) -> Option<Self> {
        if case.crank().through {
            return None;
        }
        Self::turned(case, links).ok().flatten()
    }

    fn turned(case: &Case, links: &[LinkId]) -> Result<Option<Self>> {
        let (mut poses, start) = (PoseSolver::new(case)?, case.crank().start);
        let deepest = if links.is_empty() { Stage::Positions } else { Stage::Accelerations };
        let mut rates: Vec<Vec<Rate>> = vec![Vec::new(); links.len()];
        let mut begun = PerLink::default();
        for pose in 0..=MOST_TURNS * POSES {
            let crank = start + TAU * (f64::from(pose) / f64::from(POSES));
            let state = poses.solve(crank, 1.0, 0.0, deepest)?;
            for (all, &link) in rates.iter_mut().zip(links) {
                all.push(Rate { crank, omega: state.motions[link].omega, slope: state.motions[link].alpha });
            }
            if pose == 0 {
                begun.clone_from(&state.motions);
            } else if pose % POSES == 0 && poses.is_at(&begun) {
                let turns = pose / POSES;
                let mut reversals = Vec::new();
                for (all, &link) in rates.iter().zip(links) {
                    reversals_of(&mut poses, link, all, TAU * f64::from(turns), &mut reversals)?;
                }
                return Ok(Some(FullTurn { turns, reversals }));
            }
        }
        Ok(None)
    }
}

/// Adds the crank angles at which a link reverses in a whole period, from the link's angular velocities at the poses of
/// this period.
fn reversals_of(
    poses: &mut PoseSolver,
    link: LinkId,
    rates: &[Rate],
    period: f64,
    reversals: &mut Vec<f64>,
) -> Result<()> {
    let moving = || rates.iter().filter(|rate| rate.omega.abs() > STILL);
    // If the link is at rest at the start, one interval contains the start.
    // This interval begins at the last pose of a period and ends at the first pose of the next period.
    let is_still = rates.first().is_some_and(|rate| !(rate.omega.abs() > STILL));
    let next = moving().next().filter(|_| is_still).map(|first| Rate { crank: first.crank + period, ..*first });
    let all: Vec<Rate> = moving().copied().chain(next).collect();
    for pair in all.windows(2) {
        between(poses, link, [pair[0], pair[1]], HALVINGS, reversals)?;
    }
    Ok(())
}

/// Adds the crank angles at which a link reverses, between two poses at which it turns.
fn between(
    poses: &mut PoseSolver,
    link: LinkId,
    [a, b]: [Rate; 2],
    halvings: u32,
    reversals: &mut Vec<f64>,
) -> Result<()> {
    let mut rate = |crank: f64| -> Result<Rate> {
        let motion = &poses.solve(crank, 1.0, 0.0, Stage::Accelerations)?.motions[link];
        Ok(Rate { crank, omega: motion.omega, slope: motion.alpha })
    };
    if a.omega * b.omega < 0.0 {
        let first = a.crank + (b.crank - a.crank) * (a.omega / (a.omega - b.omega));
        let found = root::newton([a.crank, b.crank], b.omega > 0.0, first, SETTLED, |crank| {
            rate(crank).map(|rate| (rate.omega, rate.slope))
        })?;
        reversals.extend(found);
        return Ok(());
    }
    // The tangents touch the curve of the angular velocity at the two ends of the interval. The angular velocity has
    // the same sign at both ends.
    // The link can have reversed twice only if the tangents intersect at zero or at an angular velocity of opposite
    // sign.
    // Otherwise the interval is not halved.
    let at = (b.omega - a.omega + a.slope * a.crank - b.slope * b.crank) / (a.slope - b.slope);
    let is_dip = a.omega * a.slope < 0.0 && b.omega * b.slope > 0.0;
    if halvings > 0 && is_dip && (a.omega + a.slope * (at - a.crank)) * a.omega <= 0.0 {
        let middle = rate(f64::midpoint(a.crank, b.crank))?;
        between(poses, link, [a, middle], halvings - 1, reversals)?;
        between(poses, link, [middle, b], halvings - 1, reversals)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::range::{Extent, Range};
    use fixtures::{four_bar, turning};

    #[test]
    fn reversals_match_the_range_of_motion() {
        let case = turning(four_bar());
        let links: Vec<LinkId> = case.mechanism.links().ids().skip(1).collect();
        let found = FullTurn::of(&case, &links).unwrap();
        let range = Range::of(&case).unwrap();
        assert_eq!(range.extent, Extent::FullTurn(found.turns as i32));
        let mut expected: Vec<f64> = range.links.iter().flat_map(|link| &link.extremes).map(|at| at.crank).collect();
        let mut cranks: Vec<f64> = found.reversals.iter().map(|crank| crank.rem_euclid(TAU)).collect();
        expected.iter_mut().for_each(|crank| *crank = crank.rem_euclid(TAU));
        expected.sort_by(f64::total_cmp);
        cranks.sort_by(f64::total_cmp);
        assert_eq!(cranks.len(), expected.len());
        assert!(!cranks.is_empty());
        for (a, b) in cranks.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-8, "{a} {b}");
        }
    }
}
