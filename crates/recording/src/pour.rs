//! Converts trajectories to messages in order of time.

use super::forces::Forces;
use super::recording::{Level, LogEntry, Recording};
use super::scene::ViewerScene;
use super::shapes::stamp;
use super::sink::{MessageKind, Sink};
use super::table::ChannelTable;
use super::urdf;
use crate::viewers::{FrameTransforms, Log, LogLevel, SceneUpdate};
use linkage::math::KeepNan;
use linkage::math::statistics::ascending;
use mcap::McapResult;
use prost::Message;

/// Nanoseconds in a second.
pub const SECOND: u64 = 1_000_000_000;

/// A frame, a sample or a log line that is written at a given time.
enum Event<'a> {
    Frame(f64),
    Sample { table: usize, row: usize, sequence: u32 },
    Log(&'a LogEntry),
}

/// The drawing of a recording.
pub struct DrawnRecording<'a> {
    /// The moving mechanism, if there are positions.
    pub scene: &'a Option<ViewerScene<'a>>,
    /// Arrows of reactions, if arrows are requested and reactions are known.
    pub forces: &'a Option<Forces<'a>>,
}

/// Passes all messages of a recording to a sink, in order of time.
pub fn pour(recording: &Recording, drawn: &DrawnRecording, sink: &mut impl Sink) -> McapResult<()> {
    let &DrawnRecording { scene, forces } = drawn;
    let start = start(recording);
    let nanoseconds = |time: f64| ((time - start) * recording.show.slow * SECOND as f64).round().larger(0.0) as u64;

    let sides = recording.sides.iter().map(|side| ChannelTable::values(sink, side.name, side.trajectory));
    let mut tables: Vec<_> = sides.collect::<McapResult<_>>()?;
    tables.extend(recording.errors.map(|errors| ChannelTable::errors(sink, errors)).transpose()?);

    let mut events: Vec<(u64, Event)> = Vec::new();
    if let Some(scene) = scene {
        let links = scene.links();
        let topic = sink.topic("/mechanism/links", &MessageKind::viewers::<SceneUpdate>())?;
        sink.put(topic, 0, 0, &links.encode_to_vec())?;
        let topic = sink.topic("/robot_description", &MessageKind::text())?;
        sink.put(topic, 0, 0, &urdf::message(&urdf::text(recording.name, &links)))?;
        events.extend(scene.times(recording.show.slow).into_iter().map(|time| (nanoseconds(time), Event::Frame(time))));
    }
    for (index, table) in tables.iter().enumerate() {
        for (sequence, row) in ascending(table.times).into_iter().enumerate() {
            let event = Event::Sample { table: index, row, sequence: sequence as u32 };
            events.push((nanoseconds(table.times[row]), event));
        }
    }
    events.extend(recording.log.iter().map(|entry| (nanoseconds(entry.time), Event::Log(entry))));
    events.sort_by_key(|&(time, _)| time);

    let frames = scene.as_ref().map(|_| sink.topic("/tf", &MessageKind::viewers::<FrameTransforms>())).transpose()?;
    let arrows =
        forces.as_ref().map(|_| sink.topic("/mechanism/forces", &MessageKind::viewers::<SceneUpdate>())).transpose()?;
    let log = sink.topic("/log", &MessageKind::viewers::<Log>())?;
    let mut buffer = Vec::new();
    for (time, event) in events {
        match event {
            Event::Sample { table, row, sequence } => {
                for topic in &tables[table].topics {
                    topic.encode(row, &mut buffer);
                    sink.put(topic.id, sequence, time, &buffer)?;
                }
            }
            Event::Frame(at) => {
                if let (Some(scene), Some(topic)) = (scene, frames) {
                    sink.put(topic, 0, time, &scene.frames(at, time).encode_to_vec())?;
                }
                if let (Some(forces), Some(topic)) = (forces, arrows) {
                    sink.put(topic, 0, time, &forces.arrows(at, time).encode_to_vec())?;
                }
            }
            Event::Log(entry) => sink.put(log, 0, time, &line(entry, recording.name, time).encode_to_vec())?,
        }
    }
    Ok(())
}

/// Smallest time in the recording (s). The log time of this instant is zero.
pub fn start(recording: &Recording) -> f64 {
    let first = times(recording).fold(f64::INFINITY, f64::smaller);
    if first.is_finite() { first } else { 0.0 }
}

/// Simulated time from the first sample to the last (s).
pub fn lasts(recording: &Recording) -> f64 {
    let start = start(recording);
    times(recording).fold(0.0, |lasts, time| f64::larger(lasts, time - start))
}

fn times(recording: &Recording) -> impl Iterator<Item = f64> {
    let trajectories = recording.sides.iter().map(|side| side.trajectory).chain(recording.errors);
    trajectories.flat_map(|trajectory| trajectory.times().iter().copied())
}

fn line(entry: &LogEntry, name: &str, nanoseconds: u64) -> Log {
    let level = match entry.level {
        Level::Info => LogLevel::Info,
        Level::Warning => LogLevel::Warning,
        Level::Error => LogLevel::Error,
    };
    Log { timestamp: stamp(nanoseconds), level: level as i32, message: entry.text.clone(), name: name.into() }
}
