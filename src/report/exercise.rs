//! Exercises of a class: task sheets, empty answer tables, the teacher's answers, and the key for marking.

mod given;
mod key;
mod page;
mod task;

pub(super) use key::criterion_text;
pub(crate) use key::{ClassKey, KeyedSheet};
pub(super) use page::{cell_text, page, quantity};
pub(crate) use task::task;

use super::class_words::{self as words, SheetLanguage};
use super::html::escaped;
use super::table_csv::as_csv;
use linkage::error::Result;
use prover::mark::AnswerSheet;
use std::fmt::Write;

/// A sheet with its name.
pub(crate) struct NamedSheet {
    /// Name of the sheet and of its files; for a drawn sheet it numbers the student, as in `student_001`.
    pub(crate) name: String,
    /// The right answers.
    pub(crate) sheet: AnswerSheet,
}

/// Name of the column of positions, the first column of a table of answers.
fn positions_of(sheet: &AnswerSheet) -> &'static str {
    sheet.case.crank().input.shown_in().1
}

/// A position as people read it.
pub(super) fn position(sheet: &AnswerSheet, row: usize) -> String {
    let shown = sheet.case.crank().input.shown(sheet.positions()[row]);
    format!("{}", (shown * 1e6).round() / 1e6 + 0.0)
}

/// A table of answers that the student fills in. A comment in the table names the sheet to which the answers belong.
pub(crate) fn empty_answers(id: &str, sheet: &AnswerSheet) -> Result<String> {
    let header = [vec![positions_of(sheet).to_string()], sheet.columns.iter().map(|own| own.name.clone()).collect()];
    let rows = (0..sheet.right.len()).map(|row| {
        let mut cells = vec![position(sheet, row)];
        cells.resize(sheet.columns.len() + 1, String::new());
        cells
    });
    Ok(format!("# sheet {id}\n{}", as_csv(std::iter::once(header.concat()).chain(rows))?))
}

/// All answers as CSV: one row for each cell of each sheet.
pub(crate) fn all_answers(sheets: &[NamedSheet]) -> Result<String> {
    let header = ["sheet", "position", "quantity", "unit", "answer"].map(String::from);
    let rows = sheets.iter().flat_map(|NamedSheet { name, sheet }| {
        let cells = (0..sheet.right.len()).flat_map(|row| (0..sheet.columns.len()).map(move |column| (row, column)));
        cells.map(move |(row, column)| {
            let own = &sheet.columns[column];
            let answer = cell_text(sheet, column, sheet.right[row][column], 1);
            [name.clone(), position(sheet, row), own.name.clone(), own.unit.into(), answer]
        })
    });
    as_csv(std::iter::once(header).chain(rows))
}

/// The page with all answers, for the teacher.
pub(crate) fn answers_page(sheets: &[NamedSheet], key: &ClassKey) -> String {
    let language = key.language();
    let title = words::answers_to_all_sheets(language);
    let mut body = format!("<h1>{}</h1>\n<p>{} ", escaped(&title), words::for_the_teacher(language));
    if let Some(seed) = key.seed {
        body += &words::numbers_of_the_sheet(language, &seed);
    }
    let _ = writeln!(body, " {}</p>", escaped(&key.criterion_text()));
    for NamedSheet { name, sheet } in sheets {
        let _ = writeln!(body, "<section><h2>{}</h2>\n{}</section>", escaped(name), table(sheet, language, true));
    }
    page(language, &title, &body)
}

/// The table of a sheet: one row for each quantity, one column for each position.
/// The cells have the right answers if `with_answers`, and are empty otherwise.
fn table(sheet: &AnswerSheet, language: SheetLanguage, with_answers: bool) -> String {
    let mut text = format!(
        "<table><tr><th>{}</th><th>{}</th><th>{}</th>",
        words::quantity(language),
        words::unit_word(language),
        words::decimals(language)
    );
    for row in 0..sheet.right.len() {
        let _ = write!(text, "<th class=\"n\">{}</th>", position(sheet, row));
    }
    text += "</tr>\n";
    for (column, own) in sheet.columns.iter().enumerate() {
        let _ = write!(
            text,
            "<tr><td>{}<br><code>{}</code></td><td>{}</td><td class=\"n\">{}</td>",
            escaped(&quantity(language, own)),
            escaped(&own.name),
            words::unit(language, own.unit),
            sheet.decimals[column]
        );
        for row in 0..sheet.right.len() {
            let answer =
                if with_answers { cell_text(sheet, column, sheet.right[row][column], 1) } else { String::new() };
            let _ = write!(text, "<td class=\"n cell\">{answer}</td>");
        }
        text += "</tr>\n";
    }
    text + "</table>\n"
}
