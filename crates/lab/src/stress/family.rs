//! A family: its dial, and what runs at a point of it.
//! See docs/numerics/laboratory.md.

use linkage::case::Case;
use linkage::error::Result;

/// What engines do at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EngineUse {
    /// None runs: the analytic sides alone.
    None,
    /// They find their settings with this work, in steps without sweeps.
    Found(f64),
    /// They run at this step (s) and number of sweeps.
    Given {
        /// Time step (s).
        step: f64,
        /// Sweeps of the iteration.
        sweeps: usize,
    },
}

/// A case and what runs on it.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The case.
    pub case: Case,
    /// What engines do.
    pub engines: EngineUse,
    /// Whether the sides are held against numbers in double-double.
    pub precise: bool,
}

impl Setup {
    /// A case that engines find their own settings for, with numbers in double-double beside it.
    pub(super) fn usual(case: Case) -> Setup {
        Setup { case, engines: EngineUse::Found(WORK), precise: true }
    }
}

/// Work of an engine that finds its settings at one point, in steps without sweeps: a hundredth of a proof's.
pub const WORK: f64 = 2e5;

/// A family: one dial.
#[derive(Debug)]
pub struct StressFamily {
    /// Name, as on the command line and in files.
    pub name: &'static str,
    /// What the dial turns, with its unit.
    pub dial: &'static str,
    /// What the family is, in a sentence.
    pub title: &'static str,
    /// Values of the dial, in ascending order.
    pub points: &'static [f64],
    /// The values of a quick run.
    pub quick: &'static [f64],
    /// Number of mechanisms at each value; more than one only where they are drawn at random.
    pub samples: u64,
    /// The case and settings at a value of the dial; the number of the sample and the seed count for random ones.
    pub setup: fn(dial: f64, sample: u64, seed: u64) -> Result<Setup>,
}
