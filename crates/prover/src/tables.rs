//! Tables of other programs: CSV and Parquet files, and the mapping of their columns to channels.

mod held;
#[cfg(feature = "parquet")]
mod parquet_file;
mod source;

use crate::sentences;
pub use columns::TextTable as Raw;
pub use held::{By, Held, Instants, PartyColumn, RowKey};
pub use source::May;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use self::source::{MAGIC, text, unread};
use linkage::error::{Error, ErrorKind, Result};

/// Reads a file. The first bytes identify Parquet; any other file is text with separated columns.
///
/// # Errors
/// [`ErrorKind::Io`] if the file cannot be read, or if a Parquet file is damaged.
/// [`ErrorKind::Input`], with the location, if it is not a table of numbers.
/// [`ErrorKind::Unsupported`] for a Parquet file, in a build without the feature `parquet`.
pub fn load(path: impl AsRef<Path>) -> Result<Raw> {
    load_within(path.as_ref(), &|_, _| Ok(()))
}

/// Like [`load`], but calls `may` before memory is allocated.
/// `may` receives the bytes to be allocated and the number of rows.
/// For a text file, `may` is called twice: before the file is read, with the file's size and 0 rows; and before the
/// values are stored, with the bytes of text and cells and the number of rows.
/// For a Parquet file, `may` is called once, before the values are stored.
///
/// # Errors
/// The errors of [`load`], and the errors that `may` returns.
pub fn load_within(path: &Path, may: May) -> Result<Raw> {
    let mut file = File::open(path).map_err(|error| unread(path, &error))?;
    let about = file.metadata().map_err(|error| unread(path, &error))?;
    let size = about.is_file().then_some(about.len());
    // The first bytes are kept, because they cannot be read from a pipe a second time.
    let mut first = Vec::new();
    file.by_ref().take(MAGIC.len() as u64).read_to_end(&mut first).map_err(|error| unread(path, &error))?;
    let raw = match (first == MAGIC, size) {
        #[cfg(feature = "parquet")]
        (true, Some(size)) => parquet_file::read(path, size, may)?,
        #[cfg(not(feature = "parquet"))]
        (true, Some(_)) => {
            let message = sentences::the_table_is_a_parquet_file_which_this_build(&path.display());
            return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::BUILD_WITH_THE_FEATURE_PARQUET));
        }
        (true, None) => {
            let message = sentences::the_table_is_a_parquet_file(&path.display());
            return Err(Error::new(ErrorKind::Input, message).help(sentences::WRITE_IT_TO_A_FILE_FIRST));
        }
        (false, size) => text(path, first.as_slice().chain(file), size, may)?,
    };
    if raw.is_empty() {
        let message = sentences::has_no_rows_of_numbers(&path.display());
        return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_A_TABLE_WITH_A_HEADER));
    }
    Ok(raw)
}
