//! `format` and `name`, which every file has.

use super::reader::TomlTable;
use crate::sentences;
use linkage::error::{ErrorKind, Result};
use linkage::mechanism::LONGEST_NAME;

/// Version of the file format that this crate reads.
pub const FORMAT: i64 = 1;

/// Checks the version of the format.
pub fn check_format(root: &mut TomlTable) -> Result<()> {
    if root.is_empty() {
        let error = root.fault(sentences::THE_FILE_HOLDS_NO_SCENARIO);
        return Err(error.help(sentences::A_SCENARIO_STARTS_WITH_FORMAT));
    }
    match root.integer("format")? {
        FORMAT => Ok(()),
        other => {
            let message = sentences::format_is_not_handled_by_this_version(&other);
            root.unsupported("format", message, sentences::this_version_reads_format(&FORMAT))
        }
    }
}

/// Whether a name can be used in file names.
pub fn is_name(name: &str) -> bool {
    let is_reserved = match name.as_bytes() {
        b"con" | b"prn" | b"aux" | b"nul" => true,
        [b'c', b'o', b'm', digit] | [b'l', b'p', b't', digit] => digit.is_ascii_digit(),
        _ => false,
    };
    !is_reserved
        && (1..=LONGEST_NAME).contains(&name.len())
        && name.bytes().all(|byte| matches!(byte, b'a'..=b'z' | b'0'..=b'9' | b'_'))
}

/// Help for names that cannot be used in file names.
pub const NAME_HELP: &str = sentences::IT_NAMES_FILES_USE_AT_MOST;

/// The scenario's name.
pub fn name(root: &mut TomlTable) -> Result<String> {
    let name = root.string("name")?;
    if is_name(&name) {
        return Ok(name);
    }
    let error = root.wrong(ErrorKind::Input, "name", sentences::cannot_be_the_name_of_a_scenario(&name));
    root.instead(name, error.help(NAME_HELP))
}
