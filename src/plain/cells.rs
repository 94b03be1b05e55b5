//! Tables, cells and lists that several reports use.

use crate::sentences;
use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, Table, Width, presets};

use linkage::math::statistics;
use prover::numbers;

/// An empty table without ruled lines. In `header`, bars separate the names of the columns. If a name ends in `>`, the
/// column is numeric and aligned right.
pub fn table(header: &str) -> Table {
    let mut table = Table::new();
    let columns = header.split('|').map(|own| own.trim_matches(' '));
    table.load_style(presets::NOTHING).set_header(columns.clone().map(|own| own.trim_end_matches('>')));
    for (column, name) in table.column_iter_mut().zip(columns) {
        if name.ends_with('>') {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table
}

/// Header, in two lines, of a column that states where an extreme value or an event occurs.
/// For the quantity `crank angle` in `deg`, the header is `at crank` above `angle, deg`.
pub fn at_column(noun: &str, unit: &str) -> String {
    let name = format!("at {noun}");
    let (first, last) = name.rsplit_once(' ').expect("it has a blank");
    format!("{first}\n{last}, {unit}")
}

/// A row of a table in Markdown, without a newline.
pub fn marked<T: AsRef<str>>(cells: &[T]) -> String {
    format!("| {} |", cells.iter().map(AsRef::as_ref).collect::<Vec<_>>().join(" | "))
}

/// `1 channel`, `2 channels`.
pub fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// The first `most` names, and the number of further names.
pub fn some<T: ToString>(names: &[T], most: usize) -> String {
    let named = names.iter().take(most).map(ToString::to_string).collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(most) {
        0 => named,
        more => sentences::and_more_2(&named, &more),
    }
}

/// Smallest number of columns of wrapped text.
const NARROWEST: u16 = 16;

/// A table in at most `width` columns, if a width is given.
/// The texts of its first column are then wrapped; numbers are not broken.
/// If the numbers leave no space for the texts, the table is wider than `width`.
pub fn fitted(header: &str, width: Option<usize>) -> Table {
    let mut table = table(header);
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

/// A table in at most `width` columns, if a width is given.
/// The texts of its last column are then wrapped; the other columns are not.
pub fn worded(header: &str, width: Option<usize>) -> Table {
    let mut table = fitted(header, width);
    let last = table.column_count() - 1;
    if width.is_some() {
        table.column_iter_mut().enumerate().for_each(|(index, column)| {
            column.set_constraint(match index == last {
                true => ColumnConstraint::LowerBoundary(Width::Fixed(NARROWEST)),
                false => ColumnConstraint::ContentWidth,
            });
        });
    }
    table
}

/// Like [`fitted`], without a margin on the left.
pub fn flush(header: &str, width: Option<usize>) -> Table {
    let mut table = fitted(header, width);
    let last = table.column_count() - 1;
    table.column_iter_mut().enumerate().for_each(|(index, column)| {
        column.set_padding((0, if index == last { 0 } else { 2 }));
    });
    table
}

/// A table as text, without trailing blanks.
/// If it is too wide, its columns are one blank apart instead of two, so that fewer texts wrap.
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

/// A value divided by its scale; 0 if both are zero.
pub fn share(value: f64, scale: f64) -> String {
    numbers::significant(statistics::share(value, scale), 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_name_columns_and_mark_numeric_ones() {
        let mut numbers = table("channel | error> | ");
        numbers.add_row(["x", "1", "m"]);
        assert_eq!(trimmed(&numbers), " channel  error\n x            1  m");
    }

    #[test]
    fn omitted_items_are_counted() {
        assert_eq!([some(&["a", "b"], 2), some(&["a", "b", "c"], 2)], ["a, b", "a, b and 1 more"]);
        assert_eq!([counted(1, "row"), counted(2, "row")], ["1 row", "2 rows"]);
    }
}
