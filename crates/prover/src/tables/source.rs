//! Reads text with separated columns, decides whether memory for a table is allowed, and reports a table that cannot be
//! read.

use crate::sentences;
use std::io::{self, Read};
use std::path::Path;

use columns::{TableFault, TextTable};
use files::LARGEST;
use linkage::error::{Error, ErrorKind, Place, Result};

/// First and last bytes of a Parquet file.
pub(super) const MAGIC: [u8; 4] = *b"PAR1";

/// Decides whether this many bytes may be allocated for a table with this many rows.
/// The number of rows is 0 until the rows are counted.
pub type May<'a> = &'a dyn Fn(f64, usize) -> Result<()>;

pub(super) fn unread(path: &Path, error: &io::Error) -> Error {
    Error::new(ErrorKind::Io, sentences::the_table_cannot_be_read(&path.display(), &error))
        .help(sentences::GIVE_A_SCENARIO_TOML_A_RECORDING)
}

/// Reads a text of `size` bytes. `None` means that the source is not a regular file but, for example, a pipe.
pub(super) fn text(path: &Path, from: impl Read, size: Option<u64>, may: May) -> Result<TextTable> {
    // At most `LARGEST` bytes are read, however large the file is.
    may(size.unwrap_or(LARGEST).min(LARGEST) as f64, 0)?;
    let text = files::text_from(from).map_err(|error| unread(path, &error))?;
    // Approximate number of rows: one line may be a header, and lines may be comments.
    let rows = text.bytes().filter(|&byte| byte == b'\n').count().saturating_sub(1);
    may(text.len() as f64 + columns::bytes(&text), rows)?;
    columns::read(&text).map_err(|TableFault { at, message, help }| {
        let place = Place { file: path.into(), text: text.as_str().into(), span: at };
        Error::new(ErrorKind::Input, message).at(place).help(help)
    })
}
