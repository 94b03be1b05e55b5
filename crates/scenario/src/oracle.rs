//! `[[oracle]]`: numbers that the mechanism must reproduce, each with the bound that its digits give.

use super::correction::{Correction, number};
use super::figure::Figure;
use super::figure::{self, OracleFigure};
use super::instant;
use super::keys::key::{Key, Kind, Section, needed, optional};
use super::printed::{Printed, PrintedChannel};
use super::reader::{Faults, Table};
use super::series::{ExpectedCell, Known, OraclePoint, OracleSeries, When};
use super::table_file;
use linkage::case::Case;
use linkage::error::{ErrorKind, Result};

const NUMBER: &[Key] = &[
    needed("value", Kind::Number, "the number, in the printed unit"),
    needed("digits", Kind::Integer, "number of printed decimals"),
];

const FINDING: Key = optional(
    "finding",
    Kind::Text,
    "anchor of the section of `docs/findings.md` that says why the number is wrong",
    "the number is right",
);
const RIGHT: Key =
    optional("right", Kind::Table, "what is right instead, in the printed unit", "required with `finding`");
const VALUE: Key = needed("value", Kind::Number, "the number, in the unit of the name");
const DIGITS: Key = needed("digits", Kind::Integer, "number of printed decimals");
const CRANK: Key = optional("crank", Kind::INPUTS, "crank angle", "a time is given");
const AT_TIME: Key = optional("time", Kind::TIMES, "time", "a crank angle is given");

/// What is told of the keys that are read here.
pub const SECTIONS: &[Section] = &[
    Section {
        path: "oracle",
        keys: &[
            needed("source", Kind::Text, "author, title, table"),
            optional("name", Kind::Text, "name for reports", "none"),
            optional(
                "basis",
                Kind::Choice(|| OracleBasis::ALL.map(OracleBasis::word).to_vec()),
                "how the numbers are known: printed in the source, computed anew from what it gives, or a formula from given data",
                "`\"published\"`",
            ),
            optional("values", Kind::Tables, "numbers at one instant", "one of `file`, `values` and `figures`"),
            optional("figures", Kind::Tables, "figures of the mechanism", "one of `file`, `values` and `figures`"),
            optional(
                "file",
                Kind::Text,
                "path of a table, relative to the scenario's directory",
                "one of `file`, `values` and `figures`",
            ),
            CRANK,
            optional(
                "crank",
                Kind::Text,
                "column of the crank angles of the file, as this scenario measures them (ends in `_deg` or `_rad`)",
                "with `file`: the other column is given",
            ),
            AT_TIME,
            optional(
                "time",
                Kind::Text,
                "column of the times of the file (ends in `_s` or `_ms`)",
                "with `file`: the other column is given",
            ),
            optional("columns", Kind::Table, "what the columns of the table are, by name", "required with `file`"),
            optional(
                "digits",
                Kind::Integer,
                "number of decimals of the table, where trailing zeros are not printed",
                "the printed ones",
            ),
            optional(
                "slack",
                Kind::Number,
                "known error of the published numbers, in their printed unit, added to their bounds",
                "0",
            ),
            optional("why", Kind::Text, "the reason for it", "required with `slack`"),
        ],
    },
    Section {
        path: "oracle.values",
        keys: &[
            needed("channel", Kind::Text, "channel, with the printed unit as its ending"),
            VALUE,
            DIGITS,
            FINDING,
            RIGHT,
        ],
    },
    Section { path: "oracle.values.right", keys: NUMBER },
    Section {
        path: "oracle.figures",
        keys: &[
            needed("figure", Kind::Text, "which figure"),
            optional("points", Kind::Texts, "the two points of a distance", "required of a distance"),
            VALUE,
            DIGITS,
            FINDING,
            RIGHT,
        ],
    },
    Section { path: "oracle.figures.right", keys: NUMBER },
    Section {
        path: "oracle.columns.*",
        keys: &[
            needed("channel", Kind::Text, "channel, with the printed unit as its ending"),
            optional("offset", Kind::LENGTHS_OR_ANGLES, "printed = channel + offset; for coordinates and angles", "0"),
            optional("expect", Kind::Tables, "cells known to be wrong, by crank angle or time as the table", "none"),
            FINDING,
            RIGHT,
        ],
    },
    Section { path: "oracle.columns.*.expect", keys: &[CRANK, AT_TIME, FINDING, RIGHT] },
    Section { path: "oracle.columns.*.expect.right", keys: NUMBER },
    Section {
        path: "oracle.columns.*.right",
        keys: &[
            needed("values", Kind::Numbers, "one for every row"),
            needed("digits", Kind::Integer, "number of printed decimals"),
        ],
    },
];

/// Numbers of one source.
#[derive(Clone, Debug, PartialEq)]
pub struct Oracle {
    /// The scenario's name for it, else the file name of the table (`positions.csv`). For numbers in the scenario
    /// itself it is `inline 1`, `inline 2`, ...
    pub name: String,
    /// Source of the numbers, and the reason for their own error if they have one.
    pub source: String,
    /// How they are known.
    pub basis: OracleBasis,
    /// Values of channels at crank angles or times.
    pub series: Vec<OracleSeries>,
    /// Figures of the mechanism.
    pub figures: Vec<OracleFigure>,
}

/// How the numbers of an oracle are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OracleBasis {
    /// Printed in the source.
    Published,
    /// Recomputed by this project from the data in the source.
    Recomputed,
    /// Derived from given data by a formula.
    Derived,
}

impl Oracle {
    /// What holds for a case that starts at another crank angle of the same branch; `None` if nothing does.
    pub(super) fn at_another_start(mut self, case: &Case) -> Option<Oracle> {
        self.figures.retain(|figure| !matches!(figure.figure, Figure::Distance(_)));
        // A motion from another angle is another function of time.
        self.series.retain(|series| series.instants().all(|at| at.time().is_none()));
        // A further drive or a changing speed ties the crank angle to time, and a torsional spring to turns from the
        // start.
        let winds = |load: &linkage::drive::Load| load.nature().twist.is_some();
        if !case.is_steady() || !case.drives.further().is_empty() || case.loads.iter().any(winds) {
            self.series.clear();
        }
        (!self.series.is_empty() || !self.figures.is_empty()).then_some(self)
    }
}

impl OracleBasis {
    const ALL: [OracleBasis; 3] = [OracleBasis::Published, OracleBasis::Recomputed, OracleBasis::Derived];

    fn word(self) -> &'static str {
        match self {
            OracleBasis::Published => "published",
            OracleBasis::Recomputed => "recomputed",
            OracleBasis::Derived => "derived",
        }
    }

    /// Reads the key `basis`; published if the key is missing.
    fn read(table: &mut Table) -> Result<Self> {
        let words = Self::ALL.map(|basis| (basis.word(), basis));
        Ok(table.optional_choice("basis", "is no way to know numbers", &words)?.unwrap_or(OracleBasis::Published))
    }
}

/// The oracles of a case, but those with mistakes.
pub(super) fn read(tables: Vec<Table>, case: &Case, memory: Option<f64>, faults: &mut Faults) -> Vec<Oracle> {
    let (wanted, all) = (case.channels(), case.all_channels());
    let known = Known { channels: &all, wanted: &wanted, digits: None, slack: 0.0, memory };
    let mut inline = 0;
    let one = |mut table: Table| faults.read(&mut table, |table| oracle(table, &known, case, &mut inline));
    tables.into_iter().filter_map(one).collect()
}

/// One oracle; `inline` counts those with numbers in the scenario itself.
fn oracle(table: &mut Table, known: &Known, case: &Case, inline: &mut usize) -> Result<Oracle> {
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
            return Err(table.lacks(&["file", "values", "figures"], "give the numbers: docs/scenario.md tells how"));
        }
        _ => {
            return Err(table
                .fault("an oracle has exactly one of `file`, `values` and `figures`")
                .help("split it into several [[oracle]] tables"));
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
fn values(table: &mut Table, known: &Known, case: &Case) -> Result<Vec<OracleSeries>> {
    let at = instant::read(table, case)?;
    let mut series = Vec::new();
    for mut entry in table.tables("values")? {
        let own = entry.read(|entry| value(entry, at, known)).map(Some);
        series.extend(table.part(own));
    }
    if series.is_empty() {
        return Err(table.wrong(ErrorKind::Input, "values", "there is no value").help(VALUE_HELP));
    }
    Ok(series)
}

/// One number at an instant.
fn value(entry: &mut Table, at: When, known: &Known) -> Result<OracleSeries> {
    let (name, channel) = known.channel(entry)?;
    let si = |number: Printed| OraclePoint {
        at,
        at_error: 0.0,
        value: channel.to_si(number.value),
        bound: channel.to_si(number.half_unit()),
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

const VALUE_HELP: &str = "write `values = [{ channel = \"link.rocker.angle_deg\", value = 82, digits = 3 }]`";
