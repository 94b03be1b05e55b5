//! Writes files completely or not at all.
//! An existing file is replaced only if the caller named it or this program wrote it.
//!
//! The content is first written to a new, locked temporary file in the directory of the target.
//! When the temporary file is complete, it replaces the target.
//! A run that fails or is killed therefore leaves an older file unchanged.
//! If two runs write to one path, their contents do not mix.

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
pub use temporary::is_temporary;
use temporary::{clear, create, directory_of};

/// Lets `fill` write the content of a target. The file is replaced when the whole content is written.
/// The caller may name a path that is not a regular file, such as a pipe, or a path that is already open, such as
/// `/dev/stdout`. The content is then written to that path directly.
///
/// # Errors
/// The errors of `fill` and of the file system.
/// [`io::ErrorKind::AlreadyExists`] if an existing file may not be replaced. The existing file then stays unchanged.
pub fn replace<E: From<io::Error>>(target: &OutputTarget, fill: impl FnOnce(&File) -> Result<(), E>) -> Result<(), E> {
    written(target, fill, true)
}

/// Replaces a file whose content can be computed again if the file is lost.
/// Unlike [`replace`], this function does not wait until the device has stored the content, and it does not remove
/// temporary files of killed runs. After a loss of power, the file may be incomplete.
///
/// # Errors
/// The errors of [`replace`].
pub fn put<E: From<io::Error>>(target: &OutputTarget, fill: impl FnOnce(&File) -> Result<(), E>) -> Result<(), E> {
    written(target, fill, false)
}

fn written<E: From<io::Error>>(
    target: &OutputTarget,
    fill: impl FnOnce(&File) -> Result<(), E>,
    is_lasting: bool,
) -> Result<(), E> {
    let (place, old) = match target.place()? {
        Place::Open(path) => return fill(&File::options().write(true).open(path)?),
        Place::File(place, old) => (place, old),
    };
    let directory = directory_of(&place);
    if is_lasting {
        clear(directory);
    }
    let temporary = create(directory)?;
    if let Some(old) = &old {
        temporary.as_file().set_permissions(old.permissions())?;
    }
    fill(temporary.as_file())?;
    if is_lasting {
        temporary.as_file().sync_all()?;
    }
    // The rule for replacing an existing file is checked again, because the file may have appeared since the first
    // check.
    target.place()?;
    temporary.persist(&place).map_err(|error| error.error)?;
    Ok(())
}
