//! Outcome of a point. The declarations also fix the names and the order of the fields in JSON.
//! Numbers that are not finite are `null` in JSON and are read back as infinite.

use serde::{Deserialize, Deserializer, Serialize};

linkage::words! {
    /// Groups of quantities. The map of a family (an SVG picture) has one panel per group.
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
    /// Outcome of a solver or an engine at a point. The best outcome comes first.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum PointEnd: word {
        /// The proof agrees.
        Agree = "agree",
        /// The proof is inconclusive.
        Inconclusive = "inconclusive",
        /// The proof disagrees.
        Disagree = "disagree",
        /// The solver or engine gives no numbers.
        #[default]
        Fails = "fails",
    }
}

/// The worst channel of a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorstOfGroup {
    /// The group.
    pub group: QuantityGroup,
    /// Largest error divided by the channel's scale, which is usually half the channel's range in the run.
    #[serde(deserialize_with = "number")]
    pub error: f64,
    /// Bound of the error in the channel with the largest error, divided by the channel's scale.
    #[serde(deserialize_with = "number")]
    pub bound: f64,
    /// The channel with the largest error.
    pub channel: String,
    /// Largest ratio of error to bound among the channels of the group.
    #[serde(deserialize_with = "number")]
    pub used: f64,
}

fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
}

/// Results of one solver or engine at a point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PartyAtPoint {
    /// Name.
    pub name: String,
    /// Outcome.
    pub verdict: PointEnd,
    /// Reason of a verdict other than agreement.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub why: String,
    /// Name of the reference from which the errors are computed; empty if no errors were computed.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub against: String,
    /// The worst channel of each group; empty if the solver or engine failed.
    #[serde(rename = "groups")]
    pub reached: Vec<WorstOfGroup>,
    /// Largest opening of a joint, divided by the mechanism's size.
    pub closure: Option<f64>,
    /// Largest difference between the balancing moment from reactions and the balancing moment from powers, divided by
    /// the largest moment on the driving link.
    pub balance: Option<f64>,
    /// Step (s) of the run that is judged.
    #[serde(rename = "step_s")]
    pub step: Option<f64>,
    /// Number of sweeps of the judged run.
    pub sweeps: Option<usize>,
    /// Number of extrapolations of the judged run.
    pub extrapolated: Option<usize>,
    /// Number of steps from t = 0 to the grid's instant that is farthest from t = 0.
    pub steps: Option<f64>,
    /// Number of runs in the engine's search for settings.
    pub runs: Option<usize>,
    /// Work of the engine's search for settings. The unit is the work of one step without sweeps.
    pub work: Option<f64>,
    /// Counted operations, in the order of [`Count::ALL`](linkage::work::Count::ALL).
    /// The operations of all runs are counted: one run of an analytic side, several runs of an engine.
    #[serde(default)]
    pub done: Vec<(String, u64)>,
    /// Number of channels with wrong numbers and no warning: the channel exceeds its bound, but the verdict is
    /// agreement.
    pub silent: usize,
}

impl PartyAtPoint {
    /// The results of a solver or engine that gives no numbers, with the reason.
    pub(super) fn failed(name: &str, why: &str) -> PartyAtPoint {
        PartyAtPoint { name: name.into(), why: why.into(), ..PartyAtPoint::default() }
    }
}

/// A point with its outcomes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StressOutcome {
    /// Value of the varied parameter.
    pub dial: f64,
    /// Number of the random mechanism at this value.
    pub sample: u64,
    /// Identifies the program, the family's inputs and the case. A stored result with a different key is computed
    /// again.
    pub key: String,
    /// Reason why the case does not exist; empty if it exists.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub refused: String,
    /// The analytic sides and the engines.
    pub parties: Vec<PartyAtPoint>,
}

/// Rounds a number to four digits for storage, so that the number read back equals the number written. NaN stays NaN.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
