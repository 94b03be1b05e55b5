//! A table as it stands in a file, whatever its columns mean.

use formula::Rounded;

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
}
