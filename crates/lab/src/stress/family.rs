//! A family varies one parameter (`dial`). Solvers and engines run at each value of this parameter.
//! See docs/numerics/laboratory.md.

use linkage::case::Case;
use linkage::error::Result;

/// Use of the engines at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EngineUse {
    /// Only the analytic sides run, not the engines.
    None,
    /// A search finds the engines' settings. The number is the work allowed for the search.
    /// The unit is the work of one engine step without sweeps.
    Found(f64),
    /// Engines run at this step (s) and number of sweeps.
    Given {
        /// Time step (s).
        step: f64,
        /// Sweeps of the iteration.
        sweeps: usize,
    },
}

/// A case, and the solvers and engines that run on it.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The case.
    pub case: Case,
    /// Use of the engines.
    pub engines: EngineUse,
    /// Whether the analytic sides are compared with a double-double reference.
    pub precise: bool,
}

impl Setup {
    /// The usual setup: a search finds the engines' settings, and the analytic sides are compared with a double-double
    /// reference.
    pub(super) fn usual(case: Case) -> Setup {
        Setup { case, engines: EngineUse::Found(WORK), precise: true }
    }
}

/// Work allowed for an engine's search for settings at one point. The unit is the work of one step without sweeps.
/// This limit is a hundredth of the work allowed for a proof.
pub const WORK: f64 = 2e5;

/// A family: mechanisms or settings with one varied parameter.
#[derive(Debug)]
pub struct StressFamily {
    /// Name, as on the command line and in files.
    pub name: &'static str,
    /// Meaning of the varied parameter, with its unit.
    pub dial: &'static str,
    /// Description of the family, in a sentence.
    pub title: &'static str,
    /// Values of the varied parameter, in ascending order.
    pub points: &'static [f64],
    /// The values of a quick run.
    pub quick: &'static [f64],
    /// Number of mechanisms at each value of the varied parameter. Only random mechanisms have more than one.
    pub samples: u64,
    /// The case and settings at a value of the varied parameter. Sample number and seed affect only random mechanisms.
    pub setup: fn(dial: f64, sample: u64, seed: u64) -> Result<Setup>,
}
