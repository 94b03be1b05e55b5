//! Raw records of an MCAP file, with checked lengths, to examine a file before the MCAP library reads it.

use mcap::parse_record;
use mcap::records::{Metadata, Record, op};

/// Decompressed size (bytes) that is always allowed.
const ANY: u64 = 128 << 20;
/// Largest allowed ratio of decompressed size to file size. In recordings of this program the ratio is three.
const EACH: u64 = 16;

/// Codes and contents of the records outside chunks, up to the first truncated or damaged record.
pub(super) fn records(bytes: &[u8]) -> impl Iterator<Item = (u8, &[u8])> {
    let mut left = bytes.strip_prefix(mcap::MAGIC).unwrap_or_default();
    std::iter::from_fn(move || {
        let (code, rest) = left.split_first()?;
        let (length, rest) = rest.split_first_chunk()?;
        let (content, rest) = rest.split_at_checked(usize::try_from(u64::from_le_bytes(*length)).ok()?)?;
        left = rest;
        Some((*code, content))
    })
}

/// Decompressed size of a file, as its chunks state it, and the largest size allowed for a file of this length (bytes).
pub(super) fn expanded(bytes: &[u8]) -> [u64; 2] {
    let chunks = records(bytes).filter(|(code, _)| *code == op::CHUNK);
    // The times of the first and the last message precede the length, so the length begins at byte 16.
    let told = |content: &[u8]| content.get(16..24)?.first_chunk().map(|length| u64::from_le_bytes(*length));
    let length = bytes.len() as u64;
    let chunks = chunks.filter_map(|(_, content)| told(content)).fold(length, u64::saturating_add);
    [chunks, ANY.max(length.saturating_mul(EACH))]
}

/// Whether the name of the library in the header begins with `library`.
pub(super) fn is_by(bytes: &[u8], library: &str) -> bool {
    let header = || -> Option<bool> {
        let (_, mut content) = records(bytes).next().filter(|(code, _)| *code == op::HEADER)?;
        let _profile = part::<4>(&mut content)?;
        Some(part::<4>(&mut content)?.starts_with(library.as_bytes()))
    };
    header().unwrap_or(false)
}

/// Data of the attachment in a record; `None` if its name is not `name`.
pub(super) fn attachment<'a>(content: &'a [u8], name: &str) -> Option<&'a [u8]> {
    // Two times precede the name, so the name begins at byte 16.
    let mut left = content.get(16..)?;
    let own = part::<4>(&mut left)?;
    let _kind = part::<4>(&mut left)?;
    part::<8>(&mut left).filter(|_| own == name.as_bytes())
}

/// The metadata in a record; `None` for other records.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the MCAP library")]
pub(super) fn metadata(content: &[u8]) -> Option<Metadata> {
    match parse_record(op::METADATA, content).ok()? {
        Record::Metadata(metadata) => Some(metadata),
        _ => None,
    }
}

/// Reads a field that begins with its length, a number of `N` bytes.
fn part<'a, const N: usize>(left: &mut &'a [u8]) -> Option<&'a [u8]> {
    let (length, rest) = left.split_first_chunk::<N>()?;
    let length = length.iter().rev().fold(0, |number: u64, &byte| number << 8 | u64::from(byte));
    let (own, rest) = rest.split_at_checked(usize::try_from(length).ok()?)?;
    *left = rest;
    Some(own)
}
