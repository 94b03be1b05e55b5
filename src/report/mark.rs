//! Marks of a class: a table of all students, and a page for each of them.

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write;

use super::class_words::{self as words, SheetLanguage};
use super::exercise::{NamedSheet, cell_text, criterion_text, page, position, quantity};
use super::html::escaped;
use super::pretty::{list, pretty};
use super::table_csv::as_csv;
use crate::plain::cells::{trimmed, worded};
use linkage::error::Result;
use prover::mark::{CellPlace, CellVerdict, MarkCause, MarkCriterion, MarkedCell, MarkedSheet, PartOfPoint};

/// A judged sheet of the class.
pub(crate) struct StudentMarks {
    /// The sheet.
    pub(crate) own: NamedSheet,
    /// The judged answers; `None` if they were not handed in.
    pub(crate) marked: Option<MarkedSheet>,
}

/// Options of reports on marks.
#[derive(Clone, Copy)]
pub(crate) struct MarkOptions {
    pub(crate) language: SheetLanguage,
    pub(crate) criterion: MarkCriterion,
    /// Whether the right values are left out.
    pub(crate) hides_answers: bool,
}

impl StudentMarks {
    fn count(&self, verdict: CellVerdict) -> usize {
        let cells = self.own.sheet.right.len() * self.own.sheet.columns.len();
        self.marked
            .as_ref()
            .map_or(if verdict == CellVerdict::Unanswered { cells } else { 0 }, |own| own.count(verdict))
    }

    /// Number of right, wrong and unanswered cells.
    fn counts(&self) -> [usize; 3] {
        [CellVerdict::Right, CellVerdict::Wrong, CellVerdict::Unanswered].map(|verdict| self.count(verdict))
    }

    /// Whether every cell is right.
    pub(crate) fn is_right(&self) -> bool {
        let [_, wrong, open] = self.counts();
        wrong + open == 0
    }

    /// Right cells in per cent of all cells, rounded down to whole numbers.
    fn percent(&self) -> usize {
        let [right, wrong, open] = self.counts();
        100 * right / (right + wrong + open).max(1)
    }

    /// The causes of the wrong cells with their counts, the most frequent first.
    fn causes(&self, language: SheetLanguage) -> String {
        let Some(marked) = &self.marked else { return words::not_handed_in(language) };
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for (row, column) in wrong_cells(marked) {
            *counts.entry(told(language, &self.own, &marked.cells[row][column])).or_default() += 1;
        }
        let mut counts: Vec<(String, usize)> = counts.into_iter().collect();
        counts.sort_by(|one, other| other.1.cmp(&one.1).then(one.0.cmp(&other.0)));
        counts.into_iter().map(|(cause, count)| format!("{cause} ({count})")).collect::<Vec<_>>().join("; ")
    }
}

fn wrong_cells(marked: &MarkedSheet) -> impl Iterator<Item = (usize, usize)> {
    let cells = marked.cells.iter().enumerate();
    let all = cells.flat_map(|(row, cells)| cells.iter().enumerate().map(move |(column, cell)| (row, column, cell)));
    all.filter(|(.., cell)| cell.verdict == CellVerdict::Wrong).map(|(row, column, _)| (row, column))
}

/// The cause of a wrong cell in words.
fn told(language: SheetLanguage, own: &NamedSheet, cell: &MarkedCell) -> String {
    let Some(cause) = &cell.cause else { return words::no_cause_recognised(language) };
    let unit = |symbol: &str| words::unit(language, symbol);
    let place = |at: &CellPlace| format!("{}, {}", own.sheet.columns[at.column].name, position(&own.sheet, at.row));
    match cause {
        MarkCause::Sign => words::opposite_sign(language),
        MarkCause::Unit { written, asked } => words::unit_for(language, &unit(written), &unit(asked)),
        MarkCause::DecimalPoint(power) => words::point_moved(language, power),
        MarkCause::Twice => words::twice(language),
        MarkCause::Half => words::half(language),
        MarkCause::Zero => words::zero(language),
        MarkCause::PerRadian => words::per_radian(language),
        MarkCause::Supplement => words::supplement(language),
        MarkCause::OtherEnd => words::other_end(language),
        MarkCause::Complement => words::complement(language),
        MarkCause::FromVertical => words::from_vertical(language),
        MarkCause::RelativeAngle(link) => words::relative_angle(language, link),
        MarkCause::Exchanged(at) => words::exchanged_with(language, &place(at)),
        MarkCause::OfCell(at) => words::value_of(language, &place(at)),
        MarkCause::OppositeOfCell(at) => words::opposite_of(language, &place(at)),
        MarkCause::DigitsSwapped => words::digits_swapped(language),
        MarkCause::OneDigit => words::one_digit(language),
        MarkCause::DigitLost => words::digit_lost(language),
        MarkCause::WithoutPart(PartOfPoint::Carried, point, other) => words::without_carried(language, point, other),
        MarkCause::WithoutPart(PartOfPoint::Normal, point, other) => words::without_normal(language, point, other),
        MarkCause::WithoutPart(PartOfPoint::Tangential, point, other) => {
            words::without_tangential(language, point, other)
        }
        MarkCause::FromWholeSpeed(point) => words::from_whole_speed(language, point),
        MarkCause::NoNormal(link) => words::no_normal(language, link),
        MarkCause::NoNormals => words::no_normals(language),
        MarkCause::NoCoriolis(joint) => words::no_coriolis(language, joint),
        MarkCause::Configuration { group, mode } => words::configuration(language, group, mode),
        MarkCause::Reversed => words::reversed(language),
        MarkCause::SpeedUnit(written, asked) => words::speed_unit(language, &unit(written), &unit(asked)),
        MarkCause::Clockwise => words::clockwise(language),
        MarkCause::CrankTurned(degrees) => words::crank_turned(language, degrees),
        MarkCause::NoGravity => words::no_gravity(language),
        MarkCause::GravityUp => words::gravity_up(language),
        MarkCause::NoInertiaForces => words::no_inertia(language),
        MarkCause::NoLoad(number) => words::no_load(language, number),
        MarkCause::FromOtherEnd(link, point) => words::from_other_end(language, link, point),
        MarkCause::OfStudent(name) => words::of_student(language, name),
    }
}

/// The column heads of the class table.
fn heads(language: SheetLanguage) -> [String; 6] {
    [
        words::student(language),
        words::right_cells(language),
        words::wrong_cells(language),
        words::open_cells(language),
        words::percent_right(language),
        words::causes(language),
    ]
}

fn row(own: &StudentMarks, language: SheetLanguage) -> [String; 6] {
    let [right, wrong, open] = own.counts().map(|count| count.to_string());
    [own.own.name.clone(), right, wrong, open, own.percent().to_string(), own.causes(language)]
}

/// The table of the class as text.
pub(crate) fn text(all: &[StudentMarks], options: MarkOptions, width: Option<usize>) -> String {
    let language = options.language;
    let [student, numbers @ .., causes] = heads(language);
    let header = format!("{student} | {}> | {causes}", numbers.map(|head| head.replace(' ', "\n")).join("> | "));
    let table = trimmed(worded(&header, width).add_rows(all.iter().map(|own| row(own, language))));
    format!("{table}\n\n{}\n", criterion_text(language, options.criterion))
}

/// The table of the class as CSV.
pub(crate) fn table(all: &[StudentMarks], options: MarkOptions) -> Result<String> {
    let rows = all.iter().map(|own| row(own, options.language));
    as_csv(std::iter::once(heads(options.language)).chain(rows))
}

/// All cells as JSON, schema 1.
pub(crate) fn json(all: &[StudentMarks], options: MarkOptions) -> String {
    let cell = |own: &NamedSheet, at: (usize, usize), cell: &MarkedCell| {
        let verdict = match cell.verdict {
            CellVerdict::Right => "right",
            CellVerdict::Wrong => "wrong",
            CellVerdict::Unanswered => "unanswered",
        };
        let is_wrong = cell.verdict == CellVerdict::Wrong;
        json!({
            "position": own.sheet.case.crank().input.shown(own.sheet.positions()[at.0]),
            "quantity": own.sheet.columns[at.1].name,
            "unit": own.sheet.columns[at.1].unit,
            "verdict": verdict,
            "answer": cell.answer.as_ref().map(|answer| answer.value),
            "right": if options.hides_answers { Value::Null } else { cell.right.into() },
            "allowed": cell.allowed,
            "cause": is_wrong.then(|| told(options.language, own, cell)),
            "recognised": is_wrong.then_some(cell.cause.is_some()),
        })
    };
    let student = |own: &StudentMarks| {
        let [right, wrong, open] = own.counts();
        let cells = own.marked.iter().flat_map(|marked| {
            let rows = marked.cells.iter().enumerate();
            rows.flat_map(|(row, cells)| cells.iter().enumerate().map(move |(column, cell)| ((row, column), cell)))
        });
        json!({
            "name": own.own.name, "handed_in": own.marked.is_some(),
            "right": right, "wrong": wrong, "unanswered": open, "percent": own.percent(),
            "cells": list(cells, |(at, found)| cell(&own.own, at, found)),
        })
    };
    let criterion = criterion_text(SheetLanguage::English, options.criterion);
    pretty(&json!({ "schema": 1, "criterion": criterion, "students": list(all, student) }))
}

/// The page of the class. If `has_pages`, each name is a link to the student's page in the same directory. If not, the
/// page has a section for each student, and each name is a link to this section.
pub(crate) fn class_page(all: &[StudentMarks], options: MarkOptions, has_pages: bool) -> String {
    let language = options.language;
    let title = words::marks_of_the_class(language);
    let mut body = format!("<h1>{}</h1>\n<table><tr>", escaped(&title));
    heads(language).iter().for_each(|head| body += &format!("<th>{}</th>", escaped(head)));
    body += "</tr>\n";
    for own in all {
        let [name, right, wrong, open, percent, causes] = row(own, language).map(|cell| escaped(&cell));
        let link = if has_pages { format!("{name}.html") } else { format!("#{name}") };
        let _ = writeln!(
            body,
            "<tr><td><a href=\"{link}\">{name}</a></td><td class=\"n\">{right}</td><td class=\"n\">{wrong}</td>\
             <td class=\"n\">{open}</td><td class=\"n\">{percent}</td><td>{causes}</td></tr>"
        );
    }
    let _ =
        writeln!(body, "</table>\n<p class=\"small\">{}</p>", escaped(&criterion_text(language, options.criterion)));
    if !has_pages {
        for own in all {
            let name = escaped(&own.own.name);
            let _ = writeln!(body, "<section id=\"{name}\"><h2>{name}</h2>\n{}</section>", cells(own, options));
        }
    }
    page(language, &title, &body)
}

/// The page of one student.
pub(crate) fn student_page(own: &StudentMarks, options: MarkOptions) -> String {
    let title = words::marks_of(options.language, &own.own.name);
    page(options.language, &title, &format!("<h1>{}</h1>\n{}", escaped(&title), cells(own, options)))
}

/// All cells of a student, each with a colour and a sign for its verdict, and a table of the wrong cells with causes.
/// Cells that are not right also have the right value, unless right values are left out.
fn cells(own: &StudentMarks, options: MarkOptions) -> String {
    let language = options.language;
    let Some(marked) = &own.marked else { return format!("<p>{}</p>\n", words::not_handed_in(language)) };
    let sheet = &own.own.sheet;
    let [right, wrong, open] = own.counts();
    let count = right + wrong + open;
    let mut text = format!("<p>{}</p>\n", words::right_of_cells(language, &right, &count, &own.percent()));
    let _ = writeln!(text, "<p class=\"small\">{}</p>", words::legend(language));
    let _ = write!(text, "<table><tr><th>{}</th><th>{}</th>", words::quantity(language), words::unit_word(language));
    (0..sheet.right.len()).for_each(|row| text += &format!("<th class=\"n\">{}</th>", position(sheet, row)));
    text += "</tr>\n";
    for (column, asked) in sheet.columns.iter().enumerate() {
        let (name, unit) = (escaped(&quantity(language, asked)), words::unit(language, asked.unit));
        let _ = write!(text, "<tr><td>{name}</td><td>{unit}</td>");
        for cell in marked.cells.iter().map(|row| &row[column]) {
            let (class, sign) = match cell.verdict {
                CellVerdict::Right => ("right", '✓'),
                CellVerdict::Wrong => ("wrong", '✗'),
                CellVerdict::Unanswered => ("open", '–'),
            };
            let answer = cell.answer.as_ref().map_or(String::new(), |answer| escaped(&answer.text));
            let shows = cell.verdict != CellVerdict::Right && !options.hides_answers;
            let right = if shows { format!("<br>{}", cell_text(sheet, column, cell.right, 1)) } else { String::new() };
            let _ = write!(text, "<td class=\"n {class}\">{sign} {answer}{right}</td>");
        }
        text += "</tr>\n";
    }
    text += "</table>\n";
    if wrong > 0 {
        text += &causes(own, marked, options);
    }
    let _ = writeln!(text, "<p class=\"small\">{}</p>", escaped(&criterion_text(language, options.criterion)));
    text
}

/// The table of the wrong cells with their causes.
fn causes(own: &StudentMarks, marked: &MarkedSheet, options: MarkOptions) -> String {
    let (language, sheet) = (options.language, &own.own.sheet);
    let mut heads = vec![words::position(language), words::quantity(language), words::answer(language)];
    heads.extend((!options.hides_answers).then(|| words::right_value(language)));
    heads.push(words::cause(language));
    let heads: Vec<String> = heads.iter().map(|head| format!("<th>{head}</th>")).collect();
    let mut text = format!("<table><tr>{}</tr>\n", heads.concat());
    for (row, column) in wrong_cells(marked) {
        let cell = &marked.cells[row][column];
        let answer = cell.answer.as_ref().map_or("", |answer| &answer.text);
        let right = match options.hides_answers {
            true => String::new(),
            false => format!("<td class=\"n\">{}</td>", cell_text(sheet, column, cell.right, 1)),
        };
        let _ = writeln!(
            text,
            "<tr><td class=\"n\">{}</td><td>{}</td><td class=\"n\">{}</td>{right}<td>{}</td></tr>",
            position(sheet, row),
            escaped(&quantity(language, &sheet.columns[column])),
            escaped(answer),
            escaped(&told(language, &own.own, cell))
        );
    }
    text + "</table>\n"
}
