//! The cells of a table as texts with line numbers, and the number in a single cell.

use super::text::{TableFault, divide, lines, number, separator};
use crate::TableCell;

/// A table whose cells are texts.
#[derive(Clone, Debug, Default)]
pub struct CellTable {
    /// Comment lines before the header, without the sign `#`.
    pub comments: Vec<String>,
    /// Line number (from 1) and cells of the first line that is not a comment.
    pub header: (usize, Vec<String>),
    /// Line number (from 1) and cells of each further line.
    pub rows: Vec<(usize, Vec<String>)>,
}

impl CellTable {
    /// Reads the cells of a table. Separators and comments have the same rules as in [`read`](crate::read).
    ///
    /// # Errors
    /// A fault if the text has only blank lines and comments.
    pub fn of(text: &str) -> Result<CellTable, TableFault> {
        let separator = separator(text);
        let begin = text.as_ptr() as usize;
        let mut rows = lines(text).map(|(_, line)| {
            let start = line.as_ptr() as usize - begin;
            let mut cells = Vec::new();
            divide(line, separator, &mut |cell| cells.push(cell.trim().to_string()));
            (text[..start].matches('\n').count() + 1, cells)
        });
        let header = rows.next().ok_or_else(TableFault::empty)?;
        let comments = text.lines().take(header.0 - 1).filter_map(|line| {
            let line = line.trim_start_matches('\u{feff}').trim_start_matches('"');
            line.strip_prefix('#').map(|line| line.trim_end_matches([',', ';', '"']).trim().to_string())
        });
        Ok(CellTable { comments: comments.collect(), rows: rows.collect(), header })
    }
}

impl TableCell {
    /// The number in a cell with a decimal point or a decimal comma; `None` if the cell has no number.
    #[must_use]
    pub fn written(text: &str) -> Option<TableCell> {
        // Some programs write a typographic minus sign.
        number(&text.replace('\u{2212}', "-")).filter(|cell| cell.value.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_keep_their_text_and_line() {
        let table = CellTable::of("# a b;;\n\nphi;x\r\n0;1,50\n30;\u{2212}2.5\n").unwrap();
        assert_eq!((table.comments, table.header), (vec!["a b".into()], (3, vec!["phi".into(), "x".into()])));
        assert_eq!(table.rows, [(4, vec!["0".into(), "1,50".into()]), (5, vec!["30".into(), "\u{2212}2.5".into()])]);
        let cells = ["1,50", "\u{2212}2.5", "", "x", "nan"].map(TableCell::written);
        let told = cells.map(|cell| cell.map(|cell| (cell.value, cell.decimals)));
        assert_eq!(told, [Some((1.5, 2)), Some((-2.5, 1)), None, None, None]);
        assert!(CellTable::of("# only\n").is_err());
    }
}
