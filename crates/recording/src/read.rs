//! Reads trajectories from an MCAP file.

use super::{messages, raw, schema};
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::trajectory::{Channel, Trajectory};
use mcap::Message;
use prost::DecodeError;
use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};
use std::fmt::Display;
use std::path::Path;
use std::{fs, io};

/// Values, each with the sequence number of its sample.
type Numbered = Vec<(u32, f64)>;

/// What the messages of an MCAP channel contain: the channel's side, and the meaning of each message field by number.
struct Topic {
    side: String,
    is_grid: bool,
    fields: BTreeMap<u32, Field>,
}

enum Field {
    /// A field of the grid, by its name.
    Grid(String),
    /// A channel.
    Value(Channel),
}

/// Data of one side. The columns are in the order of recording: by MCAP channel, then by field.
#[derive(Default)]
struct Found {
    grid: BTreeMap<String, Numbered>,
    columns: BTreeMap<(u16, u32), (Channel, Numbered)>,
    first: Option<u16>,
}

/// Reads every side of a recording. The sides are in the order in which they were recorded.
///
/// Times, crank angles and values are read back bit for bit, with the rows in the solver's order.
/// Columns are in the order of subjects in the recording, and within a subject in the order of
/// [`CHANNELS`](linkage::trajectory::CHANNELS).
///
/// # Errors
/// [`ErrorKind::Io`](linkage::ErrorKind::Io) with the path if the file cannot be read, is no MCAP file, or is damaged;
/// [`ErrorKind::Input`](linkage::ErrorKind::Input) if the file contains no side, or if a topic lacks samples;
/// [`ErrorKind::Numeric`](linkage::ErrorKind::Numeric) if a value is not finite.
pub fn load(path: &Path) -> Result<Vec<(String, Trajectory)>> {
    read_bytes(&bytes(path)?, path)
}

/// The bytes of a recording.
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>> {
    let read = || match fs::metadata(path)?.is_file() {
        true => fs::read(path),
        // A pipe or a device might never end.
        false => Err(io::Error::other(sentences::IT_IS_NO_REGULAR_FILE)),
    };
    read().map_err(|error| {
        Error::new(ErrorKind::Io, sentences::the_recording_cannot_be_read(&path.display(), &error))
            .help(sentences::CHECK_THE_PATH)
    })
}

/// Refuses a file before decompression if its chunks would expand far more than the chunks of a usual recording.
fn bounded(bytes: &[u8], path: &Path) -> Result<()> {
    let [told, most] = raw::expanded(bytes);
    if told <= most {
        return Ok(());
    }
    let [length, told, most] = [bytes.len() as u64, told, most].map(files::size);
    let message = sentences::the_recording_has_and_says(&path.display(), &length, &told, &most);
    Err(Error::new(ErrorKind::Io, message).help(sentences::RECORD_IT_AGAIN_RECORDINGS_OF_THIS_PROGRAM))
}

/// Reads every side from the bytes of a recording. Error messages name the recording by its `path`.
///
/// # Errors
/// The errors of [`load`] that concern the content of the file.
pub fn read_bytes(bytes: &[u8], path: &Path) -> Result<Vec<(String, Trajectory)>> {
    if !bytes.starts_with(mcap::MAGIC) {
        let what = if bytes.is_empty() { "is empty" } else { sentences::IS_NO_RECORDING_IT_DOES_NOT_BEGIN };
        return Err(Error::new(ErrorKind::Io, sentences::the_file(&path.display(), &what))
            .help(sentences::NAME_A_RECORDING_MCAP_WHICH_A_RUN));
    }
    bounded(bytes, path)?;
    let mut topics: HashMap<u16, Option<Topic>> = HashMap::new();
    let mut names = schema::Names::default();
    let mut sides: BTreeMap<String, Found> = BTreeMap::new();
    messages::each(bytes, path, |message| {
        let topic = match topics.entry(message.channel.id) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => new.insert(topic(message, &mut names)?),
        };
        topic.as_ref().map_or(Ok(()), |topic| collect(message, topic, &mut sides))
    })?;
    let mut sides: Vec<(String, Found)> = sides.into_iter().collect();
    sides.sort_by_key(|(_, found)| found.first);
    if sides.is_empty() {
        return Err(Error::new(ErrorKind::Input, sentences::the_recording_holds_no_trajectory(&path.display()))
            .help(sentences::A_SIDE_NEEDS_A_TOPIC_SIDE));
    }
    sides.into_iter().map(|(name, found)| assemble(&name, found, path).map(|trajectory| (name, trajectory))).collect()
}

/// Content of a message's topic, from the topic's name and from the descriptor in the file.
/// `None` if the topic does not belong to a side, or if its messages are not in protobuf.
fn topic(message: &Message, names: &mut schema::Names) -> std::result::Result<Option<Topic>, DecodeError> {
    let channel = &message.channel;
    let parts = channel.topic.strip_prefix('/').and_then(|rest| rest.split_once('/'));
    let (Some((side, subject)), Some(schema)) = (parts, &channel.schema) else { return Ok(None) };
    if channel.message_encoding != "protobuf" || schema.encoding != "protobuf" {
        return Ok(None);
    }
    // The field `x_m` of `link/crank` is the channel `link.crank.x_m`.
    // The names of error fields end in smaller units, such as `um`, so they match no channel and are not read.
    let (is_grid, subject) = (subject == "grid", subject.replacen('/', ".", 1));
    let field = |name: &String| match is_grid {
        true => Some(Field::Grid(name.clone())),
        false => Channel::named(&format!("{subject}.{name}")).map(Field::Value),
    };
    let fields: BTreeMap<u32, Field> =
        names.of(schema)?.iter().filter_map(|(&tag, name)| Some((tag, field(name)?))).collect();
    Ok((is_grid || !fields.is_empty()).then(|| Topic { side: side.into(), is_grid, fields }))
}

fn collect(
    message: &Message,
    topic: &Topic,
    sides: &mut BTreeMap<String, Found>,
) -> std::result::Result<(), DecodeError> {
    let id = message.channel.id;
    let found = sides.entry(topic.side.clone()).or_default();
    if topic.is_grid {
        found.first = Some(id);
    }
    for (tag, value) in schema::numbers(&message.data)? {
        let column = match topic.fields.get(&tag) {
            Some(Field::Grid(name)) => found.grid.entry(name.clone()).or_default(),
            Some(Field::Value(channel)) => {
                &mut found.columns.entry((id, tag)).or_insert_with(|| (channel.clone(), Vec::new())).1
            }
            None => continue,
        };
        column.push((message.sequence, value));
    }
    Ok(())
}

fn assemble(name: &str, mut found: Found, path: &Path) -> Result<Trajectory> {
    let incomplete = |what: &dyn Display| {
        Error::new(ErrorKind::Input, sentences::in_the_recording_the_side(&path.display(), &name, &what))
            .help(sentences::EVERY_TOPIC_OF_A_SIDE_NEEDS)
    };
    let input = Input::ALL.into_iter().find(|input| found.grid.contains_key(input.key())).unwrap_or_default();
    let mut take = |field: &str| {
        let mut values = found.grid.remove(field).unwrap_or_default();
        values.sort_by_key(|&(sequence, _)| sequence);
        values
    };
    let [times, cranks, rows] = schema::grid_fields(input).map(&mut take);
    let same = |values: &Numbered| {
        values.len() == times.len() && values.iter().zip(&times).all(|(value, time)| value.0 == time.0)
    };
    if times.is_empty() || !same(&cranks) {
        return Err(incomplete(&"its grid"));
    }
    // Programs other than linkproof do not write row numbers. Without row numbers, the order of the samples determines
    // the rows.
    let mut order: Vec<usize> = (0..times.len()).collect();
    if same(&rows) {
        order.sort_by(|&a, &b| rows[a].1.total_cmp(&rows[b].1));
    }
    let ordered = |values: &Numbered| order.iter().map(|&index| values[index].1).collect::<Vec<f64>>();
    let (mut channels, mut columns) = (Vec::new(), Vec::new());
    for (channel, mut values) in found.columns.into_values() {
        values.sort_by_key(|&(sequence, _)| sequence);
        if !same(&values) {
            return Err(incomplete(&channel));
        }
        columns.push(ordered(&values));
        channels.push(channel);
    }
    Ok(Trajectory::new(ordered(&times), ordered(&cranks), channels, columns)?.of_input(input))
}
