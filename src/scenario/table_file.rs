//! Tables of published numbers: CSV files with a header, read as text because the printed digits count.

use std::ops::Range;
use std::path::{Path, PathBuf};

use super::oracle::{ExpectedCell, Known, OraclePoint, OracleSeries, digits};
use super::printed::{Printed, PrintedChannel};
use super::reader::{Sign, Table};
use super::source::Source;
use super::unit::ANGLE;
use super::words::suggestion;
use linkage::error::{Error, ErrorKind, Result};

/// Crank angles (rad) nearer than this are the same row.
const SAME_CRANK: f64 = 1e-9;

/// Name and series of the table that an oracle with the key `file` describes.
pub fn read(oracle: &mut Table, known: &Known) -> Result<(String, Vec<OracleSeries>)> {
    let file = oracle.string("file")?;
    let path: PathBuf = oracle.source().path.parent().unwrap_or(Path::new("")).join(&file);
    let text = std::fs::read_to_string(&path).map_err(|error| {
        oracle
            .wrong(ErrorKind::Io, "file", format!("the table {} cannot be read: {error}", path.display()))
            .help("the path is relative to the scenario's directory")
    })?;
    let source = Source { path: &path, text: &text };
    let rows = Rows::read(&source).map_err(|error| error.key(oracle.path_of("file")))?;

    let crank = oracle.string("crank")?;
    let Some(unit) = ANGLE.units.iter().find(|unit| crank.ends_with(&format!("_{}", unit.suffix))) else {
        let error = oracle.wrong(ErrorKind::Input, "crank", format!("column \"{crank}\" does not say its unit"));
        return Err(error.help("the column of crank angles ends in `_deg` or `_rad`"));
    };
    let column = rows.column(&crank).map_err(|error| error.key(oracle.path_of("crank")))?;
    let cranks: Vec<f64> = rows
        .cells(column)
        .map(|cell| cell.printed().map(|printed| unit.to_si(printed.value)))
        .collect::<Result<_>>()
        .map_err(|error| error.key(oracle.path_of("crank")))?;

    let digits = if oracle.has("digits") { Some(digits(oracle)?) } else { None };
    let slack = slack(oracle)?;
    let known = &known.of_table(digits, slack);
    let mut columns = oracle.table("columns")?;
    let mut all = Vec::new();
    for column in columns.all_tables()? {
        all.push(series(column, &rows, &cranks, known)?);
    }
    if all.is_empty() {
        let help = "map at least one column: `P2x_mm = { channel = \"point.2.x_mm\" }`";
        return Err(columns.fault("there is no column").help(help));
    }
    let name = path.file_name().map_or(file, |name| name.to_string_lossy().into_owned());
    Ok((name, all))
}

fn series(mut table: Table, rows: &Rows, cranks: &[f64], known: &Known) -> Result<OracleSeries> {
    let name = table.name().to_string();
    let column = rows.column(&name).map_err(|error| error.key(table.path()))?;
    let (_, channel) = known.channel(&mut table)?;
    let offset = offset(&mut table, &channel)?;
    let finding = table.optional_string("finding")?;
    let expects = table.tables("expect")?;
    table.finish()?;
    let mut findings: Vec<Option<String>> = vec![None; cranks.len()];
    for mut expect in expects {
        let crank = expect.quantity("crank", &ANGLE, Sign::Any)?;
        let finding = expect.string("finding")?;
        expect.finish()?;
        let Some(row) = cranks.iter().position(|row| (row - crank).abs() <= SAME_CRANK) else {
            let error = expect.wrong(ErrorKind::Input, "crank", "the table has no row with this crank angle");
            return Err(error.help("give a crank angle that stands in the table"));
        };
        findings[row] = Some(finding);
    }
    let (mut points, mut expected) = (Vec::with_capacity(cranks.len()), Vec::new());
    for ((cell, &crank), finding) in rows.cells(column).zip(cranks).zip(findings) {
        let printed = cell.printed().map_err(|error| error.key(table.path()))?.with_zeros(known.digits);
        let (value, bound) = (channel.to_si(printed.value) - offset, channel.to_si(printed.half_unit() + known.slack));
        let point = OraclePoint { crank, value, bound, digits: printed.digits };
        match finding {
            None => points.push(point),
            Some(finding) => expected.push(ExpectedCell { point, finding }),
        }
    }
    let PrintedChannel { channel, magnitude, .. } = channel;
    Ok(OracleSeries { name, channel, magnitude, points, expected, finding })
}

/// The error that the published numbers are known to have, in the printed unit; it must be explained.
fn slack(oracle: &mut Table) -> Result<f64> {
    let Some(slack) = oracle.optional_number("slack")? else { return Ok(0.0) };
    let why = oracle.string("why")?;
    if slack > 0.0 && !why.trim().is_empty() {
        return Ok(slack);
    }
    Err(oracle
        .wrong(ErrorKind::Input, "slack", format!("found {slack}, explained by \"{why}\""))
        .help("give a positive number and the reason why the published numbers are as far off"))
}

/// What the printed values exceed the channel by, in SI; zero if it is not given.
fn offset(table: &mut Table, channel: &PrintedChannel) -> Result<f64> {
    match channel.family {
        Some(family) => Ok(table.optional_quantity("offset", family, Sign::Any)?.unwrap_or(0.0)),
        None => Ok(0.0),
    }
}

/// A CSV file in memory.
struct Rows<'a> {
    source: &'a Source<'a>,
    header: csv::StringRecord,
    records: Vec<csv::StringRecord>,
}

/// One cell with its place.
struct Cell<'a> {
    source: &'a Source<'a>,
    text: &'a str,
    span: Range<usize>,
}

impl<'a> Rows<'a> {
    #[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the CSV reader")]
    fn read(source: &'a Source<'a>) -> Result<Self> {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(source.text.as_bytes());
        let wrong = |error: &csv::Error| {
            let start = error.position().map_or(0, |position| position.byte() as usize);
            let message = match error.kind() {
                csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                    format!("the row has {len} cells, but the header has {expected_len}")
                }
                _ => format!("the table is not valid CSV: {error}"),
            };
            Error::new(ErrorKind::Input, message).at(source.place(line_from(source.text, start))).help(
                "separate cells with commas and give every row as many cells as the header; decimals take a point",
            )
        };
        let header = reader.headers().map_err(|error| wrong(&error))?.clone();
        let records: Vec<_> = reader.records().collect::<std::result::Result<_, _>>().map_err(|error| wrong(&error))?;
        if records.is_empty() {
            let error = Error::new(ErrorKind::Input, "the table has no rows").at(source.place(0..0));
            return Err(error.help("give a header and at least one row"));
        }
        Ok(Rows { source, header, records })
    }

    fn column(&self, name: &str) -> Result<usize> {
        self.header.iter().position(|column| column == name).ok_or_else(|| {
            Error::new(ErrorKind::Input, format!("the table has no column \"{name}\""))
                .at(self.source.place(line_from(self.source.text, 0)))
                .help(suggestion(name, &self.header, "\""))
        })
    }

    fn cells(&self, column: usize) -> impl Iterator<Item = Cell<'_>> {
        self.records.iter().map(move |record| {
            let start = record.position().map_or(0, |position| position.byte() as usize);
            let line = line_from(self.source.text, start);
            let text = &record[column];
            Cell { source: self.source, text, span: within(self.source.text, line, record.len(), column) }
        })
    }
}

impl Cell<'_> {
    fn printed(&self) -> Result<Printed> {
        Printed::parse(self.text).ok_or_else(|| {
            Error::new(ErrorKind::Input, format!("found \"{}\", but a decimal number is needed", self.text))
                .at(self.source.place(self.span.clone()))
                .help("write it as printed, with a decimal point; a cell known to be wrong is named under `expect`, with its finding")
        })
    }
}

/// The first line with something on it from byte `start` on.
fn line_from(text: &str, start: usize) -> Range<usize> {
    let rest = text.get(start..).unwrap_or("");
    let start = start + (rest.len() - rest.trim_start_matches(['\r', '\n']).len());
    let length = text.get(start..).map_or(0, |rest| rest.find(['\r', '\n']).unwrap_or(rest.len()));
    start..start + length
}

/// The span of a cell in its line; the whole line if quotes hide where the cells end.
fn within(text: &str, line: Range<usize>, cells: usize, column: usize) -> Range<usize> {
    let parts: Vec<&str> = text.get(line.clone()).unwrap_or("").split(',').collect();
    if parts.len() != cells {
        return line;
    }
    let start = line.start + parts[..column].iter().map(|part| part.len() + 1).sum::<usize>();
    start..start + parts[column].len()
}
