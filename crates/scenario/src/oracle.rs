//! `[[oracle]]`: numbers that the mechanism must reproduce. The bound on the error of a number follows from its printed
//! digits.

use super::figure::MechanismFigure;
use super::figure::{self, OracleFigure};
use super::keys::key::{FileKey, Section, ValueKind, needed, optional};
use super::printed::{Correction, Printed, PrintedChannel, number};
use super::reader::{Faults, TomlTable};
use super::series::{ExpectedCell, Known, OraclePoint, OracleSeries, instant};
use super::table_file;
use crate::sentences;
use linkage::case::{Case, When};
use linkage::error::Result;

const NUMBER: &[FileKey] = &[
    needed("value", ValueKind::Number).means("the number, in the printed unit"),
    needed("digits", ValueKind::Integer).means("number of printed decimals"),
];

const FINDING: FileKey = optional("finding", ValueKind::Text, "none: the number is right")
    .means("anchor of the section of `docs/findings.md` that says why the number is wrong");
const RIGHT: FileKey =
    optional("right", ValueKind::Table, "required with `finding`").means("the correct number, in the printed unit");
const VALUE: FileKey = needed("value", ValueKind::Number).means("the number, in the unit of the name");
const DIGITS: FileKey = needed("digits", ValueKind::Integer).means("number of printed decimals");
const CRANK: FileKey =
    optional("crank", ValueKind::INPUTS, "a time is given").means("crank angle, or slide of the first drive");
const AT_TIME: FileKey = optional("time", ValueKind::TIMES, "an input is given").means("time");

/// Descriptions of the keys that this module reads.
pub const SECTIONS: &[Section] = &[
    Section::at("oracle").with(&[
        needed("source", ValueKind::Text).means("author, title, table"),
        optional("name", ValueKind::Text, "none").means("name for reports"),
        optional("basis", ValueKind::Choice(|| OracleBasis::ALL.map(OracleBasis::word).to_vec()), "`\"published\"`")
            .means(
                "how the numbers were obtained: printed in the source, recomputed from the data of the source, or \
                 derived from given data by a formula",
            ),
        optional("values", ValueKind::Tables, "one of `file`, `values` and `figures`").means("numbers at one instant"),
        optional("figures", ValueKind::Tables, "one of `file`, `values` and `figures`")
            .means("figures of the mechanism"),
        optional("file", ValueKind::Text, "one of `file`, `values` and `figures`")
            .means("path of a table, relative to the scenario's directory"),
        CRANK,
        optional("crank", ValueKind::Text, "with `file`: the other column is given").means(
            "column of the inputs of the file, as this scenario measures them: crank angles (ends in `_deg` or \
             `_rad`), or slides of the first drive (ends in `_m` or `_mm`)",
        ),
        AT_TIME,
        optional("time", ValueKind::Text, "with `file`: the other column is given")
            .means("column of the times of the file (ends in `_s` or `_ms`)"),
        optional("columns", ValueKind::Table, "required with `file`")
            .means("meaning of the columns of the table, by name"),
        optional("digits", ValueKind::Integer, "counted in the table")
            .means("number of decimals of the table, if trailing zeros are not printed"),
        optional("slack", ValueKind::Number, "0")
            .means("known error of the published numbers, in their printed unit, added to their bounds"),
        optional("why", ValueKind::Text, "required with `slack`").means("reason for `slack`"),
    ]),
    Section::at("oracle.values").with(&[
        needed("channel", ValueKind::Text).means("channel, with the printed unit as its ending"),
        VALUE,
        DIGITS,
        FINDING,
        RIGHT,
    ]),
    Section::at("oracle.values.right").with(NUMBER),
    Section::at("oracle.figures").with(&[
        needed("figure", ValueKind::Text).means("name of the figure"),
        optional("points", ValueKind::Texts, "required for a distance").means("the two points of a distance"),
        VALUE,
        DIGITS,
        FINDING,
        RIGHT,
    ]),
    Section::at("oracle.figures.right").with(NUMBER),
    Section::at("oracle.columns.*").with(&[
        needed("channel", ValueKind::Text).means("channel, with the printed unit as its ending"),
        optional("offset", ValueKind::LENGTHS_OR_ANGLES, "0")
            .means("printed = channel + offset; for coordinates and angles"),
        optional("expect", ValueKind::Tables, "none")
            .means("cells known to be wrong, each with the input or the time of its row"),
        FINDING,
        RIGHT,
    ]),
    Section::at("oracle.columns.*.expect").with(&[CRANK, AT_TIME, FINDING, RIGHT]),
    Section::at("oracle.columns.*.expect.right").with(NUMBER),
    Section::at("oracle.columns.*.right").with(&[
        needed("values", ValueKind::Numbers).means("one value for each row"),
        needed("digits", ValueKind::Integer).means("number of printed decimals"),
    ]),
];

/// Numbers of one source.
#[derive(Clone, Debug, PartialEq)]
pub struct Oracle {
    /// The name that the scenario states. Without a stated name, the file name of the table (`positions.csv`) is used.
    /// Numbers in the scenario itself are named `inline 1`, `inline 2`, ...
    pub name: String,
    /// Source of the numbers, as the scenario states it.
    pub source: String,
    /// How the numbers were obtained.
    pub basis: OracleBasis,
    /// Values of channels at inputs (crank angles or slides) or at times.
    pub series: Vec<OracleSeries>,
    /// Figures of the mechanism.
    pub figures: Vec<OracleFigure>,
}

linkage::words! {
    /// Origin of the numbers of an oracle.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum OracleBasis: word {
        /// Printed in the source.
        Published = "published",
        /// Recomputed by this project from the data in the source.
        Recomputed = "recomputed",
        /// Derived from given data by a formula.
        Derived = "derived",
    }
}

impl Oracle {
    /// The part of the oracle that stays valid if the first drive starts at another input than in the file. The start
    /// must lie on the branch of the file's start. `None` if no part is valid.
    pub(super) fn at_another_start(mut self, case: &Case) -> Option<Oracle> {
        self.figures.retain(|figure| !matches!(figure.figure, MechanismFigure::Distance(_)));
        // With another input at t = 0, the motion is a different function of time, so values at times are removed.
        self.series.retain(|series| series.instants().all(|at| at.time().is_none()));
        // Values at inputs are removed if they also depend on the time or on the turns since the start.
        // A further drive or a changing speed makes values depend on the time.
        // A torsional spring makes values depend on the turns since the start.
        let winds = |load: &linkage::drive::Load| load.nature().twist.is_some();
        if !case.is_steady() || !case.drives.further().is_empty() || case.loads.iter().any(winds) {
            self.series.clear();
        }
        (!self.series.is_empty() || !self.figures.is_empty()).then_some(self)
    }
}

impl OracleBasis {
    /// Reads the key `basis`; `Published` if the key is missing.
    fn read(table: &mut TomlTable) -> Result<Self> {
        let words = Self::ALL.map(|basis| (basis.word(), basis));
        Ok(table
            .optional_choice("basis", sentences::IS_NO_WAY_TO_KNOW_NUMBERS, &words)?
            .unwrap_or(OracleBasis::Published))
    }
}

/// Reads the oracles of a case. Oracles with mistakes are left out.
pub(super) fn read(tables: Vec<TomlTable>, case: &Case, memory: Option<f64>, faults: &mut Faults) -> Vec<Oracle> {
    let (wanted, all) = (case.channels(), case.all_channels());
    let known = Known { channels: &all, wanted: &wanted, digits: None, slack: 0.0, memory };
    let mut inline = 0;
    let one = |mut table: TomlTable| faults.read(&mut table, |table| oracle(table, &known, case, &mut inline));
    tables.into_iter().filter_map(one).collect()
}

/// Reads one oracle. `inline` counts the oracles with numbers in the scenario itself.
fn oracle(table: &mut TomlTable, known: &Known, case: &Case, inline: &mut usize) -> Result<Oracle> {
    let source = table.string("source")?;
    let own_name = table.optional_string("name")?;
    let forms = ["file", "values", "figures"].map(|key| table.has(key));
    let basis = OracleBasis::read(table)?;
    let mut oracle = Oracle { name: String::new(), source, basis, series: Vec::new(), figures: Vec::new() };
    match forms {
        [true, false, false] => {
            (oracle.name, oracle.series) = table_file::read(table, known, case)?;
        }
        [false, true, false] => oracle.series = values(table, known, case)?,
        [false, false, true] => oracle.figures = figure::read(table, case)?,
        [false, false, false] => {
            return Err(table.lacks(&["file", "values", "figures"], sentences::GIVE_THE_NUMBERS_DOCS_SCENARIO));
        }
        _ => {
            return Err(table
                .fault(sentences::AN_ORACLE_HAS_EXACTLY_ONE_OF_FILE)
                .help(sentences::SPLIT_IT_INTO_SEVERAL_ORACLE));
        }
    }
    if !forms[0] {
        *inline += 1;
        oracle.name = format!("inline {inline}");
    }
    if let Some(name) = own_name {
        oracle.name = name;
    }
    table.finish()?;
    Ok(oracle)
}

/// Numbers at one instant, written in the scenario itself.
fn values(table: &mut TomlTable, known: &Known, case: &Case) -> Result<Vec<OracleSeries>> {
    let at = instant(table, case)?;
    let mut series = Vec::new();
    for mut entry in table.tables("values")? {
        let own = entry.read(|entry| value(entry, at, known)).map(Some);
        series.extend(table.part(own));
    }
    if series.is_empty() {
        let help = "write `values = [{ channel = \"link.rocker.angle_deg\", value = 82, digits = 3 }]`";
        return table.refuse("values", sentences::THERE_IS_NO_VALUE, help);
    }
    Ok(series)
}

/// One number at an instant.
fn value(entry: &mut TomlTable, at: When, known: &Known) -> Result<OracleSeries> {
    let (name, channel) = known.channel(entry)?;
    let si = |number: Printed| OraclePoint {
        at,
        at_error: 0.0,
        value: channel.to_si(number.value),
        bound: channel.to_si(number.half_unit),
        digits: number.digits,
    };
    let printed = number(entry)?;
    let correction = Correction::read(entry, &printed)?;
    entry.finish()?;
    let point = si(printed);
    let (mut points, mut expected) = (Vec::new(), Vec::new());
    match correction {
        None => points.push(point),
        Some(Correction { finding, right }) => expected.push(ExpectedCell { point, right: si(right), finding }),
    }
    let PrintedChannel { channel, magnitude, .. } = channel;
    Ok(OracleSeries { name, channel, magnitude, points, expected, wrong: None })
}
