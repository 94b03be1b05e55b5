//! Mechanisms of other programs as scenarios: share links of PMKS+, models for MuJoCo, files of Linkage.
//!
//! A reader converts a source into `Parts`: links in their start pose, joints, drives and loads.
//! `finish` chooses a grid and the assembly modes of the start pose, and `write` writes the text of the scenario.
//! Parts of the source that a reader does not understand are listed by name.

mod finish;
mod linkage2;
mod mjcf;
mod names;
mod parts;
mod pmks;
mod write;
mod xml;

pub use finish::ImportedScenario;

use crate::sentences;
use linkage::error::{ErrorKind, Result};
use std::path::Path;

/// The mechanism in `source` as a scenario called `name`.
/// The source is a share link of PMKS+ or PMKS, or the text of the file at `path`.
///
/// # Errors
/// [`ErrorKind::Input`] for a damaged source. The error names the line of the file, or the parameter of the share link.
/// [`ErrorKind::Unsupported`] for a source that this version does not know, or that has too many parts.
pub fn import(source: &str, path: &Path, name: &str) -> Result<ImportedScenario> {
    let source = source.trim_start_matches('\u{feff}').trim();
    if !source.starts_with('<') {
        return Ok(finish::finished(pmks::parts(source)?, name));
    }
    let file = xml::XmlFile::of(source, path)?;
    let root = file.tree.root_element();
    let parts = match root.tag_name().name() {
        "mujoco" => mjcf::parts(&file)?,
        "linkage2" => linkage2::parts(&file)?,
        _ => {
            let message = sentences::THE_XML_IS_OF_NO_KNOWN_KIND.into();
            return Err(file.fault(root, ErrorKind::Unsupported, message, sentences::GIVE_A_LINK_OR_A_FILE));
        }
    };
    Ok(finish::finished(parts, name))
}
