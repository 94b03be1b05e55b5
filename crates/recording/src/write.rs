//! Writes a recording as an MCAP file.

use super::beside::LIBRARY;
use super::forces::Forces;
use super::pour::{DrawnRecording, SECOND, lasts, pour, start};
use super::raw;
use super::recording::{RecordedSide, Recording, Show};
use super::scene::ViewerScene;
use super::sink::{MessageKind, Sink};
use crate::sentences;
use files::{self, OutputTarget};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::statistics::ascending;
use linkage::trajectory::Trajectory;
use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Attachment, McapError, McapResult, WriteOptions, Writer};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// Upper limit of the log time (s). In nanoseconds, this limit is a third of the largest signed 64-bit number.
const LONGEST: f64 = 3e9;

/// A sample may come earlier than it is due by this fraction of the requested sample spacing, and is still kept.
/// The times of grids are rounded, so an exact comparison would lose samples.
const EARLY: f64 = 1e-6;

/// Writes a recording to `path`. An older recording is replaced only by a complete recording, through a temporary file.
///
/// # Errors
/// [`ErrorKind::Io`](linkage::ErrorKind::Io) with the path if a file cannot be written;
/// [`ErrorKind::Input`](linkage::ErrorKind::Input) if a side's name is invalid (see [`RecordedSide::name`]), if a time
/// of a grid is not finite, or if [`Show`] has an invalid number or makes the recording too long for viewers.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the MCAP library")]
pub fn write(recording: &Recording, path: &Path) -> Result<()> {
    check(recording)?;
    files::replace(&OutputTarget::Made(path, &|bytes| raw::is_by(bytes, LIBRARY)), |file| {
        fill(recording, file.try_clone()?)
    })
    .map_err(|error| {
        let what = sentences::the_recording(&path.display());
        let usual = sentences::CHECK_THAT_THE_DIRECTORY_EXISTS;
        match error {
            McapError::Io(error) => files::unwritten(&what, &error, None, usual),
            other => Error::new(ErrorKind::Io, sentences::cannot_be_written(&what, &other)).help(usual),
        }
    })
}

pub(super) fn check(recording: &Recording) -> Result<()> {
    for (index, side) in recording.sides.iter().enumerate() {
        let taken = recording.sides[..index].iter().any(|other| other.name == side.name);
        if taken || side.name.is_empty() || side.name.contains('/') || ["error", "mechanism"].contains(&side.name) {
            let message = sentences::a_side_of_a_recording_cannot(&side.name);
            return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_IT_A_NAME_OF_ITS_OWN));
        }
    }
    let Show { slow, hz, forces: _ } = recording.show;
    if let Some(wrong) = [Some(slow), hz].into_iter().flatten().find(|&part| !(part.is_finite() && part > 0.0)) {
        let message = sentences::a_recording_cannot_have_a_time(&wrong);
        return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_A_FINITE_NUMBER_GREATER));
    }
    let trajectories = recording.sides.iter().map(|side| side.trajectory).chain(recording.errors);
    if let Some(time) = trajectories.flat_map(Trajectory::times).find(|time| !time.is_finite()) {
        return Err(Error::new(ErrorKind::Input, sentences::a_time_of_the_recording_grid(&time)));
    }
    let lasts = slow * lasts(recording);
    if !(lasts <= LONGEST) {
        let message = sentences::a_recording_cannot_last_viewers(&format_args!("{lasts:e}"));
        return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_A_SMALLER_TIME_SCALE));
    }
    Ok(())
}

fn fill(recording: &Recording, file: File) -> McapResult<()> {
    as_shown(recording, |recording, drawn| {
        let mut output = RecordingOutput::create(file)?;
        output.describe(recording, start(recording), drawn.forces.as_ref().map(|forces| forces.scale))?;
        pour(recording, drawn, &mut output)?;
        output.finish()
    })
}

/// Calls `visit` with the kept samples and their drawing.
pub(super) fn as_shown<T>(recording: &Recording, visit: impl FnOnce(&Recording, &DrawnRecording) -> T) -> T {
    let thin = |trajectory: &Trajectory| recording.show.hz.map(|hz| thinned(trajectory, hz));
    let fewer: Vec<Option<Trajectory>> = recording.sides.iter().map(|side| thin(side.trajectory)).collect();
    let fewer_errors = recording.errors.and_then(thin);
    let sides: Vec<RecordedSide> = (recording.sides.iter().zip(&fewer))
        .map(|(side, fewer)| RecordedSide { name: side.name, trajectory: fewer.as_ref().unwrap_or(side.trajectory) })
        .collect();
    let shown = Recording { sides: &sides, errors: fewer_errors.as_ref().or(recording.errors), ..*recording };
    let scene = ViewerScene::new(shown.mechanism, shown.sides);
    let forces = scene.as_ref().filter(|_| shown.show.forces).and_then(Forces::new);
    visit(&shown, &DrawnRecording { scene: &scene, forces: &forces })
}

/// The trajectory with at most `hz` samples per second; the first and the last sample are always kept.
fn thinned(trajectory: &Trajectory, hz: f64) -> Trajectory {
    let times = trajectory.times();
    let order = ascending(times);
    let mut keep = vec![false; times.len()];
    if let (Some(&first), Some(&last)) = (order.first(), order.last()) {
        (keep[first], keep[last]) = (true, true);
        let mut due = 1.0;
        for &row in &order {
            let passed = (times[row] - times[first]) * hz + EARLY;
            if passed >= due {
                keep[row] = true;
                due = passed.floor() + 1.0;
            }
        }
    }
    trajectory.at_rows(&keep)
}

/// Target size of a chunk before compression (bytes).
const CHUNK: u64 = 768 * 1024;

/// The file being written.
pub struct RecordingOutput {
    writer: Writer<NoSeek<BufWriter<File>>>,
    /// Last flush, in whole seconds of log time.
    flushed: u64,
    /// Bytes written since the last flush.
    pending: usize,
}

impl RecordingOutput {
    /// Starts the file.
    pub fn create(file: File) -> McapResult<Self> {
        let writer = WriteOptions::new()
            .profile("")
            .library([LIBRARY, env!("CARGO_PKG_VERSION")].concat())
            .chunk_size(Some(CHUNK))
            // With several threads, the division into chunks would depend on the number of cores. Compression therefore
            // uses no additional threads.
            .compression_threads(0)
            // A seeking writer corrects the chunk's length after the chunk is written.
            // If a seeking writer were killed before this correction, no program could open the file. Seeking is
            // therefore disabled.
            .disable_seeking(true)
            .create(NoSeek::new(BufWriter::new(file)))?;
        Ok(RecordingOutput { writer, flushed: 0, pending: 0 })
    }

    /// Writes the metadata record and the scenario before all messages, so that a truncated file also contains them.
    pub fn describe(&mut self, recording: &Recording, start: f64, force_scale: Option<f64>) -> McapResult<()> {
        let mut metadata = recording.metadata.clone();
        metadata.entry("scenario".into()).or_insert_with(|| recording.name.into());
        metadata.insert("log_time_zero_s".into(), start.to_string());
        let Show { slow, hz, forces: _ } = recording.show;
        metadata.insert("slow".into(), slow.to_string());
        metadata.extend(hz.map(|hz| ("record_hz".into(), hz.to_string())));
        if let Some(scale) = force_scale {
            metadata.insert("force_scale_m_per_N".into(), scale.to_string());
        }
        self.writer.write_metadata(&Metadata { name: "linkproof".into(), metadata })?;
        self.writer.attach(&Attachment {
            log_time: 0,
            create_time: 0,
            name: "scenario.toml".into(),
            media_type: "application/toml".into(),
            data: recording.scenario_text.as_bytes().into(),
        })
    }

    /// Writes the indexes and the end of the file.
    pub fn finish(mut self) -> McapResult<()> {
        self.writer.finish()?;
        let buffer = self.writer.into_inner().into_inner();
        buffer.into_inner().map(drop).map_err(|error| McapError::Io(error.into_error()))
    }
}

impl Sink for RecordingOutput {
    fn topic(&mut self, name: &str, kind: &MessageKind) -> McapResult<u16> {
        let schema = self.writer.add_schema(&kind.schema, &kind.encoding, &kind.data)?;
        self.writer.add_channel(schema, name, &kind.message, &BTreeMap::new())
    }

    fn put(&mut self, topic: u16, sequence: u32, time: u64, data: &[u8]) -> McapResult<()> {
        // One chunk per second limits the loss if a run is killed. A chunk of only a few samples would compress badly,
        // so such a chunk stays open after the second ends.
        if time / SECOND > self.flushed && self.pending > CHUNK as usize / 8 {
            self.writer.flush()?;
            (self.flushed, self.pending) = (time / SECOND, 0);
        }
        self.pending += data.len();
        let header = MessageHeader { channel_id: topic, sequence, log_time: time, publish_time: time };
        self.writer.write_to_known_channel(&header, data)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(times: &[f64], hz: f64) -> Vec<f64> {
        let all = Trajectory::new(times.to_vec(), times.to_vec(), Vec::new(), Vec::new()).unwrap();
        thinned(&all, hz).times().to_vec()
    }

    #[test]
    fn thinning_keeps_both_ends_and_the_order_of_the_solver() {
        let grid: Vec<f64> = (0..=10).map(|k| f64::from(k) * 0.1).collect();
        assert_eq!(kept(&grid, 5.0), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(kept(&grid, 1000.0), grid);
        assert_eq!(kept(&grid, 0.1), [0.0, 1.0]);
        // A gap between samples does not shift the times at which later samples are kept.
        assert_eq!(kept(&[0.0, 0.05, 0.95, 1.0, 1.05, 2.0], 1.0), [0.0, 1.0, 2.0]);
        assert_eq!(kept(&[2.0, 1.0, 0.0, 0.5], 1.0), [2.0, 1.0, 0.0]);
        assert_eq!(kept(&[], 1.0), [0.0; 0]);
    }
}
