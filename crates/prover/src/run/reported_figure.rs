//! A figure of a proven motion, as reports show it.

/// A figure of a proven motion.
#[derive(Clone, Debug, PartialEq)]
pub struct ReportedFigure {
    /// The figure in words; for a figure that the file requests, the text in the file.
    pub label: String,
    /// The figure, as sweeps and files write it.
    pub figure: String,
    /// Value, in `unit`.
    pub value: f64,
    /// Unit; empty for a number without a unit.
    pub unit: String,
    /// Rows of the reference's grid at which the figure occurs; for a range, the rows of the largest and of the
    /// smallest value. Empty for a mean.
    pub rows: Vec<usize>,
}
