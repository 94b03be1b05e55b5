//! Rows of a table with a header. Commas separate the cells; some cells contain words instead of numbers.

use std::borrow::Cow;
use std::ops::Range;

use crate::text::divide;

/// A table in a text: its header and the positions of its rows. Cells are read on request.
#[derive(Clone, Debug)]
pub struct Records<'a> {
    text: &'a str,
    /// Names of the columns.
    pub header: Vec<String>,
    /// Position of the first byte of each row.
    rows: Vec<u32>,
}

impl<'a> Records<'a> {
    /// The rows of a text of at most 4 GiB. Blank lines do not count.
    ///
    /// # Errors
    /// The byte range and the number of cells of the first line that has more or fewer cells than the header.
    pub fn of(text: &'a str) -> Result<Self, (Range<usize>, usize)> {
        let mut records = Records { text, header: Vec::new(), rows: Vec::new() };
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            let (at, length) = (start, line.len());
            start += length;
            let line = line.trim_end_matches(['\r', '\n']);
            if line.is_empty() {
                continue;
            }
            if records.header.is_empty() {
                divide(line.trim_start_matches('\u{feff}'), Some(','), &mut |cell| records.header.push(cell.into()));
                continue;
            }
            let mut count = 0;
            divide(line, Some(','), &mut |_| count += 1);
            if count != records.header.len() {
                return Err((at..at + line.len(), count));
            }
            records.rows.push(at as u32);
        }
        Ok(records)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Byte range of a row's line.
    pub fn line(&self, row: usize) -> Range<usize> {
        let start = self.rows[row] as usize;
        let length = self.text[start..].find(['\r', '\n']).unwrap_or(self.text.len() - start);
        start..start + length
    }

    /// A cell, without its quotes and the spaces around it.
    pub fn cell(&self, row: usize, column: usize) -> Cow<'a, str> {
        let line = &self.text[self.line(row)];
        if !line.contains('"') {
            return Cow::Borrowed(line.split(',').nth(column).unwrap_or("").trim());
        }
        let (mut at, mut found) = (0, String::new());
        divide(line, Some(','), &mut |cell| {
            if at == column {
                found = cell.into();
            }
            at += 1;
        });
        Cow::Owned(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_found_by_row_and_column() {
        let records = Records::of("a, \"b, c\" \r\n\n1 ,\"x, \"\"y\"\"\"\r\n2,\n").unwrap();
        assert_eq!(records.header, ["a", "b, c"]);
        let cells = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(row, column)| records.cell(row, column));
        assert_eq!(cells, ["1", "x, \"y\"", "2", ""]);
        assert_eq!(Records::of("a,b\n1,2\n3\n").unwrap_err(), (8..9, 1));
    }
}
