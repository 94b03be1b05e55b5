//! Options of recordings, and the message about a recording that was written.

use crate::sentences;
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use super::{advice, number, output};
use crate::report::{layout, recorded};
use files::{self, OutputTarget};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::statistics::ends;
use prover::run::Proof;
use recording::{self, RecordedSide, Recording, RecordingPlace, Show};
use scenario::Scenario;
#[cfg(feature = "live")]
use {
    linkage::case::Case,
    linkage::math::KeepNan,
    linkage::trajectory::Trajectory,
    recording::{Level, LogEntry, Reel},
};

/// If a recording has more bytes than this, the message calls it large: viewers then take seconds to open it.
const LARGE: u64 = 20_000_000;
/// Size of the smaller recording that the message suggests (bytes).
const HANDY: f64 = 5e6;

/// Name of the reference's side in a recording.
const REFERENCE: &str = "reference";

/// Destination and contents of a recording.
#[derive(Clone, Debug, clap::Args)]
#[group(skip)]
pub(super) struct RecordArgs {
    /// Directory for the recordings (MCAP), with a layout for Foxglove and Lichtblick beside each recording
    #[arg(long, value_name = "DIR", default_value = "recordings")]
    record: PathBuf,
    /// Write no recording
    #[arg(long, conflicts_with = "record")]
    pub(super) no_record: bool,
    /// Time scale of recordings and of `--live`: viewers play recordings this many times slower than the mechanism
    /// runs [default: 1 in recordings; layouts and `--live` show a turn in about four seconds]
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true, value_parser = number::positive)]
    slow: Option<f64>,
    /// Record at most this many instants per second of the mechanism's time, besides the first and the last instant
    /// [default: all]
    #[arg(long, value_name = "HZ", allow_hyphen_values = true, value_parser = number::positive)]
    record_hz: Option<f64>,
    /// Also record reactions as arrows; their numbers are recorded anyway
    #[arg(long)]
    record_forces: bool,
}

/// A recording that was written.
pub(super) struct Recorded {
    /// Path of the recording.
    pub path: PathBuf,
    /// Path of the viewer layout; `None` without a layout.
    pub layout: Option<PathBuf>,
    /// Message about the recording: its path, its size, and a suitable viewer.
    pub told: String,
}

impl RecordArgs {
    /// Refuses options that have no effect without a recording. Do not call it for a live view, which uses them too.
    pub(super) fn refuse_idle(&self) -> Result<()> {
        let given = [
            ("--slow", self.slow.is_some()),
            ("--record-hz", self.record_hz.is_some()),
            ("--record-forces", self.record_forces),
        ];
        match given.into_iter().find(|&(_, is_given)| is_given && self.no_record) {
            None => Ok(()),
            Some((option, _)) => {
                let message = sentences::cannot_be_used_with_no_record(&option);
                Err(Error::new(ErrorKind::Input, message).help(sentences::LEAVE_OUT_ONE_OF_THE_TWO))
            }
        }
    }

    /// Tests in advance whether the requested recordings can be written.
    pub(super) fn target(&self) -> Result<()> {
        if self.no_record {
            return Ok(());
        }
        files::may_fill(&self.record).map_err(|found| {
            let message = sentences::recordings_cannot_be_written_to(&self.record.display(), &found);
            Error::new(ErrorKind::Io, message).key("--record").help(sentences::NAME_ANOTHER_DIRECTORY_OR_USE)
        })
    }

    /// Records a proof, with its layout, unless recording is off.
    /// A recording of a different run is not replaced.
    pub(super) fn record(
        &self,
        scenario: &Scenario,
        proof: &Proof,
        mut metadata: BTreeMap<String, String>,
    ) -> Result<Option<Recorded>> {
        if self.no_record {
            return Ok(None);
        }
        let directory = &self.record;
        fs::create_dir_all(directory).map_err(|error| {
            Error::new(ErrorKind::Io, sentences::the_directory_cannot_be_made(&directory.display(), &error))
                .help(sentences::NAME_ANOTHER_DIRECTORY_WITH_RECORD)
        })?;
        metadata.extend(self.record_hz.map(|hz| ("record_hz".into(), hz.to_string())));
        let RecordingPlace { path, other } = recording::place(directory, &scenario.name, &scenario.text, &metadata)?;
        let view = self.as_recorded(scenario, proof, &metadata, |recording| {
            recording::write(recording, &path).map(|()| recording::view(recording))
        })?;
        let bytes = fs::metadata(&path).map_or(0, |found| found.len());
        let mut told = format!("\nrecording  {} ({})", path.display(), files::size(bytes));
        if let Some(found) = other {
            told += &sentences::mcap_is_of_another_run_and_is_kept(&scenario.name, &found);
        }
        told += &large(bytes, proof.reference_trajectory.times(), self.record_hz);
        let layout = view.as_ref().map(|_| path.with_extension("foxglove.json"));
        if let (Some(view), Some(to)) = (&view, &layout) {
            told += &format!("\nlayout     {}", to.display());
            match OutputTarget::Made(to, &files::is_sealed).in_the_way() {
                Some(why) => {
                    told += &sentences::it_is_kept_linkproof_view(&why, &path.display());
                }
                None => output::make(&layout::text(view), to)?,
            }
        }
        Ok(Some(Recorded { path, layout, told: told + "\n" }))
    }

    /// The contents that a recording of the proof would have, for live viewers.
    #[cfg(feature = "live")]
    pub(super) fn reel(&self, scenario: &Scenario, proof: &Proof) -> Result<Reel> {
        self.as_recorded(scenario, proof, &BTreeMap::new(), recording::reel)
    }

    /// The contents that a recording of the reference alone would have. Live viewers show them until the proof is done.
    #[cfg(feature = "live")]
    pub(super) fn first_reel(&self, scenario: &Scenario, case: &Case, reference: &Trajectory) -> Result<Reel> {
        let text = sentences::THE_ENGINE_IS_AT_WORK_ITS_SIDE;
        let time = reference.times().iter().copied().fold(f64::INFINITY, f64::smaller);
        recording::reel(&Recording {
            name: &scenario.name,
            scenario_text: &scenario.text,
            metadata: &BTreeMap::new(),
            mechanism: &case.mechanism,
            sides: &[RecordedSide { name: REFERENCE, trajectory: reference }],
            errors: None,
            log: &[LogEntry { time, level: Level::Info, text: text.into() }],
            show: self.show(),
        })
    }

    /// Prepares the contents that a recording of the proof would have, and calls `visit` with them.
    fn as_recorded<T>(
        &self,
        scenario: &Scenario,
        proof: &Proof,
        metadata: &BTreeMap<String, String>,
        visit: impl FnOnce(&Recording) -> T,
    ) -> T {
        let sides = sides(proof);
        let log = recorded::log(proof, advice::told);
        visit(&Recording {
            name: &scenario.name,
            scenario_text: &scenario.text,
            metadata,
            mechanism: &proof.scene.case.mechanism,
            sides: &sides,
            errors: proof.engine().errors.as_ref(),
            log: &log,
            show: self.show(),
        })
    }

    fn show(&self) -> Show {
        Show { slow: self.slow.unwrap_or(1.0), hz: self.record_hz, forces: self.record_forces }
    }
}

/// The reference, then the engines.
fn sides(proof: &Proof) -> Vec<RecordedSide<'_>> {
    let mut sides = vec![RecordedSide { name: REFERENCE, trajectory: &proof.reference_trajectory }];
    for engine in &proof.engines {
        let name = if proof.engines.len() == 1 { "engine" } else { engine.info.name };
        sides.extend(engine.trajectory.as_ref().map(|trajectory| RecordedSide { name, trajectory }));
    }
    sides
}

/// Message if the recording is large: the value of `--record-hz` that gives a handy size. `times` are the recorded
/// instants (s).
fn large(bytes: u64, times: &[f64], hz: Option<f64>) -> String {
    if bytes < LARGE {
        return String::new();
    }
    let [begin, end] = ends(times.iter().copied());
    let rate = hz.unwrap_or(times.len() as f64 / (end - begin));
    // The suggested number is rounded to one significant digit, which is enough for a suggestion.
    let fewer = rate * HANDY / bytes as f64;
    let digit = 10f64.powf(fewer.log10().floor());
    let fewer = (fewer / digit).floor() * digit;
    sentences::it_is_large_record_hz_would(&fewer, &files::size(HANDY as u64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lower_rate_is_suggested_only_for_large_recordings() {
        let times: Vec<f64> = (0..36_001).map(|k| f64::from(k) * 1e-3).collect();
        assert_eq!(large(19_999_999, &times, None), "");
        assert_eq!(
            large(62_000_000, &times, None),
            "\n           the recording is large; --record-hz 80 would reduce it to about 5.0 MB"
        );
        assert!(large(62_000_000, &times, Some(200.0)).contains("--record-hz 10 "));
    }
}
