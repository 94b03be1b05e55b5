//! From trajectories to an MCAP file.

use super::forces::Forces;
use super::outline::Outline;
use super::output::{Output, SECOND};
use super::recording::{Level, LogEntry, Recording};
use super::scene::Scene;
use super::schema;
use super::shapes::stamp;
use crate::files;
use foxglove::messages::{FrameTransforms, Log, PointCloud, SceneUpdate, log::Level as LogLevel};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::math::statistics::ascending;
use linkage::trajectory::{ChannelKind, Subject, Trajectory};
use mcap::{McapError, McapResult};
use prost::Message;
use std::fs::File;
use std::path::Path;

/// Number of point clouds above which only every second one is written.
const CLOUDS: usize = 200;

#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the MCAP library")]
pub(super) fn write(recording: &Recording, path: &Path) -> Result<()> {
    check(recording)?;
    files::replace(path, |file| fill(recording, file.try_clone()?)).map_err(|error| {
        let what = format!("the recording {}", path.display());
        let usual = "check that the directory exists, may be written to and has room, or record elsewhere";
        match error {
            McapError::Io(error) => files::unwritten(&what, &error, None, usual),
            other => Error::new(ErrorKind::Io, format!("{what} cannot be written: {other}")).help(usual),
        }
    })
}

fn check(recording: &Recording) -> Result<()> {
    for (index, side) in recording.sides.iter().enumerate() {
        let taken = recording.sides[..index].iter().any(|other| other.name == side.name);
        if taken || side.name.is_empty() || side.name.contains('/') || ["error", "mechanism"].contains(&side.name) {
            let message = format!("a side of a recording cannot be called \"{}\"", side.name);
            return Err(Error::new(ErrorKind::Input, message)
                .help("give it a name of its own without `/`; \"error\" and \"mechanism\" are taken"));
        }
    }
    let trajectories = recording.sides.iter().map(|side| side.trajectory).chain(recording.errors);
    if let Some(time) = trajectories.flat_map(Trajectory::times).find(|time| !time.is_finite()) {
        return Err(Error::new(ErrorKind::Input, format!("a time of the recording's grid is {time} s")));
    }
    Ok(())
}

/// An event to be written at its time.
enum Event<'a> {
    Frame(f64),
    Cloud(f64),
    Sample { table: usize, row: usize, sequence: u32 },
    Log(&'a LogEntry),
}

fn fill(recording: &Recording, file: File) -> McapResult<()> {
    let scene = Scene::new(recording.mechanism, recording.sides);
    let forces = scene.as_ref().and_then(Forces::new);
    let outline = scene.as_ref().map(Outline::new);
    let start = start(recording);
    let nanoseconds = |time: f64| ((time - start) * SECOND as f64).round().larger(0.0) as u64;

    let mut output = Output::create(file)?;
    output.describe(recording, start, forces.as_ref().map(|forces| forces.scale))?;
    let mut tables = Vec::new();
    for side in recording.sides {
        tables.push(Table::values(&mut output, side.name, side.trajectory)?);
    }
    if let Some(errors) = recording.errors {
        tables.push(Table::errors(&mut output, errors)?);
    }

    let mut events: Vec<(u64, Event)> = Vec::new();
    if let Some(scene) = &scene {
        let topic = output.foxglove::<SceneUpdate>("/mechanism/links")?;
        output.put(topic, 0, 0, &scene.links().encode_to_vec())?;
        let times = scene.times();
        events.extend(times.iter().map(|&time| (nanoseconds(time), Event::Frame(time))));
        // Point clouds take the most space: half of them are enough for the eye.
        let clouds = times.iter().step_by(if times.len() > CLOUDS { 2 } else { 1 });
        events.extend(clouds.map(|&time| (nanoseconds(time), Event::Cloud(time))));
    }
    for (index, table) in tables.iter().enumerate() {
        for (sequence, row) in ascending(table.times).into_iter().enumerate() {
            let event = Event::Sample { table: index, row, sequence: sequence as u32 };
            events.push((nanoseconds(table.times[row]), event));
        }
    }
    events.extend(recording.log.iter().map(|entry| (nanoseconds(entry.time), Event::Log(entry))));
    events.sort_by_key(|&(time, _)| time);

    let frames = scene.as_ref().map(|_| output.foxglove::<FrameTransforms>("/tf")).transpose()?;
    let arrows = forces.as_ref().map(|_| output.foxglove::<SceneUpdate>("/mechanism/forces")).transpose()?;
    let clouds = outline.as_ref().map(|_| output.foxglove::<PointCloud>("/mechanism/outline")).transpose()?;
    let log = output.foxglove::<Log>("/log")?;
    let mut buffer = Vec::new();
    for (time, event) in events {
        match event {
            Event::Sample { table, row, sequence } => {
                for topic in &tables[table].topics {
                    topic.encode(row, &mut buffer);
                    output.put(topic.id, sequence, time, &buffer)?;
                }
            }
            Event::Frame(at) => {
                if let (Some(scene), Some(topic)) = (&scene, frames) {
                    output.put(topic, 0, time, &scene.frames(at, time).encode_to_vec())?;
                }
                if let (Some(forces), Some(topic)) = (&forces, arrows) {
                    output.put(topic, 0, time, &forces.arrows(at, time).encode_to_vec())?;
                }
            }
            Event::Cloud(at) => {
                if let (Some(outline), Some(topic)) = (&outline, clouds) {
                    output.put(topic, 0, time, &outline.cloud(at, time).encode_to_vec())?;
                }
            }
            Event::Log(entry) => output.put(log, 0, time, &line(entry, recording.name, time).encode_to_vec())?,
        }
    }
    output.finish()
}

/// Smallest time of the recording (s), where log times start.
fn start(recording: &Recording) -> f64 {
    let trajectories = recording.sides.iter().map(|side| side.trajectory).chain(recording.errors);
    let first = trajectories.flat_map(Trajectory::times).copied().fold(f64::INFINITY, f64::smaller);
    if first.is_finite() { first } else { 0.0 }
}

fn line(entry: &LogEntry, name: &str, nanoseconds: u64) -> Log {
    let level = match entry.level {
        Level::Info => LogLevel::Info,
        Level::Warning => LogLevel::Warning,
        Level::Error => LogLevel::Error,
    };
    Log {
        timestamp: stamp(nanoseconds),
        level: level as i32,
        message: entry.text.clone(),
        name: name.into(),
        ..Default::default()
    }
}

/// A trajectory with the topics of its columns.
struct Table<'a> {
    times: &'a [f64],
    topics: Vec<Topic<'a>>,
}

/// One message per row.
struct Topic<'a> {
    id: u16,
    fields: Vec<Field<'a>>,
}

enum Field<'a> {
    Value(u32, &'a [f64]),
    /// Column and the number of small units in its SI unit.
    Scaled(u32, &'a [f64], f64),
    /// The number of the row itself.
    Row(u32),
}

impl Topic<'_> {
    fn encode(&self, row: usize, buffer: &mut Vec<u8>) {
        buffer.clear();
        for field in &self.fields {
            match *field {
                Field::Value(tag, column) => schema::put(buffer, tag, column[row]),
                Field::Row(tag) => schema::put(buffer, tag, row as f64),
                Field::Scaled(tag, column, factor) => {
                    let value = (column[row] * factor).clamp(f64::from(f32::MIN), f64::from(f32::MAX));
                    schema::put_small(buffer, tag, value as f32);
                }
            }
        }
    }
}

impl<'a> Table<'a> {
    fn values(output: &mut Output, side: &str, trajectory: &'a Trajectory) -> McapResult<Self> {
        let id = output.topic(&format!("/{side}/grid"), &schema::grid())?;
        let grid = vec![Field::Value(1, trajectory.times()), Field::Value(2, trajectory.cranks()), Field::Row(3)];
        let mut topics = vec![Topic { id, fields: grid }];
        for (subject, of, columns) in by_subject(trajectory) {
            let id = output.topic(&topic_name(side, subject, of), &schema::values(subject))?;
            let field = |(kind, column): (&ChannelKind, &'a [f64])| Field::Value(schema::tag(kind), column);
            topics.push(Topic { id, fields: columns.into_iter().map(field).collect() });
        }
        Ok(Table { times: trajectory.times(), topics })
    }

    fn errors(output: &mut Output, errors: &'a Trajectory) -> McapResult<Self> {
        let mut topics = Vec::new();
        for (subject, of, columns) in by_subject(errors) {
            let id = output.topic(&topic_name("error", subject, of), &schema::errors(subject))?;
            let field = |(kind, column): (&ChannelKind, &'a [f64])| {
                Field::Scaled(schema::tag(kind), column, schema::small_unit(kind).1)
            };
            topics.push(Topic { id, fields: columns.into_iter().map(field).collect() });
        }
        Ok(Table { times: errors.times(), topics })
    }
}

fn topic_name(side: &str, subject: Subject, of: &str) -> String {
    let word = subject.word();
    if of.is_empty() { format!("/{side}/{word}") } else { format!("/{side}/{word}/{of}") }
}

type Columns<'a> = Vec<(&'static ChannelKind, &'a [f64])>;

/// The columns of each link, point, joint (all columns of a sliding joint together), of frame and drive, in the order
/// of their first column.
fn by_subject(trajectory: &Trajectory) -> Vec<(Subject, &str, Columns<'_>)> {
    let mut subjects: Vec<(Subject, &str, Columns)> = Vec::new();
    for (channel, column) in trajectory.iter() {
        let (subject, of) = (channel.kind.subject, channel.of.as_str());
        let same = |own: &(Subject, &str, Columns)| (own.0.word(), own.1) == (subject.word(), of);
        let place = subjects.iter().position(same).unwrap_or_else(|| {
            subjects.push((subject, of, Vec::new()));
            subjects.len() - 1
        });
        if subject == Subject::Slider {
            subjects[place].0 = subject;
        }
        subjects[place].2.push((channel.kind, column));
    }
    subjects
}
