//! Tables and cells that several reports use.

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, Table, Width, presets};

use prover::compare::Verdict;
use prover::numbers;
use prover::proof::ChannelProof;

/// An empty table without lines; the columns in `numbers` are aligned right.
pub fn table<const N: usize>(header: [&str; N], numbers: &[usize]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_header(header);
    for &index in numbers {
        if let Some(column) = table.column_mut(index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table
}

/// What there is, each once, in the order in which it first stands.
pub fn distinct<T: PartialEq>(all: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for one in all {
        if !found.contains(&one) {
            found.push(one);
        }
    }
    found
}

/// A row of a table in Markdown, without a newline.
pub fn marked<T: AsRef<str>>(cells: &[T]) -> String {
    format!("| {} |", cells.iter().map(AsRef::as_ref).collect::<Vec<_>>().join(" | "))
}

/// Fewest columns of a text that is broken.
const NARROWEST: u16 = 16;

/// The same, in at most `width` columns if there is a width: there the texts of the first column are broken, and numbers
/// stay whole. Where these leave no room for the texts, the table is wider.
pub fn fitted<const N: usize>(header: [&str; N], numbers: &[usize], width: Option<usize>) -> Table {
    let mut table = table(header, numbers);
    if let Some(width) = width {
        table.set_content_arrangement(ContentArrangement::Dynamic).set_width(width as u16);
        table.column_iter_mut().enumerate().for_each(|(index, column)| {
            column.set_constraint(match index {
                0 => ColumnConstraint::LowerBoundary(Width::Fixed(NARROWEST)),
                _ => ColumnConstraint::ContentWidth,
            });
        });
    }
    table
}

/// The same without a margin on the left.
pub fn flush<const N: usize>(header: [&str; N], numbers: &[usize], width: Option<usize>) -> Table {
    let mut table = fitted(header, numbers, width);
    let last = N - 1;
    table.column_iter_mut().enumerate().for_each(|(index, column)| {
        column.set_padding((0, if index == last { 0 } else { 2 }));
    });
    table
}

/// A table as text, without blanks at the ends of its lines. One that is too wide has columns one blank apart, not two,
/// so that fewer texts are broken.
pub fn trimmed(table: &Table) -> String {
    let mut table = table.clone();
    let needed: u16 = table.column_iter().map(|column| column.padding_width()).sum::<u16>()
        + table.column_max_content_widths().iter().sum::<u16>();
    if table.width().is_some_and(|width| needed > width) {
        for column in table.column_iter_mut().filter(|column| column.padding_width() == 2) {
            column.set_padding((0, 1));
        }
    }
    table.lines().map(|line| line.trim_end().to_string()).collect::<Vec<_>>().join("\n")
}

/// Share of its bound that a channel uses. A verdict other than agreement counts more than any share.
pub fn used(channel: &ChannelProof) -> f64 {
    let share = if channel.residual.max == 0.0 { 0.0 } else { channel.residual.max / channel.bound };
    match channel.verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => share,
        Verdict::Inconclusive { .. } => 1e3 + share,
        Verdict::Disagree { .. } => 1e6 + share,
    }
}

/// A value over its scale; 0 of a scale of 0 is 0.
pub fn share(value: f64, scale: f64) -> String {
    if value == 0.0 { "0".into() } else { numbers::significant(value / scale, 2) }
}
