//! `format` and `name`, which every file has.

use super::reader::Table;
use linkage::error::{ErrorKind, Result};
use linkage::mechanism::LONGEST_NAME;

/// Version of the file format that this crate reads.
pub const FORMAT: i64 = 1;

/// Checks the version of the format.
pub fn check_format(root: &mut Table) -> Result<()> {
    if root.is_empty() {
        let error = root.fault("the file holds no scenario");
        return Err(error.help("a scenario starts with `format = 1`; docs/scenario.md builds one up step by step"));
    }
    match root.integer("format")? {
        FORMAT => Ok(()),
        other => {
            let message = format!("format {other} is not handled by this version");
            root.unsupported("format", message, format!("this version reads `format = {FORMAT}`"))
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
pub const NAME_HELP: &str =
    "it names files: use at most 100 lower-case letters, digits and `_`, and no name of a device such as `con`";

/// The scenario's name.
pub fn name(root: &mut Table) -> Result<String> {
    let name = root.string("name")?;
    if is_name(&name) {
        return Ok(name);
    }
    let error = root.wrong(ErrorKind::Input, "name", format!("\"{name}\" cannot be the name of a scenario"));
    root.instead(name, error.help(NAME_HELP))
}
