//! Chooses the best of many four-bars.

use crate::sentences;
use std::cmp::Ordering;

use super::four_bar::{FourBarChecks, GivenFrames, GroundLink, PrecisionFourBar};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{Complex, KeepNan};

/// A four-bar whose longest length is more than this many times its shortest length is hard to build.
const MOST_RATIO: f64 = 10.0;
/// If free rotations are scanned on a grid, two four-bars count as similar if their joints are closer than this
/// fraction of the longest length.
const SIMILAR: f64 = 0.05;
/// Two four-bars count as the same if their joints are closer than this fraction of the longest length.
const SAME: f64 = 1e-6;

/// Four-bars through precision points.
#[derive(Clone, Debug, PartialEq)]
pub struct PrecisionSynthesis {
    /// The best four-bars, the best first.
    ///
    /// The criteria, in decreasing priority: the four-bar keeps one assembly mode; it also keeps the order of the
    /// positions; its length ratio is below 10; its crank turns fully; its smallest transmission angle is large.
    pub best: Vec<PrecisionFourBar>,
    /// Number of four-bars that pass all positions.
    pub found: usize,
    /// Number of four-bars that reach all positions in one assembly mode.
    pub keep_branch: usize,
    /// Number of four-bars that pass the positions in one assembly mode and in their order.
    pub keep_order: usize,
    /// Number of four-bars that pass the positions in one assembly mode and in their order, and whose crank turns
    /// fully.
    pub turn_fully: usize,
    /// Whether free rotations were scanned on a grid. If they were, no two four-bars of `best` are similar.
    pub is_scanned: bool,
}

/// Collects four-bars and keeps the best.
pub(super) struct Choice {
    given: GivenFrames,
    wanted: usize,
    all: PrecisionSynthesis,
}

impl Choice {
    pub(super) fn new(given: GivenFrames, wanted: usize, is_scanned: bool) -> Self {
        let none =
            PrecisionSynthesis { best: Vec::new(), found: 0, keep_branch: 0, keep_order: 0, turn_fully: 0, is_scanned };
        Choice { given, wanted, all: none }
    }

    /// Checks the four-bar of a crank and a rocker, and keeps the four-bar if it is one of the best.
    pub(super) fn offer(&mut self, links: [&GroundLink; 2]) {
        let Some(checks) = FourBarChecks::of(links, self.given.point) else { return };
        let all = &mut self.all;
        all.found += 1;
        all.keep_branch += usize::from(checks.keeps_branch);
        all.keep_order += usize::from(checks.keeps_branch && checks.keeps_order);
        all.turn_fully += usize::from(checks.keeps_branch && checks.keeps_order && checks.turns_fully());
        let is_better = |own: &PrecisionFourBar| compare(&checks, &own.checks) == Ordering::Less;
        if all.best.len() == self.wanted && !all.best.last().is_some_and(is_better) {
            return;
        }
        let found = PrecisionFourBar::of(links, &self.given, checks);
        let near = if all.is_scanned { SIMILAR } else { SAME };
        let place = all.best.iter().position(is_better).unwrap_or(all.best.len());
        if all.best[..place].iter().any(|own| are_near(own, &found, near)) {
            return;
        }
        all.best.insert(place, found);
        let (better, worse) = all.best.split_at(place + 1);
        let own = &better[place];
        let kept: Vec<PrecisionFourBar> = worse.iter().filter(|other| !are_near(own, other, near)).cloned().collect();
        all.best.truncate(place + 1);
        all.best.extend(kept);
        all.best.truncate(self.wanted);
    }

    /// The best four-bars.
    ///
    /// # Errors
    /// [`ErrorKind::Geometry`] if no four-bar was offered.
    pub(super) fn best(self) -> Result<PrecisionSynthesis> {
        if self.all.best.is_empty() {
            let message = sentences::NO_FOUR_BAR_PASSES_THE_POSITIONS;
            return Err(Error::new(ErrorKind::Geometry, message).help(sentences::MOVE_A_POSITION_OR_LEAVE_ONE_OUT));
        }
        Ok(self.all)
    }
}

/// Orders four-bars: the better four-bar is `Less`.
fn compare(a: &FourBarChecks, b: &FourBarChecks) -> Ordering {
    let merits = |own: &FourBarChecks| {
        [own.keeps_branch, own.keeps_branch && own.keeps_order, own.ratio < MOST_RATIO, own.turns_fully()]
    };
    merits(b).cmp(&merits(a)).then(b.transmission.total_cmp(&a.transmission))
}

/// Whether, in position 1, each joint of a four-bar is close to the same joint of another four-bar.
fn are_near(a: &PrecisionFourBar, b: &PrecisionFourBar, share: f64) -> bool {
    let size = a.checks.lengths.into_iter().fold(0.0, f64::larger);
    let joints = |own: &PrecisionFourBar| -> [Complex; 4] {
        let ([o, c], [a, b]) = (own.pivots, own.pins);
        [o, c, a, b]
    };
    joints(a).iter().zip(joints(b)).all(|(a, b)| (a - b).norm() <= share * size)
}
