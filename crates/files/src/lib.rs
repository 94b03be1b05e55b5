//! Files that appear whole or not at all, and replace nothing that is not this program's or that nobody named.
//!
//! The content goes to a temporary file in the same directory, created new and locked, which then takes the place of
//! the file. So a run that fails or is killed leaves an older file alone, and two runs to one path do not mix.

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

/// Lets `fill` write the file of a target, which is replaced when all is written. What is no regular file, such as a
/// pipe, and what is open already, such as `/dev/stdout`, is written to as it is, if the caller named it.
///
/// # Errors
/// Those of `fill` and of the file system; [`io::ErrorKind::AlreadyExists`] for what may not be replaced. What is there
/// is then what it was.
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
    // What has appeared meanwhile may not be replaced either.
    target.place()?;
    temporary.persist(&place).map_err(|error| error.error)?;
    Ok(())
}
