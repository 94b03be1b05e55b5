//! Comparison of several mechanisms that have the same task.

use super::timing::TimingDiagram;

/// Row of the table: one quantity of all mechanisms.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparisonRow {
    /// Name and unit of the quantity.
    pub name: String,
    /// The value of every mechanism as text, and whether the value is the best of the row.
    pub cells: Vec<(String, bool)>,
}

/// Sheet: a table of quantities with a column for every mechanism, and the displacement of every mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparisonSheet {
    /// Title.
    pub title: String,
    /// Heads of the columns: the names of the mechanisms.
    pub heads: Vec<String>,
    /// Rows.
    pub rows: Vec<ComparisonRow>,
    /// Lines below the table.
    pub notes: Vec<String>,
    /// Names and displacements of the mechanisms.
    pub panels: Vec<(String, TimingDiagram)>,
}
