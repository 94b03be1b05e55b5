//! Files that appear whole or not at all.
//!
//! The content goes to a temporary file in the same directory, created new and locked, which then takes the place of
//! the file. So a run that fails or is killed leaves an older file alone, and two runs to one path do not mix.

mod target;
mod temporary;
mod text;

use std::fs::{self, File};
use std::io;
use std::path::Path;

pub(crate) use target::{may_fill, may_write, size, unwritten};
pub(crate) use text::{read_named, read_text, text, text_from, way_out};

use temporary::{clear, create, directory_of};

/// Lets `fill` write the file at `path`, which is replaced when all is written. A link is followed to the file that it
/// names. What is no regular file, such as a pipe, and what is open already, such as `/dev/stdout`, is written to as it
/// is.
///
/// # Errors
/// Those of `fill` and of the file system. The file at `path` is then what it was.
pub(crate) fn replace<E: From<io::Error>>(path: &Path, fill: impl FnOnce(&File) -> Result<(), E>) -> Result<(), E> {
    let old = fs::metadata(path).ok();
    if path.starts_with("/dev") || old.as_ref().is_some_and(|old| !old.is_file()) {
        return fill(&File::options().write(true).open(path)?);
    }
    let place = match old {
        Some(_) => fs::canonicalize(path)?,
        None => path.to_path_buf(),
    };
    let directory = directory_of(&place);
    clear(directory);
    let temporary = create(directory)?;
    if let Some(old) = old {
        temporary.as_file().set_permissions(old.permissions())?;
    }
    fill(temporary.as_file())?;
    temporary.as_file().sync_all()?;
    temporary.persist(&place).map_err(|error| error.error)?;
    Ok(())
}
