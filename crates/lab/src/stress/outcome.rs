//! What came of a point.

linkage::words! {
    /// Quantities that a map shows together.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Group: name {
        /// Positions and angles.
        Positions = "positions",
        /// Velocities and accelerations.
        Rates = "rates",
        /// Reactions and balancing moment.
        Forces = "forces",
    }
}

/// The worst channel of a group.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    /// The group.
    pub group: Group,
    /// Largest error, as a share of the channel's scale: half its range over the run.
    pub error: f64,
    /// Bound of that channel, as the same share.
    pub bound: f64,
    /// The channel.
    pub channel: String,
    /// Largest error over bound of any channel of the group.
    pub used: f64,
}

/// One solver or engine at a point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Party {
    /// Its name.
    pub name: String,
    /// What its errors are against, in words; empty if it has none.
    pub against: String,
    /// Groups of channels, in order; none if it failed.
    pub reached: Vec<Reached>,
    /// Largest opening of a joint over the mechanism's size.
    pub closure: Option<f64>,
    /// Balancing moment from reactions less that from powers, over the moments in the balance.
    pub balance: Option<f64>,
    /// `agree`, `disagree`, `inconclusive`, or `fails`.
    pub verdict: String,
    /// Reason of a verdict other than agreement.
    pub why: String,
    /// Step (s) of the run that is judged.
    pub step: Option<f64>,
    /// Its sweeps.
    pub sweeps: Option<usize>,
    /// Its extrapolations.
    pub extrapolated: Option<usize>,
    /// Steps over the duration of the grid.
    pub steps: Option<f64>,
    /// Runs of its search for settings.
    pub runs: Option<usize>,
    /// Work of that search, in steps without sweeps.
    pub work: Option<f64>,
    /// What was counted, in the order of [`Count::ALL`](linkage::work::Count::ALL): a side's run, all runs of an engine.
    pub done: Vec<(String, u64)>,
    /// Channels beyond their bound although the verdict agrees: wrong numbers that nobody is told of.
    pub silent: usize,
}

impl Party {
    /// One that has no numbers, with the reason.
    pub(super) fn failed(name: &str, why: &str) -> Party {
        Party { name: name.into(), verdict: "fails".into(), why: why.into(), ..Party::default() }
    }
}

/// A point, done.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Value of the dial.
    pub dial: f64,
    /// Number of the sample.
    pub sample: u64,
    /// Identifies the program, the family's inputs and the case: a result with another key is made anew.
    pub key: String,
    /// Why there is no case, if there is none.
    pub refused: String,
    /// The sides and engines.
    pub parties: Vec<Party>,
}

/// A number as it is kept: four digits, so that it is read back as it was written. NaN stays NaN.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
