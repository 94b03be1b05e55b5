//! Text with separated columns.

use std::io::Read;
use std::path::Path;

use columns::{Fault, Table};

use super::source::{May, unread};
use files::{self, LARGEST};
use linkage::error::{Error, ErrorKind, Place, Result};

/// Reads what is left to read of a file of `size` bytes; `None` of what is no regular file, such as a pipe.
pub(super) fn read(path: &Path, from: impl Read, size: Option<u64>, may: May) -> Result<Table> {
    // No more is read, whatever there is.
    may(size.unwrap_or(LARGEST).min(LARGEST) as f64, 0)?;
    let text = files::text_from(from).map_err(|error| unread(path, &error))?;
    // At least so many: one line may be a header.
    let rows = text.bytes().filter(|&byte| byte == b'\n').count().saturating_sub(1);
    may(text.len() as f64 + columns::bytes(&text), rows)?;
    columns::read(&text).map_err(|Fault { at, message, help }| {
        let place = Place { file: path.into(), text: text.as_str().into(), span: at };
        Error::new(ErrorKind::Input, message).at(place).help(help)
    })
}
