//! Tables of other programs: CSV and Parquet files, and which of their columns are which channels.

mod csv_file;
mod held;
mod parquet_file;

pub use columns::Table as Raw;
pub use held::{At, Column, Held, Instants};

use std::path::Path;

use linkage::error::{Error, ErrorKind, Result};

/// Reads a file: Parquet by its first bytes, else text with separated columns.
///
/// # Errors
/// [`ErrorKind::Io`] if it cannot be read, [`ErrorKind::Input`] if it is no table of numbers, with the place.
pub fn load(path: &Path) -> Result<Raw> {
    load_within(path, &|_| Ok(()))
}

/// The same where memory is asked for before it is taken: `may_take` says whether so many bytes may be.
///
/// # Errors
/// Those of [`load`], and what `may_take` says.
pub fn load_within(path: &Path, may_take: &dyn Fn(f64) -> Result<()>) -> Result<Raw> {
    let raw = match parquet_file::is_one(path) {
        true => parquet_file::read(path, may_take)?,
        false => csv_file::read(path, may_take)?,
    };
    if raw.is_empty() {
        let message = format!("{} has no rows of numbers", path.display());
        return Err(Error::new(ErrorKind::Input, message).help("give a table with a header and one row per instant"));
    }
    Ok(raw)
}
