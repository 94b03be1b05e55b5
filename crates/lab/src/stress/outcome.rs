//! Outcome of a point, in the words and the order of its JSON form.
//! Numbers that are not finite are `null` in JSON and are read back as infinite.

use serde::{Deserialize, Deserializer, Serialize};

linkage::words! {
    /// Quantities that a map shows together.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum QuantityGroup: name {
        /// Positions and angles.
        Positions = "positions",
        /// Velocities and accelerations.
        Rates = "rates",
        /// Reactions and balancing moment.
        Forces = "forces",
    }
}

linkage::words! {
    /// Outcome of a solver or an engine at a point, the best first.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum PointEnd: word {
        /// It agrees.
        Agree = "agree",
        /// The proof decides nothing.
        Inconclusive = "inconclusive",
        /// It disagrees.
        Disagree = "disagree",
        /// It has no numbers.
        #[default]
        Fails = "fails",
    }
}

/// The worst channel of a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorstOfGroup {
    /// The group.
    pub group: QuantityGroup,
    /// Largest error, as a share of the channel's scale: half its range over the run.
    #[serde(deserialize_with = "number")]
    pub error: f64,
    /// Bound of that channel, as the same share.
    #[serde(deserialize_with = "number")]
    pub bound: f64,
    /// The channel.
    pub channel: String,
    /// Largest ratio of error to bound over the channels of the group.
    #[serde(deserialize_with = "number")]
    pub used: f64,
}

fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
}

/// One solver or engine at a point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PartyAtPoint {
    /// Name.
    pub name: String,
    /// How it ends.
    pub verdict: PointEnd,
    /// Reason of a verdict other than agreement.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub why: String,
    /// Reference of its errors, in words; empty if it has no errors.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub against: String,
    /// Groups of channels, in order; empty if it failed.
    #[serde(rename = "groups")]
    pub reached: Vec<WorstOfGroup>,
    /// Largest opening of a joint, divided by the mechanism's size.
    pub closure: Option<f64>,
    /// Balancing moment from reactions minus that from powers, divided by the moments in the balance.
    pub balance: Option<f64>,
    /// Step (s) of the run that is judged.
    #[serde(rename = "step_s")]
    pub step: Option<f64>,
    /// Its sweeps.
    pub sweeps: Option<usize>,
    /// Its extrapolations.
    pub extrapolated: Option<usize>,
    /// Number of steps for the duration of the grid.
    pub steps: Option<f64>,
    /// Runs of its search for settings.
    pub runs: Option<usize>,
    /// Work of that search, in steps without sweeps.
    pub work: Option<f64>,
    /// Counted operations, in the order of [`Count::ALL`](linkage::work::Count::ALL): a side's run, all runs of an
    /// engine.
    #[serde(default)]
    pub done: Vec<(String, u64)>,
    /// Channels beyond their bound although the verdict agrees: wrong numbers without a warning.
    pub silent: usize,
}

impl PartyAtPoint {
    /// A solver or engine without numbers, with the reason.
    pub(super) fn failed(name: &str, why: &str) -> PartyAtPoint {
        PartyAtPoint { name: name.into(), why: why.into(), ..PartyAtPoint::default() }
    }
}

/// A point, done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StressOutcome {
    /// Value of the dial.
    pub dial: f64,
    /// Number of the sample.
    pub sample: u64,
    /// Identifies the program, the family's inputs and the case: a result with another key is computed again.
    pub key: String,
    /// Reason why the case does not exist; empty if it exists.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub refused: String,
    /// The sides and engines.
    pub parties: Vec<PartyAtPoint>,
}

/// A number in its stored form: four digits, so that it is read back as it was written. NaN stays NaN.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
