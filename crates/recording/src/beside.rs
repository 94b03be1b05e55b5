//! Path of a recording's file.
//! A recording replaces an older recording of the same run.
//! If the usual name belongs to another run, the recording gets a different name in the same directory.

use crate::sentences;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{fs, io};

use super::raw;
use linkage::error::{Error, ErrorKind, Result};
use mcap::records::op;

/// Beginning of the library's name in the header of a recording.
pub(super) const LIBRARY: &str = "linkproof ";

/// Largest number of recordings with the same base name in a directory.
const MOST: usize = 1000;

/// Prefixes of the metadata keys that describe what the user requests in addition to the scenario's text.
const ASKED: [&str; 9] = [
    "modes",
    "parameters",
    "start_crank_deg",
    "start_joint_deg",
    "start_slide_mm",
    "grid_",
    "only",
    "reference",
    "record_hz",
];
/// Prefix of the metadata keys of the engine's settings. A proof may choose these settings itself, so differences in
/// the user's requests or in the scenario's text are reported first.
const ENGINE: &str = "engine";

/// Where a recording goes.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordingPlace {
    /// Path of the recording's file.
    pub path: PathBuf,
    /// Difference from the recording that has the usual name; `None` if this recording has the usual name.
    pub other: Option<String>,
}

/// Path of a run's recording: `NAME.mcap` in the directory, or `NAME-2.mcap`, ... if the name belongs to another run.
/// `text` is the scenario's text; for `metadata` see [`Recording`](super::Recording).
///
/// # Errors
/// [`ErrorKind::Io`](linkage::ErrorKind::Io) if there are a thousand recordings of other runs.
pub fn place(directory: &Path, name: &str, text: &str, metadata: &BTreeMap<String, String>) -> Result<RecordingPlace> {
    let mut other = None;
    for number in 1..=MOST {
        let path = match number {
            1 => directory.join(format!("{name}.mcap")),
            _ => directory.join(format!("{name}-{number}.mcap")),
        };
        match difference(&path, text, metadata) {
            None => return Ok(RecordingPlace { path, other }),
            Some(found) => other = other.or(Some(found)),
        }
    }
    let message = sentences::holds_recordings_of_other_runs(&directory.display(), &MOST, &name);
    Err(Error::new(ErrorKind::Io, message).help(sentences::REMOVE_THOSE_THAT_ARE_NOT_NEEDED))
}

/// Difference between the file at `path` and the recording of a run, in words.
/// `None` if the file and the recording do not differ, or if the file does not exist.
fn difference(path: &Path, text: &str, metadata: &BTreeMap<String, String>) -> Option<String> {
    match fs::symlink_metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return None,
        Ok(found) if found.is_file() => {}
        Ok(found) if found.is_symlink() => return Some(sentences::IT_IS_A_SYMBOLIC_LINK.into()),
        Ok(_) | Err(_) => return Some(sentences::IT_IS_NO_FILE.into()),
    }
    let Ok(bytes) = fs::read(path) else { return Some(sentences::IT_CANNOT_BE_READ.into()) };
    let found = described(&bytes).filter(|_| raw::is_by(&bytes, LIBRARY));
    let Some((old_text, old)) = found else { return Some(sentences::IT_IS_NO_RECORDING_OF_A_RUN.into()) };
    let changed = |start: &str| {
        let mut keys =
            old.keys().chain(metadata.keys()).filter(|key| key.starts_with(start) && !key.ends_with("_verdict"));
        keys.find(|key| old.get(*key) != metadata.get(*key))
    };
    let key = match ASKED.into_iter().find_map(changed) {
        Some(key) => key,
        None if old_text != text.as_bytes() => return Some(sentences::ITS_SCENARIO_HAS_ANOTHER_TEXT.into()),
        None => changed(ENGINE)?,
    };
    let told = |all: &BTreeMap<String, String>| all.get(key).map_or("none".into(), |value| format!("\"{value}\""));
    Some(sentences::its_is_not(&key, &told(&old), &told(metadata)))
}

/// Text of the scenario, and metadata.
type Described = (Vec<u8>, BTreeMap<String, String>);

/// Scenario text and metadata of a recording. `None` if the text or the metadata is missing.
pub(super) fn described(bytes: &[u8]) -> Option<Described> {
    let (mut text, mut metadata) = (None, None);
    for (code, content) in raw::records(bytes) {
        match code {
            op::ATTACHMENT => text = text.or_else(|| raw::attachment(content, "scenario.toml")),
            op::METADATA => {
                metadata = metadata.or_else(|| raw::metadata(content).filter(|own| own.name == "linkproof"))
            }
            // The scenario text and the metadata are at the beginning of the file, so the search ends at the first data
            // chunk.
            op::CHUNK | op::DATA_END => break,
            _ => {}
        }
    }
    Some((text?.to_vec(), metadata?.metadata))
}
