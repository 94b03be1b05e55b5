//! Tables of other programs: CSV and Parquet files, and which of their columns are which channels.

mod held;
#[cfg(feature = "parquet")]
mod parquet_file;
mod source;

pub use columns::Table as Raw;
pub use held::{At, By, Column, Held, Instants};
pub use source::May;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use self::source::{MAGIC, text, unread};
use linkage::error::{Error, ErrorKind, Result};

/// Reads a file: Parquet by its first bytes, else text with separated columns.
///
/// # Errors
/// [`ErrorKind::Io`] if it cannot be read, [`ErrorKind::Input`] if it is no table of numbers, with the place.
pub fn load(path: impl AsRef<Path>) -> Result<Raw> {
    load_within(path.as_ref(), &|_, _| Ok(()))
}

/// The same where memory is asked for before it is taken: before a file is read, by its size, and before its numbers
/// are, by its rows and cells.
///
/// # Errors
/// Those of [`load`], and what `may` says.
pub fn load_within(path: &Path, may: May) -> Result<Raw> {
    let mut file = File::open(path).map_err(|error| unread(path, &error))?;
    let about = file.metadata().map_err(|error| unread(path, &error))?;
    let size = about.is_file().then_some(about.len());
    // A pipe gives its first bytes once.
    let mut first = Vec::new();
    file.by_ref().take(MAGIC.len() as u64).read_to_end(&mut first).map_err(|error| unread(path, &error))?;
    let raw = match (first == MAGIC, size) {
        #[cfg(feature = "parquet")]
        (true, Some(size)) => parquet_file::read(path, size, may)?,
        #[cfg(not(feature = "parquet"))]
        (true, Some(_)) => {
            let message = format!("the table {} is a Parquet file, which this build does not read", path.display());
            return Err(Error::new(ErrorKind::Unsupported, message)
                .help("build with the feature `parquet`, or write it as CSV"));
        }
        (true, None) => {
            let message = format!("the table {} is a Parquet file that comes through a pipe", path.display());
            return Err(Error::new(ErrorKind::Input, message).help("write it to a file first: its end is read first"));
        }
        (false, size) => text(path, first.as_slice().chain(file), size, may)?,
    };
    if raw.is_empty() {
        let message = format!("{} has no rows of numbers", path.display());
        return Err(Error::new(ErrorKind::Input, message).help("give a table with a header and one row per instant"));
    }
    Ok(raw)
}
