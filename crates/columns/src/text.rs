//! Text with separated columns, as programs write it.
//! Columns are separated by commas, semicolons, tabs or spaces. A header and comment lines are optional.

use crate::sentences;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use super::cell::TableCell;
use super::constant::numbers_beside;
use formula::Rounded;

/// Characters with which a comment line begins.
const COMMENTS: [char; 3] = ['#', '%', ';'];

/// A table as read from a file. The columns have no meaning yet. All columns have the same length.
#[derive(Clone, Debug, Default)]
pub struct TextTable {
    /// Names of the columns; `c1`, `c2`, ... if the text has no names.
    pub names: Vec<String>,
    /// Numbers of the columns, each with the uncertainty caused by the printing of its digits.
    pub columns: Vec<Vec<Rounded>>,
    /// Line number of every row, from 1; empty if the table does not come from a text.
    pub lines: Vec<u32>,
}

impl TextTable {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Words for the row with the index `row` (from 0): its line number if the table has line numbers, otherwise its
    /// row number (from 1).
    pub fn place(&self, row: usize) -> String {
        match self.lines.get(row) {
            Some(line) => sentences::line_of_the_table(&line),
            None => sentences::row_of_the_table(&(row + 1)),
        }
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The reason why a text is not a table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableFault {
    /// Bytes of the line.
    pub at: Range<usize>,
    /// What was found.
    pub message: String,
    /// The remedy.
    pub help: String,
}

impl TableFault {
    /// The fault of a text that has only blank lines and comments.
    pub(crate) fn empty() -> TableFault {
        let [message, help] = [sentences::THE_TABLE_IS_EMPTY, sentences::GIVE_A_TABLE_WITH_A_HEADER].map(String::from);
        TableFault { at: 0..0, message, help }
    }
}

/// Two columns with the same name. The pair can be displayed as a message.
#[derive(Clone, Debug, PartialEq)]
pub struct Twice {
    /// The name.
    pub name: String,
    /// Numbers of the two columns, from 1.
    pub columns: [usize; 2],
}

impl Twice {
    /// The remedy.
    pub const HELP: &str = sentences::GIVE_EVERY_COLUMN_A_NAME;

    /// The first name that occurs twice. Columns without a name do not count, because no request can refer to them.
    pub fn of<T: AsRef<str>>(names: impl IntoIterator<Item = T>) -> Option<Twice> {
        let mut seen = BTreeMap::new();
        for (index, name) in names.into_iter().enumerate() {
            let name = name.as_ref().trim().to_string();
            if name.is_empty() {
                continue;
            }
            if let Some(first) = seen.insert(name.clone(), index + 1) {
                return Some(Twice { name, columns: [first, index + 1] });
            }
        }
        None
    }
}

impl fmt::Display for Twice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = self.columns;
        write!(f, "{}", sentences::the_columns_and_of_the_table(&first, &second, &self.name))
    }
}

/// Memory that the numbers of a text need at most (bytes), estimated from the separators.
pub fn bytes(text: &str) -> f64 {
    let cells = text.bytes().filter(|byte| matches!(byte, b',' | b';' | b'\t' | b' ' | b'\n')).count() + 1;
    (cells * (size_of::<TableCell>() + size_of::<Rounded>())) as f64
}

/// Reads a table. The last line shows which character separates the columns.
///
/// # Errors
/// A line that has more or fewer cells than the header, or a cell that is not a number.
/// Two columns with the same name, or a text that has only blank lines and comments, are errors too.
pub fn read(text: &str) -> Result<TextTable, TableFault> {
    let wrong = |start: usize, message: String, help: &str| {
        let length = text[start..].find(['\r', '\n']).unwrap_or(text.len() - start);
        TableFault { at: start..start + length, message, help: help.into() }
    };
    let separator = separator(text);
    let mut rows = lines(text).peekable();
    let Some(&(header_at, first)) = rows.peek() else {
        return Err(TableFault::empty());
    };
    let mut first_cells = Vec::new();
    divide(first, separator, &mut |cell| first_cells.push(cell.trim().to_string()));
    let names = match first_cells.iter().all(|cell| number(cell).is_some()) {
        true => (1..=first_cells.len()).map(|column| format!("c{column}")).collect(),
        false => {
            rows.next();
            first_cells
        }
    };
    if let Some(twice) = Twice::of(&names) {
        return Err(wrong(header_at, twice.to_string(), Twice::HELP));
    }
    let mut columns: Vec<Vec<TableCell>> = vec![Vec::new(); names.len()];
    let (mut places, mut seen, mut place) = (Vec::new(), 0, 1u32);
    for (start, line) in rows {
        place += text.as_bytes()[seen..start].iter().filter(|&&byte| byte == b'\n').count() as u32;
        seen = start;
        places.push(place);
        let (mut count, mut fault) = (0, None);
        divide(line, separator, &mut |cell| {
            match (number(cell), columns.get_mut(count)) {
                (Some(found), Some(column)) => column.push(found),
                (None, Some(_)) if fault.is_none() => fault = Some((count, cell.to_string())),
                _ => {}
            }
            count += 1;
        });
        if count != names.len() {
            let message = sentences::the_row_has_cells_but_the_first(&count, &names.len());
            return Err(wrong(start, message, sentences::GIVE_EVERY_ROW_AS_MANY_CELLS));
        }
        if let Some((column, cell)) = fault {
            let help = sentences::WRITE_DECIMALS_WITH_A_POINT;
            return Err(wrong(start, sentences::in_the_column_stands_which_is_no_number(&names[column], &cell), help));
        }
    }
    let others = |own: usize| columns.iter().enumerate().filter(move |(other, _)| *other != own);
    let of = |(own, cells): (usize, &Vec<TableCell>)| numbers_beside(cells, || others(own).map(|(_, cells)| cells));
    let columns = columns.iter().enumerate().map(of).collect();
    Ok(TextTable { names, columns, lines: places })
}

/// The character that separates the cells of the last line; `None` if blanks separate them.
pub(crate) fn separator(text: &str) -> Option<char> {
    lines(text).last().and_then(|(_, line)| ['\t', ';', ','].into_iter().find(|sign| line.trim().contains(*sign)))
}

/// The number in a cell. A decimal comma is accepted.
/// If commas separate the cells, only a cell in quotes can contain a decimal comma.
pub(crate) fn number(cell: &str) -> Option<TableCell> {
    TableCell::parse(cell)
        .or_else(|| (cell.matches(',').count() == 1).then(|| TableCell::parse(&cell.replace(',', ".")))?)
}

/// The lines that are neither blank nor comments, each with the position of its first byte.
/// Trailing tabs stay, because they may separate empty cells.
pub(crate) fn lines(text: &str) -> impl DoubleEndedIterator<Item = (usize, &str)> {
    let begin = text.as_ptr() as usize;
    let all = text.strip_prefix('\u{feff}').unwrap_or(text).split('\n');
    all.map(move |line| (line.as_ptr() as usize - begin, line.trim_matches([' ', '\r'])))
        .filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with(COMMENTS))
}

/// Passes the cells of a line to `give`, without the spaces around them and without quotes.
pub(crate) fn divide(line: &str, separator: Option<char>, give: &mut dyn FnMut(&str)) {
    let Some(separator) = separator else { return line.split_whitespace().for_each(give) };
    if !line.contains('"') {
        return line.split(separator).for_each(|cell| give(cell.trim()));
    }
    let mut rest = line;
    loop {
        let (cell, next) = cell(rest, separator);
        give(cell.trim());
        match next {
            Some(next) => rest = next,
            None => break,
        }
    }
}

/// The first cell of a line, and the rest of the line after the separator.
/// A quoted cell may contain separators. Two quotes in a quoted cell denote one quote character.
fn cell(line: &str, separator: char) -> (Cow<'_, str>, Option<&str>) {
    let own = line.trim_start();
    let Some(quoted) = own.strip_prefix('"') else {
        return match line.split_once(separator) {
            Some((cell, next)) => (Cow::Borrowed(cell), Some(next)),
            None => (Cow::Borrowed(line), None),
        };
    };
    let mut text = String::new();
    let mut rest = quoted;
    while let Some((part, next)) = rest.split_once('"') {
        text.push_str(part);
        rest = next;
        match next.strip_prefix('"') {
            Some(next) => {
                text.push('"');
                rest = next;
            }
            None => break,
        }
    }
    match rest.split_once(separator) {
        Some((behind, next)) => (Cow::Owned(text + behind.trim()), Some(next)),
        None => (Cow::Owned(text + rest.trim()), None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_comments_and_headers_are_found() {
        for text in [
            "t,x\n0,1.5\n1,2.5\n",
            "\u{feff}t;x\r\n0;1,5\r\n1;2,5\r\n",
            "# made by hand\nt\tx\n0\t1.5\n\n1\t2.5",
            "  t   x\n  0  1.5\n  1  2.5\n",
            "t,\"x\"\n0, 1.5\n1, \"2.5\"",
            "t\tx\n0\t\n1\t2.5\n",
        ] {
            let table = read(text).unwrap();
            assert_eq!((table.names, table.columns[1][1].value), (vec!["t".into(), "x".into()], 2.5), "{text}");
        }
        assert_eq!(read("# a\n\nt,x\r\n0,1.5\n\n1,2.5\n").unwrap().lines, [4, 6]);
        assert_eq!(read("#only\n0,1.5\n1,2.5\n").unwrap().names, ["c1", "c2"]);
        assert_eq!(read("t,\"a, \"\"b\"\"\"\n0,1\n").unwrap().names, ["t", "a, \"b\""]);
        assert!(read("t,x\n0,\n1,2\n").unwrap().columns[1][0].value.is_nan());
    }

    #[test]
    fn malformed_tables_are_reported_with_the_line() {
        for (text, line, part) in [
            ("t,x\n0,1\n1,2,3\n", 3, "3 cells"),
            ("t,x\n0,1\n1\n2,3\n", 3, "1 cells"),
            ("t,x\n0,1\n1,much\n", 3, "\"much\""),
            ("# nothing\n", 1, "empty"),
            ("# first\nt,r,r\n0,1,2\n", 2, "columns 2 and 3"),
        ] {
            let fault = read(text).unwrap_err();
            assert!(fault.message.contains(part), "{}", fault.message);
            assert_eq!(text[..fault.at.start].matches('\n').count() + 1, line, "{text}");
        }
    }

    proptest::proptest! {
        /// For any text the result is either columns of equal length, or a fault with its location.
        #[test]
        fn any_text_is_a_table_or_a_fault(text in "([-+0-9.,;eE \t\r\n#\"a-z\u{fc}\u{20ac}]{0,12}\n){0,8}") {
            match read(&text) {
                Ok(table) => {
                    let rows = table.columns[0].len();
                    proptest::prop_assert!(table.columns.iter().all(|column| column.len() == rows));
                    proptest::prop_assert_eq!(table.names.len(), table.columns.len());
                }
                Err(fault) => proptest::prop_assert!(text.get(fault.at).is_some() && !fault.help.is_empty()),
            }
        }
    }

    #[test]
    fn duplicate_column_names_are_reported_with_both_columns() {
        let twice = Twice::of(["t", "x", "", "", " t"]).unwrap();
        assert_eq!(twice.to_string(), "the columns 1 and 5 of the table are both called \"t\"");
        assert_eq!(Twice::of(["t", "T", "", ""]), None);
    }
}
