//! Content of a recording.

use std::collections::BTreeMap;

use linkage::mechanism::Mechanism;
use linkage::trajectory::Trajectory;

/// All data of one recording.
#[derive(Clone, Copy, Debug)]
pub struct Recording<'a> {
    /// Name of the scenario.
    pub name: &'a str,
    /// Text of the scenario file, attached as `scenario.toml`.
    pub scenario_text: &'a str,
    /// Origin of the numbers: versions, settings, verdict.
    pub metadata: &'a BTreeMap<String, String>,
    /// The mechanism that is drawn.
    pub mechanism: &'a Mechanism,
    /// The trajectories: the reference first, then the engines. A side without samples is left out.
    pub sides: &'a [RecordedSide<'a>],
    /// Engine minus reference, channel by channel, in SI units. These errors are written for people and are not read
    /// back.
    pub errors: Option<&'a Trajectory>,
    /// Verdicts and warnings.
    pub log: &'a [LogEntry],
    /// How the recording is shown, and which samples it keeps.
    pub show: Show,
}

/// How a recording is shown, and which samples it keeps. These options do not change the recorded values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Show {
    /// Factor by which playback is slower than the simulation: seconds of log time per simulated second.
    pub slow: f64,
    /// Largest number of samples per simulated second. The first and the last sample are always kept. `None` keeps all
    /// samples.
    pub hz: Option<f64>,
    /// Whether reactions are drawn as arrows.
    pub forces: bool,
}

impl Default for Show {
    /// The default: at the speed of the simulation, with every sample, without arrows.
    fn default() -> Self {
        Show { slow: 1.0, hz: None, forces: false }
    }
}

/// One trajectory of a recording.
#[derive(Clone, Copy, Debug)]
pub struct RecordedSide<'a> {
    /// First part of the names of the side's topics and frames: "reference", "engine". The name must be unique,
    /// non-empty, without `/`, and neither "error" nor "mechanism".
    pub name: &'a str,
    /// Values of the side.
    pub trajectory: &'a Trajectory,
}

/// One line of the recording's log.
#[derive(Clone, Debug, PartialEq)]
pub struct LogEntry {
    /// Simulated time (s), as in the trajectories.
    pub time: f64,
    /// Importance of the entry.
    pub level: Level,
    /// The message.
    pub text: String,
}

/// Importance of a log entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// For information.
    Info,
    /// To be examined.
    Warning,
    /// Something failed.
    Error,
}
