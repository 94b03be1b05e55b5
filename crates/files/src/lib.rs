//! Writes files whole or not at all.
//! It replaces a file only if the caller named it or this program wrote it.
//!
//! The content goes to a new, locked temporary file in the same directory, which then replaces the file.
//! A run that fails or is killed therefore leaves an older file unchanged.
//! Two runs that write to one path do not mix.

mod seal;
mod sentences;
mod target;
mod temporary;
mod text;

use std::fs::File;
use std::io;

pub use seal::{is_sealed, sealed};
pub use target::{OutputTarget, may_fill, may_write, size, unwritten};
pub use text::{LARGEST, read_named, read_text, text, text_from, visible, visible_lines, way_out};

use target::Place;
use temporary::{clear, create, directory_of};

/// Lets `fill` write the file of a target. The file is replaced when everything is written.
/// If the caller named a path that is not a regular file, such as a pipe, or is already open, such as `/dev/stdout`,
/// the content is written to it directly.
///
/// # Errors
/// Those of `fill` and of the file system; [`io::ErrorKind::AlreadyExists`] if an existing file may not be replaced.
/// The existing file is then unchanged.
pub fn replace<E: From<io::Error>>(target: &OutputTarget, fill: impl FnOnce(&File) -> Result<(), E>) -> Result<(), E> {
    let (place, old) = match target.place()? {
        Place::Open(path) => return fill(&File::options().write(true).open(path)?),
        Place::File(place, old) => (place, old),
    };
    let directory = directory_of(&place);
    clear(directory);
    let temporary = create(directory)?;
    if let Some(old) = &old {
        temporary.as_file().set_permissions(old.permissions())?;
    }
    fill(temporary.as_file())?;
    temporary.as_file().sync_all()?;
    // A file that has appeared meanwhile may not be replaced either.
    target.place()?;
    temporary.persist(&place).map_err(|error| error.error)?;
    Ok(())
}
