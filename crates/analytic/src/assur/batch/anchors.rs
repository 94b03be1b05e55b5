//! Anchors: poses of the mechanism from which the solution of a batch starts.
//!
//! Newton's method needs an approximate pose near the solution, on the branch of the start pose.
//! Anchors lie every two degrees of the crank, beginning at the start pose, in both directions.
//! Anchors are solved in sequence away from the start pose, so that they do not depend on the requested crank angles.
//! Between two anchors, the angle of each link is a polynomial of degree five.
//! The polynomial fits the angle and its first and second transfer functions at both anchors.
//! The interpolation error grows with the sixth power of the distance between the anchors.

use super::chains::OF_START;
use super::groups::Groups;
use super::lanes::TILE;
use crate::PoseSolver;
use crate::assur::turns::FOLLOWED_STEP;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::{Vec2, cross};
use linkage::mechanism::LinkId;
use linkage::trajectory::Stage;

/// Number of values stored per link and interval: one fewer than `OF_START`.
/// The missing value is the fraction of the interval at which a pose lies; it differs from pose to pose.
const KEPT: usize = OF_START - 1;
/// Distance between two anchors (rad). The distance is slightly smaller than the longest step of [`PoseSolver`], so
/// that a rounded distance never exceeds this step.
const STEP: f64 = FOLLOWED_STEP * (1.0 - 1e-9);
/// Largest number of intervals in one direction, about 278 turns. Poses farther away are solved one by one.
const MOST: usize = 50_000;

/// The anchors of a case in both directions of its crank.
#[derive(Debug)]
pub(super) struct Anchors<'a> {
    start: f64,
    ways: [Way<'a>; 2],
}

/// The anchors in one direction of the crank.
#[derive(Debug)]
struct Way<'a> {
    poses: PoseSolver<'a>,
    /// Distance between two anchors (rad), with its sign.
    step: f64,
    links: Vec<LinkId>,
    /// Direction of each of these links at the outermost anchor, with its first and second transfer functions.
    last: Vec<(Vec2, [f64; 2])>,
    intervals: Vec<f64>,
    count: usize,
    is_open: bool,
}

impl<'a> Anchors<'a> {
    /// Returns the anchors for the higher groups of a case; `None` if it has no higher group.
    ///
    /// # Errors
    /// The errors of [`PoseSolver::new`] and [`PoseSolver::solve`].
    pub(super) fn of(case: &'a Case, groups: &Groups) -> Result<Option<Self>> {
        let links: Vec<LinkId> = groups.chains().flat_map(|(chain, _)| chain.links().to_vec()).collect();
        if links.is_empty() {
            return Ok(None);
        }
        let way = |step: f64| -> Result<Way<'a>> {
            let (poses, links, last) = (PoseSolver::new(case)?, links.clone(), Vec::with_capacity(links.len()));
            let mut way = Way { poses, step, links, last, intervals: Vec::new(), count: 0, is_open: true };
            way.poses.solve(case.crank().start, 1.0, 0.0, Stage::Accelerations)?;
            way.last = way.read();
            Ok(way)
        };
        Ok(Some(Anchors { start: case.crank().start, ways: [way(STEP)?, way(-STEP)?] }))
    }

    /// Writes the starting values for the rows of a tile to the working memory; NaN if the interval of a row is not
    /// known.
    pub(super) fn fill(&mut self, cranks: &[f64], groups: &Groups, work: &mut [f64]) {
        for (row, crank) in cranks.iter().enumerate() {
            let way = &mut self.ways[usize::from(*crank < self.start)];
            let place = (crank - self.start) / way.step;
            // An infinite `place` lies beyond every interval.
            // A NaN `place` selects the first interval, and the fraction of this interval becomes NaN.
            let interval = place as usize;
            let is_known = way.reach(self.start, interval);
            let kept = way.intervals.chunks_exact(KEPT * way.links.len()).nth(interval).filter(|_| is_known);
            let mut of_links = kept.map(|kept| kept.chunks_exact(KEPT));
            for (chain, first) in groups.chains() {
                for index in 0..chain.links().len() {
                    let columns = &mut work[(first + OF_START * index) * TILE..][..OF_START * TILE];
                    let columns = columns.chunks_exact_mut(TILE).map(|column| &mut column[row]);
                    let Some(kept) = of_links.as_mut().and_then(Iterator::next) else {
                        columns.for_each(|value| *value = f64::NAN);
                        continue;
                    };
                    let fraction = place - interval as f64;
                    let values = [kept[0], kept[1], fraction].into_iter().chain(kept[2..].iter().copied());
                    columns.zip(values).for_each(|(column, value)| *column = value);
                }
            }
        }
    }
}

impl Way<'_> {
    /// Adds anchors until the interval `interval` is known. Returns `false` if this is impossible.
    fn reach(&mut self, start: f64, interval: usize) -> bool {
        if interval >= MOST {
            return false;
        }
        while self.is_open && self.count <= interval {
            let next = start + self.step * (self.count + 1) as f64;
            // No error is reported here: the solution of the pose that needs this interval reports the error.
            self.is_open = self.poses.solve(next, 1.0, 0.0, Stage::Accelerations).is_ok();
            if self.is_open {
                self.add();
            }
        }
        interval < self.count
    }

    /// Returns the direction and the transfer functions of every link.
    fn read(&self) -> Vec<(Vec2, [f64; 2])> {
        let motions = &self.poses.state.motions;
        self.links.iter().map(|&link| (motions[link].direction, [motions[link].omega, motions[link].alpha])).collect()
    }

    /// Stores the interval from the last anchor to the present anchor.
    fn add(&mut self) {
        let next = self.read();
        for ((from, [omega, alpha]), (to, [omega_to, alpha_to])) in self.last.iter().zip(&next) {
            let turn = cross(*from, *to).atan2(from.dot(to));
            let (h, h2) = (self.step, self.step * self.step);
            let (first, second) = (h * omega, 0.5 * h2 * alpha);
            // Angle, rate and second derivative at the end of the interval, minus the linear and quadratic terms of the
            // polynomial.
            let angle = turn - first - second;
            let rate = h * omega_to - first - 2.0 * second;
            let bend = h2 * alpha_to - 2.0 * second;
            let third = 10.0 * angle - 4.0 * rate + 0.5 * bend;
            let fourth = -15.0 * angle + 7.0 * rate - bend;
            let fifth = 6.0 * angle - 3.0 * rate + 0.5 * bend;
            self.intervals.extend([from.x, from.y, first, second, third, fourth, fifth]);
        }
        self.last = next;
        self.count += 1;
    }
}
