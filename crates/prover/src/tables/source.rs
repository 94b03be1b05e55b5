//! What is asked before a table is read, and what is said where it cannot be.

use std::io;
use std::path::Path;

use linkage::error::{Error, ErrorKind, Result};

/// What a Parquet file begins and ends with.
pub(super) const MAGIC: [u8; 4] = *b"PAR1";

/// Whether so many bytes may be taken for a table of so many rows; 0 before they are counted.
pub type May<'a> = &'a dyn Fn(f64, usize) -> Result<()>;

pub(super) fn unread(path: &Path, error: &io::Error) -> Error {
    Error::new(ErrorKind::Io, format!("the table {} cannot be read: {error}", path.display()))
        .help("give a scenario (.toml), a recording (.mcap), a table of text (.csv) or a Parquet file")
}
