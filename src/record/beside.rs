//! Where a recording goes: in place of an older one of the same run, else beside it.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use linkage::error::{Error, ErrorKind, Result};
use mcap::{McapResult, Summary};

/// Most recordings of one name in a directory.
const MOST: usize = 1000;

/// Beginnings of the keys that tell what was asked for beyond the scenario's text.
const ASKED: [&str; 7] = ["modes", "parameters", "start_crank_deg", "grid_", "only", "reference", "record_hz"];
/// Beginning of the keys of the engine's settings, which a proof may have found.
const ENGINE: &str = "engine";

/// Where a recording goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its file.
    pub path: PathBuf,
    /// How the recording differs that keeps the usual name; `None` if it has that name itself.
    pub other: Option<String>,
}

/// `NAME.mcap` in the directory, or `NAME-2.mcap`, `NAME-3.mcap`, ...: the first that is free, or that holds the
/// recording of the same scenario with the same settings.
///
/// # Errors
/// [`ErrorKind::Io`] if there are a thousand recordings of other runs.
pub(super) fn place(directory: &Path, name: &str, text: &str, metadata: &BTreeMap<String, String>) -> Result<Place> {
    let mut other = None;
    for number in 1..=MOST {
        let path = match number {
            1 => directory.join(format!("{name}.mcap")),
            _ => directory.join(format!("{name}-{number}.mcap")),
        };
        match difference(&path, text, metadata) {
            None => return Ok(Place { path, other }),
            Some(found) => other = other.or(Some(found)),
        }
    }
    let message = format!("{} holds {MOST} recordings of other runs of {name}", directory.display());
    Err(Error::new(ErrorKind::Io, message).help("remove those that are not needed any more, or record elsewhere"))
}

/// How the recording at `path` differs from that of a run; `None` if it does not, or if there is none.
fn difference(path: &Path, text: &str, metadata: &BTreeMap<String, String>) -> Option<String> {
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return None,
        Err(_) => return Some("it cannot be read".into()),
    };
    let Ok(Some((old_text, old))) = described(&bytes) else { return Some("it is no recording of a run".into()) };
    let changed = |start: &str| {
        let mut keys =
            old.keys().chain(metadata.keys()).filter(|key| key.starts_with(start) && !key.ends_with("_verdict"));
        keys.find(|key| old.get(*key) != metadata.get(*key))
    };
    let key = match ASKED.into_iter().find_map(changed) {
        Some(key) => key,
        None if old_text != text.as_bytes() => return Some("its scenario has another text".into()),
        None => changed(ENGINE)?,
    };
    let told = |all: &BTreeMap<String, String>| all.get(key).map_or("none".into(), |value| format!("\"{value}\""));
    Some(format!("its {key} is {}, not {}", told(&old), told(metadata)))
}

/// Text of the scenario, and metadata.
type Described = (Vec<u8>, BTreeMap<String, String>);

/// What describes a recording; `None` if nothing does.
pub(super) fn described(bytes: &[u8]) -> McapResult<Option<Described>> {
    let Some(summary) = Summary::read(bytes)? else { return Ok(None) };
    let text = summary.attachment_indexes.iter().find(|index| index.name == "scenario.toml");
    let metadata = summary.metadata_indexes.iter().find(|index| index.name == "linkproof");
    let (Some(text), Some(metadata)) = (text, metadata) else { return Ok(None) };
    let text = mcap::read::attachment(bytes, text)?.data.into_owned();
    Ok(Some((text, mcap::read::metadata(bytes, metadata)?.metadata)))
}
