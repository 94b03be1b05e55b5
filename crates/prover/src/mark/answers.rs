//! The table that a student filled in.

use crate::sentences;
use std::path::Path;

use super::sheet::AnswerSheet;
use columns::{CellTable, TableCell};
use linkage::error::{Error, ErrorKind, Result};
use scenario::words::choice;

/// An answer as the student wrote it.
#[derive(Clone, Debug, PartialEq)]
pub struct StudentCell {
    /// The text of the cell.
    pub text: String,
    /// The number.
    pub value: f64,
    /// Number of the last decimal place: the number of written decimals minus the power of ten, for example 3 for
    /// `1.25e-1`.
    pub decimals: i32,
}

impl StudentCell {
    /// Half a unit of the last written digit.
    #[must_use]
    pub fn half_unit(&self) -> f64 {
        0.5 * 10f64.powi(-self.decimals) * (1.0 + 1e-9)
    }
}

/// The answers of a student, by position and quantity of the sheet; `None` for a cell without an answer.
pub type StudentAnswers = Vec<Vec<Option<StudentCell>>>;

/// A row belongs to a position of the sheet if their crank angles (deg) or slides (mm) differ by at most this amount.
const SAME: f64 = 1e-3;

/// Word that stands before the name of the sheet in a comment of the table.
const SHEET: &str = "sheet ";

/// The name of the sheet to which a table of answers belongs, from a comment of the table.
pub(crate) fn is_of(table: &CellTable) -> Option<&str> {
    table.comments.iter().find_map(|comment| comment.strip_prefix(SHEET)).map(str::trim)
}

/// Reads the answers to the sheet called `name` from the text of the file at `path`.
/// Columns and rows may be in any order. An empty cell has no answer. A decimal comma is accepted.
///
/// # Errors
/// [`ErrorKind::Input`], with file, line and column, if the text is not a table, or if the table belongs to another
/// sheet. [`ErrorKind::Input`] also if the first column does not contain the positions, or if a column is missing,
/// unknown or repeated. [`ErrorKind::Input`] also if a row has too many cells, if the sheet does not ask for the
/// position of a row, or if two rows have the same position. [`ErrorKind::Input`] also if a cell is not a number.
pub fn read_answers(text: &str, path: &Path, name: &str, sheet: &AnswerSheet) -> Result<StudentAnswers> {
    let file = path.display();
    let wrong = |message: String, help: &str| Error::new(ErrorKind::Input, message).help(help);
    let table =
        CellTable::of(text).map_err(|fault| wrong(sentences::in_the_file(&file, &fault.message), &fault.help))?;
    if let Some(other) = is_of(&table).filter(|other| *other != name) {
        let message = sentences::the_answers_belong_to_another_sheet(&file, &other, &name);
        return Err(wrong(message, sentences::PUT_THE_ANSWERS_INTO_THE_FILE_OF_THEIR_SHEET));
    }
    let key = sheet.case.crank().input.shown_in().1;
    let (at, header) = &table.header;
    let names = || sheet.columns.iter().map(|column| column.name.as_str());
    let mut places: Vec<Option<usize>> = Vec::new();
    for (number, cell) in header.iter().enumerate().skip(1) {
        let place = names().position(|own| own == cell);
        if place.is_none() && !cell.is_empty() {
            let message = sentences::the_sheet_does_not_ask_for(&file, &at, &(number + 1), &cell);
            return Err(wrong(message, &choice(names(), "\"")));
        }
        if place.is_some() && places.contains(&place) {
            let message = sentences::the_column_is_there_twice(&file, &at, &(number + 1), &cell);
            return Err(wrong(message, sentences::LEAVE_ONE_OF_THE_TWO_COLUMNS));
        }
        places.push(place);
    }
    if header.first().is_none_or(|first| first != key) {
        let found = header.first().map_or("", String::as_str);
        let message = sentences::the_first_column_is_not(&file, &at, &key, &found);
        return Err(wrong(message, sentences::KEEP_THE_HEADER_OF_THE_SHEET));
    }
    if let Some(missing) = (0..sheet.columns.len()).find(|place| !places.contains(&Some(*place))) {
        let message = sentences::the_column_is_missing(&file, &at, &sheet.columns[missing].name);
        return Err(wrong(message, sentences::KEEP_ALL_COLUMNS_AND_LEAVE_CELLS_EMPTY));
    }
    let input = sheet.case.crank().input;
    let asked: Vec<f64> = sheet.positions().iter().map(|position| input.shown(*position)).collect();
    let mut answers: StudentAnswers = vec![vec![None; sheet.columns.len()]; asked.len()];
    let mut seen = vec![None; asked.len()];
    for (line, cells) in &table.rows {
        if cells.iter().all(String::is_empty) {
            continue;
        }
        if cells.len() > header.len() {
            let message = sentences::the_row_has_more_cells(&file, &line, &cells.len(), &header.len());
            return Err(wrong(message, sentences::SEPARATE_CELLS_BY_SEMICOLONS));
        }
        let crank = TableCell::written(&cells[0]);
        let row = crank.and_then(|crank| asked.iter().position(|own| (own - crank.value).abs() <= SAME));
        let Some(row) = row else {
            let positions: Vec<String> = asked.iter().map(ToString::to_string).collect();
            let message = sentences::the_row_is_for_no_position(&file, &line, &cells[0], &key);
            return Err(wrong(message, &sentences::the_sheet_asks_for_the_positions(&positions.join(", "))));
        };
        if let Some(first) = seen[row].replace(*line) {
            let message = sentences::the_position_is_there_twice(&file, &line, &cells[0], &first);
            return Err(wrong(message, sentences::LEAVE_ONE_ROW_FOR_EACH_POSITION));
        }
        for (number, (text, place)) in cells.iter().skip(1).zip(&places).enumerate() {
            let Some(place) = place.filter(|_| !is_empty(text)) else { continue };
            let Some(cell) = TableCell::written(text) else {
                let name = &sheet.columns[place].name;
                let message = sentences::the_cell_is_no_number(&file, &line, &(number + 2), &name, &text);
                return Err(wrong(message, sentences::WRITE_ONE_NUMBER_WITHOUT_ITS_UNIT));
            };
            let cell = StudentCell { text: text.clone(), value: cell.value, decimals: cell.decimals };
            answers[row][place] = Some(cell);
        }
    }
    Ok(answers)
}

/// Whether a cell has no answer: it is empty, or contains dashes only.
fn is_empty(text: &str) -> bool {
    text.is_empty() || text.chars().all(|sign| matches!(sign, '-' | '\u{2013}' | '\u{2014}'))
}
