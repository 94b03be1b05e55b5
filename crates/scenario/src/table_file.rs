//! Tables of published numbers: CSV files with a header. The tables are read as text, because the printed digits
//! matter.

use crate::sentences;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::malformed::has_decimal_comma;
use super::printed::{Correction, Printed, PrintedChannel, check_apart, digits, finding};
use super::reader::{Sign, TomlTable};
use super::series::{self, ExpectedCell, Known, OraclePoint, OracleSeries, instant};
use super::source::Source;
use super::words::suggestion;
use columns::{Records, Twice};
use formula::Rounded;
use linkage::case::{Case, When};
use linkage::error::{Advice, Error, ErrorKind, Place, Result};
use linkage::mechanism::is_unseen;

/// Largest difference between an instant under `expect` and the instant of the row that it denotes (rad, m or s).
const SAME: f64 = 1e-9;

/// Memory for a row of a table during reading (bytes): the row's position in the text, and its instant.
const OF_ROW: f64 = (size_of::<u32>() + size_of::<(When, f64)>()) as f64;
/// Memory for a number of a table (bytes): as a cell, as a printed number, and as a point of the oracle.
const OF_NUMBER: f64 =
    (size_of::<columns::TableCell>() + size_of::<Rounded>() + size_of::<Printed>() + size_of::<OraclePoint>()) as f64;
/// Default of the memory limit (bytes). The proof has the same limit.
const MOST: f64 = 4e9;

/// Reads the table that an oracle names under the key `file`. Returns the name and the series of the table.
pub fn read(oracle: &mut TomlTable, known: &Known, case: &Case) -> Result<(String, Vec<OracleSeries>)> {
    let file = oracle.string("file")?;
    let path: PathBuf = oracle.source().path.parent().unwrap_or(Path::new("")).join(&file);
    let text = files::read_named(&path).map_err(|error| {
        oracle
            .wrong(ErrorKind::Io, "file", sentences::the_table_cannot_be_read(&path.display(), &error))
            .help(files::way_out(&error, sentences::THE_PATH_IS_RELATIVE_TO_THE_SCENARIO))
    })?;
    let source = Source::new(&path, &text);
    let rows = Rows::read(&source).map_err(|error| error.key(oracle.path_of("file")))?;

    let from = series::Rows::read(oracle, case)?;
    let mut columns = oracle.table("columns")?;
    let needed = rows.records.len() as f64 * (OF_ROW + OF_NUMBER * columns.keys().len() as f64);
    let most = known.memory.unwrap_or(MOST);
    if needed > most {
        let [needs, allowed] = [needed, most].map(|bytes| format!("{:.1} GB", bytes / 1e9));
        let message = sentences::reading_rows_of_what_oracle(&rows.records.len(), &needs, &allowed);
        let error = oracle.wrong(ErrorKind::Unsupported, "file", message);
        return Err(error.help(sentences::GIVE_FEWER_ROWS_OR_FEWER).or_help(Advice::MoreMemory { to: needed }));
    }
    let instants: Vec<(When, f64)> = rows
        .column(&from.column)
        .and_then(|column| rows.instants(column, &from, case))
        .map_err(|error| error.key(oracle.path_of(from.key)))?;

    let digits = if oracle.has("digits") { Some(digits(oracle)?) } else { None };
    let slack = slack(oracle)?;
    let known = &known.of_table(digits, slack);
    let mut all = Vec::new();
    for mut column in columns.all_tables()? {
        let series = column.read(|column| series(column, &rows, &instants, known, case)).map(Some);
        all.extend(oracle.part(series));
    }
    if all.is_empty() {
        let help = sentences::MAP_AT_LEAST_ONE_COLUMN_P2X;
        return Err(columns.fault(sentences::THERE_IS_NO_COLUMN).help(help));
    }
    let name = path.file_name().map_or(file, |name| name.to_string_lossy().into_owned());
    Ok((name, all))
}

fn series(
    table: &mut TomlTable,
    rows: &Rows,
    instants: &[(When, f64)],
    known: &Known,
    case: &Case,
) -> Result<OracleSeries> {
    let name = table.name().to_string();
    let column = rows.column(&name).map_err(|error| error.key(table.path()))?;
    let (_, channel) = known.channel(table)?;
    let offset = offset(table, &channel)?;
    let printed = rows.printed(column, known.digits).map_err(|error| error.key(table.path()))?;
    let whole = whole_column(table, &printed)?;
    let cells = single_cells(table, instants, &printed, case)?;
    if whole.is_some() && !cells.is_empty() {
        let message = sentences::A_COLUMN_THAT_IS_WRONG_AS_A_WHOLE;
        return table.refuse("expect", message, sentences::KEEP_EITHER_EXPECT_OR_FINDING);
    }
    table.finish()?;
    let point = |row: usize, number: &Printed, slack: f64| OraclePoint {
        at: instants[row].0,
        at_error: instants[row].1,
        value: channel.to_si(number.value) - offset,
        bound: channel.to_si(number.half_unit + slack),
        digits: number.digits,
    };
    // The slack widens the bound of the printed value. The bound of the correct value contains no slack.
    let corrected = |row: usize, finding: &str, right: &Printed| ExpectedCell {
        point: point(row, &printed[row], known.slack),
        right: point(row, right, 0.0),
        finding: finding.into(),
    };
    let (mut points, mut expected) = (Vec::with_capacity(instants.len()), Vec::new());
    let wrong = whole.map(|(finding, right)| {
        let all = right.iter().enumerate().map(|(row, right)| corrected(row, &finding, right)).collect();
        (finding, all)
    });
    let single = if wrong.is_none() { 0..instants.len() } else { 0..0 };
    for row in single {
        match cells.iter().find(|(of, _)| *of == row) {
            None => points.push(point(row, &printed[row], known.slack)),
            Some((_, Correction { finding, right })) => expected.push(corrected(row, finding, right)),
        }
    }
    let PrintedChannel { channel, magnitude, .. } = channel;
    Ok(OracleSeries { name, channel, magnitude, points, expected, wrong })
}

/// The single wrong cells, from the list `expect`: the row of each cell, and the correct value in this row.
fn single_cells(
    table: &mut TomlTable,
    instants: &[(When, f64)],
    printed: &[Printed],
    case: &Case,
) -> Result<Vec<(usize, Correction)>> {
    let mut cells = Vec::new();
    for mut expect in table.tables("expect")? {
        let at = instant(&mut expect, case)?;
        let is_same = |(row, _): &(When, f64)| match (*row, at) {
            (When::Crank(own), When::Crank(asked)) | (When::Time(own), When::Time(asked)) => {
                (own - asked).abs() <= SAME
            }
            (When::Crank(_), When::Time(_)) | (When::Time(_), When::Crank(_)) => false,
        };
        let Some(row) = instants.iter().position(is_same) else {
            let (key, what) = match at {
                When::Crank(_) => ("crank", "crank angle"),
                When::Time(_) => ("time", "time"),
            };
            let help = sentences::give_a_that_stands_in_the_table(&what);
            return expect.refuse(key, sentences::the_table_has_no_row_with_this(&what), help);
        };
        let Some(correction) = Correction::read(&mut expect, &printed[row])? else {
            return Err(expect.fault(sentences::FINDING_IS_MISSING).help(sentences::SAY_WHICH_FINDING_CALLS_THE_CELL));
        };
        expect.finish()?;
        cells.push((row, correction));
    }
    Ok(cells)
}

/// For a column in which every value is wrong: the finding (key `finding`), and the correct values (table `right`).
fn whole_column(table: &mut TomlTable, printed: &[Printed]) -> Result<Option<(String, Vec<Printed>)>> {
    let Some(finding) = finding(table)? else { return Ok(None) };
    let mut right = table.table("right")?;
    let values = right.numbers("values")?;
    let digits = digits(&mut right)?;
    right.finish()?;
    if values.len() != printed.len() {
        let message = sentences::found_right_values_for_the_column(&values.len(), &printed.len());
        return right.refuse("values", message, sentences::GIVE_ONE_VALUE_FOR_EVERY_ROW);
    }
    let right: Vec<Printed> = values.into_iter().map(|value| Printed::with_digits(value, digits)).collect();
    printed.iter().zip(&right).try_for_each(|(printed, right)| check_apart(table, printed, right))?;
    Ok(Some((finding, right)))
}

/// Known error of the published numbers, in the printed unit. The file must explain the known error.
fn slack(oracle: &mut TomlTable) -> Result<f64> {
    let Some(slack) = oracle.optional_number("slack")? else {
        return match oracle.has("why") {
            true => Err(oracle.lacks(&["slack"], sentences::WHY_EXPLAINS_SLACK_BY_WHICH_ALL)),
            false => Ok(0.0),
        };
    };
    let why = oracle.string("why")?;
    if slack > 0.0 && !why.trim().is_empty() {
        return Ok(slack);
    }
    let help = sentences::GIVE_A_POSITIVE_NUMBER_AND_THE_REASON;
    oracle.refuse("slack", sentences::found_explained_by(&slack, &why), help)
}

/// Constant that the printed values contain in addition to the channel's values, in SI; zero by default.
fn offset(table: &mut TomlTable, channel: &PrintedChannel) -> Result<f64> {
    match channel.family {
        Some(family) => Ok(table.optional_quantity("offset", family, Sign::Any)?.unwrap_or(0.0)),
        None => Ok(0.0),
    }
}

/// A CSV file in memory.
struct Rows<'a> {
    source: &'a Source<'a>,
    records: Records<'a>,
}

impl<'a> Rows<'a> {
    fn read(source: &'a Source<'a>) -> Result<Self> {
        let wrong = |at: Range<usize>, message: String| Error::new(ErrorKind::Input, message).at(source.place(at));
        let header = line_from(source.text, 0);
        let whole = source.text.get(header.clone()).unwrap_or("");
        if let (false, Some(other)) =
            (whole.contains(','), [';', '\t'].into_iter().find(|other| whole.contains(*other)))
        {
            let message = sentences::the_header_has_one_cell_because(&format_args!("{other:?}"));
            return Err(wrong(header, message).help(sentences::SEPARATE_CELLS_WITH_COMMAS_AND_WRITE));
        }
        let records = Records::of(source.text).map_err(|(at, count)| {
            let expected = whole.split(',').count();
            let commas = if count == 2 * expected { sentences::ITS_DECIMALS_SEEM_TO_HAVE_COMMAS } else { "" };
            wrong(at, sentences::the_row_has_cells_but_the_header(&count, &expected, &commas))
                .help(sentences::SEPARATE_CELLS_WITH_COMMAS_AND_GIVE)
        })?;
        if records.header.iter().any(|column| column.contains(is_unseen)) {
            let error = wrong(0..0, sentences::THE_HEADER_HOLDS_A_LETTER.into());
            return Err(error.help(sentences::TAKE_OUT_LINE_BREAKS_AND_CONTROL));
        }
        if let Some(twice) = Twice::of(&records.header) {
            return Err(wrong(header, twice.to_string()).help(Twice::HELP));
        }
        if records.is_empty() {
            let error = wrong(0..0, sentences::THE_TABLE_HAS_NO_ROWS.into());
            return Err(error.help(sentences::GIVE_A_HEADER_AND_AT_LEAST));
        }
        Ok(Rows { source, records })
    }

    fn column(&self, name: &str) -> Result<usize> {
        let header = &self.records.header;
        header.iter().position(|column| column == name).ok_or_else(|| {
            Error::new(ErrorKind::Input, sentences::the_table_has_no_column(&name))
                .at(self.source.place(line_from(self.source.text, 0)))
                .help(suggestion(name, header.iter().map(String::as_str), "\""))
        })
    }

    fn numbers(&self, column: usize) -> Result<Vec<columns::TableCell>> {
        (0..self.records.len()).map(|row| self.number(row, column)).collect()
    }

    /// The numbers of a column. If `digits` is given, each number counts as printed with `digits` decimals, or with
    /// those of its cell if the cell has more. If `digits` is `None`, the rounding errors follow from the cells.
    fn printed(&self, column: usize, digits: Option<i32>) -> Result<Vec<Printed>> {
        let cells = self.numbers(column)?;
        Ok(match digits {
            Some(all) => cells.iter().map(|cell| Printed::with_digits(cell.value, all.max(cell.decimals))).collect(),
            None => columns::numbers_beside(&cells, || self.others(column)).iter().map(Printed::of_column).collect(),
        })
    }

    /// The columns other than `column` that contain numbers, whether the oracle reads them or not.
    fn others(&self, column: usize) -> impl Iterator<Item = Vec<columns::TableCell>> {
        let others = (0..self.records.header.len()).filter(move |other| *other != column);
        let rows = || 0..self.records.len();
        others.filter_map(move |other| {
            rows().map(|row| columns::TableCell::parse(&self.records.cell(row, other))).collect()
        })
    }

    /// The instants of the rows, and the largest rounding error of each instant.
    fn instants(&self, column: usize, from: &series::Rows, case: &Case) -> Result<Vec<(When, f64)>> {
        let numbers = columns::numbers(&self.numbers(column)?);
        let chosen = if from.are_degrees() { columns::degrees_chosen } else { columns::chosen };
        let is_chosen = chosen(&numbers);
        let end = series::end(case);
        let of = |(row, printed): (usize, Rounded)| {
            let printed = if is_chosen { Rounded::exact(printed.value) } else { printed };
            let wrong =
                |message| Error::new(ErrorKind::Input, message).at(self.place(row, column)).help(series::TIME_HELP);
            from.instant(case, end, printed).map_err(wrong)
        };
        numbers.into_iter().enumerate().map(of).collect()
    }

    fn number(&self, row: usize, column: usize) -> Result<columns::TableCell> {
        let text = self.records.cell(row, column);
        Printed::cell(&text).ok_or_else(|| {
            let comma = if has_decimal_comma(&text) { sentences::AND_DECIMALS_TAKE_A_POINT } else { "" };
            Error::new(ErrorKind::Input, sentences::found_but_a_decimal_number(&text, &comma))
                .at(self.place(row, column))
                .help(sentences::WRITE_IT_AS_PRINTED_WITH_A_DECIMAL)
        })
    }

    /// The span of a cell in its line. If quotes hide where the cells end, the span is the whole line.
    fn place(&self, row: usize, column: usize) -> Place {
        let mut span = self.records.line(row);
        let parts: Vec<&str> = self.source.text.get(span.clone()).unwrap_or("").split(',').collect();
        if parts.len() == self.records.header.len() {
            span.start += parts[..column].iter().map(|part| part.len() + 1).sum::<usize>();
            span.end = span.start + parts[column].len();
        }
        self.source.place(span)
    }
}

/// The first line that is not blank, from byte `start` on.
fn line_from(text: &str, start: usize) -> Range<usize> {
    let rest = text.get(start..).unwrap_or("");
    let start = start + (rest.len() - rest.trim_start_matches(['\r', '\n']).len());
    let length = text.get(start..).map_or(0, |rest| rest.find(['\r', '\n']).unwrap_or(rest.len()));
    start..start + length
}
