//! Tables of other programs: CSV and Parquet files, and which of their columns are which channels.

mod csv_file;
mod digits;
mod held;
mod parquet_file;

pub use held::{At, Column, Held, Instants};

use std::path::Path;

use formula::Rounded;
use linkage::error::{Error, ErrorKind, Result};

/// A table as it stands in a file: columns of numbers, all of the same length. What is missing is NaN.
#[derive(Clone, Debug, Default)]
pub struct Raw {
    /// Names of the columns; `c1`, `c2`, ... where the file has none.
    pub names: Vec<String>,
    /// Their numbers, each with half a unit of its last digit.
    pub columns: Vec<Vec<Rounded>>,
}

impl Raw {
    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Whether there is no row.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Reads a file: Parquet by its first bytes, else text with separated columns.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] if it cannot be read, [`ErrorKind::Input`] if it is no table of numbers, with the place.
    pub fn read(path: &Path) -> Result<Raw> {
        let raw = match parquet_file::is_one(path) {
            true => parquet_file::read(path)?,
            false => csv_file::read(path)?,
        };
        let mut names: Vec<&String> = raw.names.iter().collect();
        names.sort_unstable();
        if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            let message = format!("{} has two columns \"{}\"", path.display(), twice[0]);
            return Err(Error::new(ErrorKind::Input, message).help("give every column a name of its own"));
        }
        if raw.is_empty() {
            let message = format!("{} has no rows of numbers", path.display());
            return Err(
                Error::new(ErrorKind::Input, message).help("give a table with a header and one row per instant")
            );
        }
        Ok(raw)
    }
}
