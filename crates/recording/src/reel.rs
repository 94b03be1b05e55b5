//! A recording in memory, for playback: its topics, and its messages in order of time.

use super::pour::{lasts, pour};
use super::recording::Recording;
use super::sink::{MessageKind, Sink};
use super::view::turn;
use super::write::{as_shown, check};
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use mcap::{McapError, McapResult};

/// A recording in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Reel {
    /// Names of the topics, and the kinds of their messages.
    pub topics: Vec<(String, MessageKind)>,
    /// Factor by which the log time is slower than the simulation.
    pub slow: f64,
    /// Log time of one revolution of the crank (s). If the recording is shorter than a revolution, its duration is
    /// used.
    pub turn: f64,
    entries: Vec<Entry>,
    /// Indices of the messages of every topic, in ascending order.
    own: Vec<Vec<usize>>,
    data: Vec<u8>,
}

/// A message of a reel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReelMessage<'a> {
    /// Log time (ns).
    pub time: u64,
    /// Number of the message's topic.
    pub topic: u16,
    /// Content of the message.
    pub data: &'a [u8],
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry {
    time: u64,
    topic: u16,
    /// End of the message in `data` of the reel. The message begins at the end of the previous message.
    end: usize,
}

/// Makes a reel: everything that the recording's file would contain for viewers.
///
/// # Errors
/// The errors of [`write`](super::write()) that do not concern the file itself.
pub fn reel(recording: &Recording) -> Result<Reel> {
    check(recording)?;
    let poured = as_shown(recording, |recording, drawn| {
        let slow = recording.show.slow;
        let lasts = lasts(recording) * slow;
        let turn = recording.sides.first().map_or(lasts, |side| turn(lasts, side.trajectory));
        let mut reel = Reel { topics: Vec::new(), slow, turn, entries: Vec::new(), own: Vec::new(), data: Vec::new() };
        pour(recording, drawn, &mut reel).map(|()| reel)
    });
    poured.map_err(|error| Error::new(ErrorKind::Unsupported, sentences::the_recording_cannot_be_played(&error)))
}

impl Reel {
    /// Number of messages.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether the reel has no messages.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Log time of the last message (ns).
    #[must_use]
    pub fn lasts(&self) -> u64 {
        self.entries.last().map_or(0, |last| last.time)
    }

    /// Number of messages up to and including a log time (ns).
    #[must_use]
    pub fn until(&self, time: u64) -> usize {
        self.entries.partition_point(|entry| entry.time <= time)
    }

    /// The message with this index.
    ///
    /// # Panics
    /// If the index is too large.
    #[must_use]
    pub fn message(&self, index: usize) -> ReelMessage<'_> {
        let Entry { time, topic, end } = self.entries[index];
        let start = if index == 0 { 0 } else { self.entries[index - 1].end };
        ReelMessage { time, topic, data: &self.data[start..end] }
    }

    /// The last message of a topic among the first `count` messages.
    #[must_use]
    pub fn latest(&self, topic: u16, count: usize) -> Option<ReelMessage<'_>> {
        let own = self.own.get(usize::from(topic))?;
        let before = own.partition_point(|&index| index < count).checked_sub(1)?;
        Some(self.message(own[before]))
    }
}

impl Sink for Reel {
    fn topic(&mut self, name: &str, kind: &MessageKind) -> McapResult<u16> {
        let number = u16::try_from(self.topics.len()).map_err(|_| McapError::TooManyChannels)?;
        self.topics.push((name.into(), kind.clone()));
        self.own.push(Vec::new());
        Ok(number)
    }

    fn put(&mut self, topic: u16, _: u32, time: u64, data: &[u8]) -> McapResult<()> {
        self.data.extend_from_slice(data);
        self.own[usize::from(topic)].push(self.entries.len());
        self.entries.push(Entry { time, topic, end: self.data.len() });
        Ok(())
    }
}
