//! Text with separated columns, as programs write it: with commas, semicolons, tabs or blanks, with or without a
//! header, with lines of comment.

use std::borrow::Cow;
use std::path::Path;

use super::digits::{Cell, numbers};
use super::raw::Raw;
use crate::files;
use linkage::error::{Error, ErrorKind, Place, Result};

/// Signs that begin a line of comment.
const COMMENTS: [char; 3] = ['#', '%', ';'];

/// A line of the file that is no comment: where it begins, and its cells.
struct Line<'a> {
    start: usize,
    cells: Vec<Cow<'a, str>>,
}

pub(super) fn read(path: &Path) -> Result<Raw> {
    let text = files::read_text(path).map_err(|error| {
        Error::new(ErrorKind::Io, format!("the table {} cannot be read: {error}", path.display()))
            .help("give a scenario (.toml), a recording (.mcap), a table of text (.csv) or a Parquet file")
    })?;
    of_text(&text, path)
}

fn of_text(text: &str, path: &Path) -> Result<Raw> {
    let wrong = |start: usize, message: String, help: &str| {
        let length = text[start..].find(['\r', '\n']).unwrap_or(text.len() - start);
        let place = Place { file: path.into(), text: text.into(), span: start..start + length };
        Error::new(ErrorKind::Input, message).at(place).help(help)
    };
    let lines = lines(text);
    let Some(first) = lines.first() else {
        return Err(wrong(0, "the table is empty".into(), "give a table with a header and one row per instant"));
    };
    let has_numbers = |line: &Line| line.cells.iter().all(|cell| number(cell).is_some());
    let (names, rows) = match has_numbers(first) {
        true => ((1..=first.cells.len()).map(|column| format!("c{column}")).collect(), &lines[..]),
        false => (first.cells.iter().map(ToString::to_string).collect::<Vec<String>>(), &lines[1..]),
    };
    let mut columns: Vec<Vec<Cell>> = vec![Vec::with_capacity(rows.len()); names.len()];
    for line in rows {
        if line.cells.len() != names.len() {
            let message = format!("the row has {} cells, but the first line has {}", line.cells.len(), names.len());
            return Err(wrong(line.start, message, "give every row as many cells as the header"));
        }
        for ((cell, column), name) in line.cells.iter().zip(&mut columns).zip(&names) {
            let found = number(cell).ok_or_else(|| {
                let message = format!("in the column \"{name}\" stands \"{cell}\", which is no number");
                wrong(line.start, message, "write decimals with a point; leave a cell empty where nothing was measured")
            })?;
            column.push(found);
        }
    }
    let doubles = columns.iter().flatten().any(Cell::is_whole_double);
    Ok(Raw { names, columns: columns.iter().map(|cells| numbers(cells, doubles)).collect() })
}

/// A cell; decimal commas are taken where cells are not separated by commas.
fn number(cell: &str) -> Option<Cell> {
    Cell::parse(cell).or_else(|| (cell.matches(',').count() == 1).then(|| Cell::parse(&cell.replace(',', ".")))?)
}

/// The lines that are no comments, divided by the separator that the last of them shows.
fn lines<'a>(text: &'a str) -> Vec<Line<'a>> {
    let text = text.strip_prefix('\u{feff}').map_or((0, text), |rest| (text.len() - rest.len(), rest));
    let (mut start, text) = text;
    let mut found = Vec::new();
    for line in text.split_inclusive('\n') {
        let content = line.trim();
        if !content.is_empty() && !content.starts_with(COMMENTS) {
            found.push((start, content));
        }
        start += line.len();
    }
    let separator = found.last().and_then(|(_, line)| ['\t', ';', ','].into_iter().find(|sign| line.contains(*sign)));
    let cells = |line: &'a str| -> Vec<Cow<'a, str>> {
        let Some(separator) = separator else {
            return line.split_whitespace().map(Cow::Borrowed).collect();
        };
        if !line.contains('"') {
            return line.split(separator).map(|cell| Cow::Borrowed(cell.trim())).collect();
        }
        let mut reader = csv::ReaderBuilder::new();
        reader.has_headers(false).flexible(true).trim(csv::Trim::All).delimiter(separator as u8);
        let mut record = csv::StringRecord::new();
        match reader.from_reader(line.as_bytes()).read_record(&mut record) {
            Ok(_) => record.iter().map(|cell| Cow::Owned(cell.to_string())).collect(),
            Err(_) => Vec::new(),
        }
    };
    found.into_iter().map(|(start, line)| Line { start, cells: cells(line) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Raw> {
        of_text(text, Path::new("x.csv"))
    }

    #[test]
    fn separators_comments_and_headers_are_found() {
        for text in [
            "t,x\n0,1.5\n1,2.5\n",
            "\u{feff}t;x\r\n0;1,5\r\n1;2,5\r\n",
            "# made by hand\nt\tx\n0\t1.5\n\n1\t2.5",
            "  t   x\n  0  1.5\n  1  2.5\n",
            "t,\"x\"\n0, 1.5\n1, 2.5",
        ] {
            let raw = read(text).unwrap();
            assert_eq!((raw.names.as_slice(), raw.columns[1][1].value), (&["t".into(), "x".into()][..], 2.5), "{text}");
        }
        assert_eq!(read("#only\n0,1.5\n1,2.5\n").unwrap().names, ["c1", "c2"]);
        assert!(read("t,x\n0,\n1,2\n").unwrap().columns[1][0].value.is_nan());
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (text, line, part) in
            [("t,x\n0,1\n1,2,3\n", 3, "3 cells"), ("t,x\n0,1\n1,much\n", 3, "\"much\""), ("# nothing\n", 1, "empty")]
        {
            let error = read(text).unwrap_err();
            assert!(error.message().contains(part), "{}", error.message());
            assert_eq!(error.place().unwrap().line(), line, "{text}");
        }
    }

    proptest::proptest! {
        /// Whatever a file holds: columns of equal length, or an error with its place.
        #[test]
        fn any_text_is_a_table_or_an_error(text in "([-+0-9.,;eE \t\r\n#\"a-z\u{fc}\u{20ac}]{0,12}\n){0,8}") {
            match read(&text) {
                Ok(raw) => {
                    proptest::prop_assert!(raw.columns.iter().all(|column| column.len() == raw.len()));
                    proptest::prop_assert_eq!(raw.names.len(), raw.columns.len());
                }
                Err(error) => proptest::prop_assert!(error.place().is_some() && !error.advice().is_empty()),
            }
        }
    }
}
