//! The MCAP file itself: options, topics, messages.

use super::beside::LIBRARY;
use super::pour::SECOND;
use super::recording::{Recording, Show};
use super::sink::{MessageKind, Sink};
use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Attachment, McapError, McapResult, WriteOptions, Writer};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;

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
            // If such a writer were killed before the correction, no program could open the file. Seeking is therefore
            // disabled.
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
        // so it is continued.
        if time / SECOND > self.flushed && self.pending > CHUNK as usize / 8 {
            self.writer.flush()?;
            (self.flushed, self.pending) = (time / SECOND, 0);
        }
        self.pending += data.len();
        let header = MessageHeader { channel_id: topic, sequence, log_time: time, publish_time: time };
        self.writer.write_to_known_channel(&header, data)
    }
}
