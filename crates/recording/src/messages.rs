//! Reads the messages of an MCAP file from an untrusted source.
//!
//! The readers of the MCAP library trust the record lengths in a file.
//! If these lengths are damaged, the library's readers request more memory than exists, or index beyond a record.
//! The reader in this module limits the length of a record to the length of the file.
//! If the file is shorter than [`SMALL`], the limit is [`SMALL`].
//! The reader in this module parses only the kinds of records that messages need.

use crate::sentences;
use std::borrow::Cow;
use std::path::Path;

use super::raw;
use linkage::error::{Error, ErrorKind, Result};
use mcap::read::ChannelAccumulator;
use mcap::records::{Record, op};
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{McapError, McapResult, Message, parse_record};
use prost::DecodeError;

/// Record length that is allowed even in a shorter file, because a decompressed record may be longer than its file.
const SMALL: usize = 1 << 20;

/// Calls `visit` for every message, in the order of the file. Error messages name the file by its `path`.
///
/// # Errors
/// [`ErrorKind::Io`] for a file that is cut off or damaged, and for a message that `visit` cannot read.
pub(super) fn each(
    bytes: &[u8],
    path: &Path,
    mut visit: impl FnMut(&Message) -> std::result::Result<(), DecodeError>,
) -> Result<()> {
    walk(bytes, &mut visit).map_err(|error| {
        Error::new(ErrorKind::Io, sentences::the_recording_is_cut_off(&path.display(), &error))
            .help(sentences::RECORD_IT_AGAIN_OR_SAVE_WHAT)
    })
}

fn walk(
    bytes: &[u8],
    visit: &mut dyn FnMut(&Message) -> std::result::Result<(), DecodeError>,
) -> std::result::Result<(), Box<dyn std::error::Error>> {
    let longest = bytes.len().max(SMALL);
    let ([told, _], mut seen) = (raw::expanded(bytes), 0);
    let options = LinearReaderOptions::default().with_validate_chunk_crcs(true).with_record_length_limit(longest);
    let mut reader = LinearReader::new_with_options(options);
    let mut known = ChannelAccumulator::default();
    let (mut left, mut is_data) = (bytes, true);
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(wished) => {
                let (next, rest) = left.split_at(wished.min(left.len()));
                reader.insert(next.len()).copy_from_slice(next);
                reader.notify_read(next.len());
                left = rest;
            }
            // The summary section after the data is skipped, because it repeats earlier records.
            LinearReadEvent::Record { opcode: op::DATA_END, .. } => is_data = false,
            LinearReadEvent::Record { opcode, data } => {
                // The file states its decompressed size. If its records are longer in total, the file is refused.
                seen += 9 + data.len() as u64;
                if seen > told {
                    return Err(McapError::ChunkTooLarge(seen).into());
                }
                if is_data && let Some(message) = message(opcode, data, &mut known)? {
                    visit(&message)?;
                }
            }
        }
    }
    Ok(())
}

/// The message in a record, if the record contains one. Schemas and channels are stored for later messages.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the MCAP library")]
fn message<'a>(opcode: u8, data: &'a [u8], known: &mut ChannelAccumulator<'static>) -> McapResult<Option<Message<'a>>> {
    if !matches!(opcode, op::SCHEMA | op::CHANNEL | op::MESSAGE) {
        return Ok(None);
    }
    match parse_record(opcode, data)? {
        Record::Schema { header, data } => known.add_schema(header, Cow::Owned(data.into_owned()))?,
        Record::Channel(channel) => known.add_channel(channel)?,
        Record::Message { header, data } => {
            let channel = known.get(header.channel_id);
            let channel = channel.ok_or(McapError::UnknownChannel(header.sequence, header.channel_id))?;
            let (log_time, publish_time) = (header.log_time, header.publish_time);
            return Ok(Some(Message { channel, sequence: header.sequence, log_time, publish_time, data }));
        }
        _ => {}
    }
    Ok(None)
}
