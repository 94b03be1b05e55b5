//! `[[oracle]]`: numbers that the mechanism must reproduce, each with the bound that its digits give.

use super::figure::{self, OracleFigure};
use super::printed::{self, MOST_DIGITS, Printed, PrintedChannel};
use super::reader::{Sign, Table};
use super::table_file;
use super::unit::ANGLE;
use super::words::suggestion;
use linkage::case::{Case, Wanted};
use linkage::error::{ErrorKind, Result};
use linkage::trajectory::{CHANNELS, Channel};

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
    /// Values of channels at crank angles.
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
        let Some(word) = table.optional_string("basis")? else { return Ok(OracleBasis::Published) };
        Self::ALL.into_iter().find(|basis| basis.word() == word).ok_or_else(|| {
            let error = table.wrong(ErrorKind::Input, "basis", format!("numbers cannot be \"{word}\""));
            error.help(suggestion(&word, Self::ALL.map(Self::word), "\""))
        })
    }
}

/// Values of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct OracleSeries {
    /// Column of the table, or the channel as the scenario names it.
    pub name: String,
    /// The channel.
    pub channel: Channel,
    /// Whether the value is the magnitude of a vector; `channel` is then the x component of the vector.
    pub magnitude: bool,
    /// Values that must be reproduced, in the order of the table.
    pub points: Vec<OraclePoint>,
    /// Values known to be wrong, each with its own finding.
    pub expected: Vec<ExpectedCell>,
    /// Finding that says why all values are wrong. They are then listed here and not in the two lists above.
    pub wrong: Option<(String, Vec<ExpectedCell>)>,
}

/// One published value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OraclePoint {
    /// Crank angle (rad, as the scenario measures it).
    pub crank: f64,
    /// Value in the channel's SI unit.
    pub value: f64,
    /// Half a unit of the last printed digit, plus the known error of the numbers, in the channel's SI unit.
    pub bound: f64,
    /// Number of printed decimals, in the printed unit.
    pub digits: i32,
}

/// A printed value that is known to be wrong. It must not be reproduced; the correct value must.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedCell {
    /// The value as printed.
    pub point: OraclePoint,
    /// The correct value.
    pub right: OraclePoint,
    /// Anchor of its finding in `docs/findings.md`.
    pub finding: String,
}

/// All oracles of a case.
pub(super) fn read(tables: Vec<Table>, case: &Case) -> Result<Vec<Oracle>> {
    let (wanted, all) = (case.wanted, case.wanting(Wanted::ALL).channels());
    let channels = all.as_slice();
    let mut inline = 0;
    let mut oracles = Vec::with_capacity(tables.len());
    for mut table in tables {
        let source = table.string("source")?;
        let own_name = table.optional_string("name")?;
        let forms = ["file", "values", "figures"].map(|key| table.has(key));
        let basis = OracleBasis::read(&mut table)?;
        let mut oracle = Oracle { name: String::new(), source, basis, series: Vec::new(), figures: Vec::new() };
        match forms {
            [true, false, false] => {
                (oracle.name, oracle.series) =
                    table_file::read(&mut table, &Known { channels, wanted, digits: None, slack: 0.0 })?;
            }
            [false, true, false] => {
                oracle.series = values(&mut table, &Known { channels, wanted, digits: None, slack: 0.0 })?
            }
            [false, false, true] => oracle.figures = figure::read(&mut table, case)?,
            _ => {
                return Err(table
                    .fault("an oracle has exactly one of `file`, `values` and `figures`")
                    .help("split it into several [[oracle]] tables, or add the numbers"));
            }
        }
        if !forms[0] {
            inline += 1;
            oracle.name = format!("inline {inline}");
        }
        if let Some(name) = own_name {
            oracle.name = name;
        }
        table.finish()?;
        oracles.push(oracle);
    }
    Ok(oracles)
}

/// The channels an oracle may name.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    channels: &'a [Channel],
    wanted: Wanted,
    /// Number of decimals in a table that does not print zeros at the end.
    pub digits: Option<i32>,
    /// Known error of the published numbers, in the printed unit.
    pub slack: f64,
}

impl Known<'_> {
    /// The same for a table with this number of decimals, which does not print zeros at the end, and with this known
    /// error.
    pub fn of_table(self, digits: Option<i32>, slack: f64) -> Self {
        Known { digits, slack, ..self }
    }

    /// The channel under the key `channel` of `table`.
    pub fn channel(&self, table: &mut Table) -> Result<(String, PrintedChannel)> {
        let name = table.string("channel")?;
        let found = PrintedChannel::named(&name).filter(|found| self.channels.contains(&found.channel));
        let Some(found) = found else {
            let message = format!("the mechanism has no channel \"{name}\"");
            return Err(table.wrong(ErrorKind::Input, "channel", message).help(self.help(&name)));
        };
        let stage = found.channel.kind.stage;
        if self.wanted.has(stage) {
            return Ok((name, found));
        }
        let message = format!("this channel is one of the {}, which `channels.want` leaves out", stage.name());
        let help = format!("add \"{}\" to `want`, or take the published numbers out", stage.name());
        Err(table.wrong(ErrorKind::Input, "channel", message).help(help))
    }

    fn help(&self, name: &str) -> String {
        if let Some(found) = PrintedChannel::named(name) {
            let subject = found.channel.kind.subject;
            let mut names: Vec<&str> =
                self.channels.iter().filter(|c| c.kind.subject == subject).map(|c| &*c.of).collect();
            names.dedup();
            return format!("of what moves, {}", suggestion(&found.channel.of, names, "\""));
        }
        let subject = name.split('.').next().unwrap_or_default();
        let kinds = CHANNELS.iter().filter(|kind| kind.subject.word() == subject);
        let endings: Vec<String> = kinds.flat_map(printed::endings).collect();
        match name.rsplit_once('.') {
            Some((of, ending)) if !endings.is_empty() => {
                format!("after `{of}.`, {}", suggestion(ending, endings.iter().map(String::as_str), "`"))
            }
            _ => "channels are named like \"point.A.x_mm\", \"link.crank.angle_deg\", \"link.crank.omega_rad_s\", \
                  \"joint.A.fx_N\" or \"drive.torque_N_m\""
                .into(),
        }
    }
}

/// Numbers at one crank angle, written in the scenario itself.
fn values(table: &mut Table, known: &Known) -> Result<Vec<OracleSeries>> {
    let crank = table.quantity("crank", &ANGLE, Sign::Any)?;
    let mut series = Vec::new();
    for mut entry in table.tables("values")? {
        let (name, channel) = known.channel(&mut entry)?;
        let si = |number: Printed| OraclePoint {
            crank,
            value: channel.to_si(number.value),
            bound: channel.to_si(number.half_unit()),
            digits: number.digits,
        };
        let printed = number(&mut entry)?;
        let correction = Correction::read(&mut entry, &printed)?;
        entry.finish()?;
        let point = si(printed);
        let (mut points, mut expected) = (Vec::new(), Vec::new());
        match correction {
            None => points.push(point),
            Some(Correction { finding, right }) => expected.push(ExpectedCell { point, right: si(right), finding }),
        }
        let PrintedChannel { channel, magnitude, .. } = channel;
        series.push(OracleSeries { name, channel, magnitude, points, expected, wrong: None });
    }
    if series.is_empty() {
        return Err(table.wrong(ErrorKind::Input, "values", "there is no value").help(VALUE_HELP));
    }
    Ok(series)
}

const VALUE_HELP: &str = "write `values = [{ channel = \"link.rocker.angle_deg\", value = 82, digits = 3 }]`";

/// `value` and `digits` of a number in the scenario itself. TOML does not keep the printed text.
pub(super) fn number(entry: &mut Table) -> Result<Printed> {
    let value = entry.number("value")?;
    let digits = digits(entry)?;
    Ok(Printed { value, digits })
}

/// Why a printed number is wrong, and the correct number, in the printed unit.
pub(super) struct Correction {
    pub finding: String,
    pub right: Printed,
}

impl Correction {
    /// Reads the keys `finding` and `right`, which belong together; `None` without them.
    pub fn read(entry: &mut Table, printed: &Printed) -> Result<Option<Self>> {
        let Some(finding) = finding(entry)? else { return Ok(None) };
        let mut table = entry.table("right")?;
        let right = number(&mut table)?;
        table.finish()?;
        check_apart(entry, printed, &right)?;
        Ok(Some(Correction { finding, right }))
    }
}

/// Reads the anchor under the key `finding`, which needs the key `right` beside it.
pub(super) fn finding(entry: &mut Table) -> Result<Option<String>> {
    let finding = entry.optional_string("finding")?;
    let help = "a number known to be wrong has a `finding`, which says why, and the number that is `right` instead: \
                `right = { value = 2.6, digits = 1 }`";
    match (finding, entry.has("right")) {
        (Some(finding), true) => Ok(Some(finding)),
        (None, false) => Ok(None),
        (Some(_), false) => Err(entry.fault("`finding` stands without `right`").help(help)),
        (None, true) => Err(entry.fault("`right` stands without `finding`").help(help)),
    }
}

/// Refuses a correct number so close to the printed one that one number could agree with both.
pub(super) fn check_apart(entry: &Table, printed: &Printed, right: &Printed) -> Result<()> {
    if (printed.value - right.value).abs() > printed.half_unit() + right.half_unit() {
        return Ok(());
    }
    let message = format!(
        "{} with {} decimals is not apart from the printed {} with {}",
        right.value, right.digits, printed.value, printed.digits
    );
    let help = "give the right number with more decimals, or take `finding` and `right` out if the printed one holds";
    Err(entry.wrong(ErrorKind::Input, "right", message).help(help))
}

/// The count of printed decimals under the key `digits`.
pub(super) fn digits(entry: &mut Table) -> Result<i32> {
    let digits = entry.integer("digits")?;
    match i32::try_from(digits) {
        Ok(digits) if digits.abs() <= MOST_DIGITS => Ok(digits),
        _ => Err(entry
            .wrong(
                ErrorKind::Input,
                "digits",
                format!("found {digits}, but no number is printed with as many decimals"),
            )
            .help(format!("give the count of printed decimals, from {} to {MOST_DIGITS}", -MOST_DIGITS))),
    }
}
