//! `[[oracle]]`: published numbers that the mechanism must reproduce, each with the bound its printed digits give.

use super::figure::{self, OracleFigure};
use super::printed::{self, MOST_DIGITS, Printed, PrintedChannel};
use super::reader::{Sign, Table};
use super::table_file;
use super::unit::ANGLE;
use super::words::suggestion;
use linkage::case::{Case, Wanted};
use linkage::error::{ErrorKind, Result};
use linkage::trajectory::{CHANNELS, Channel};

/// Published numbers of one source.
#[derive(Clone, Debug, PartialEq)]
pub struct Oracle {
    /// The scenario's own name for it, else the file name of the table (`positions.csv`), or `inline 1`, `inline 2`, ... for
    /// numbers in the scenario itself.
    pub name: String,
    /// Where the numbers are published, and why they have an error of their own if they have.
    pub source: String,
    /// Values of channels at crank angles.
    pub series: Vec<OracleSeries>,
    /// Figures of the mechanism.
    pub figures: Vec<OracleFigure>,
}

/// Published values of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct OracleSeries {
    /// Column of the table, or the channel as the scenario names it.
    pub name: String,
    /// The channel.
    pub channel: Channel,
    /// Whether the value is the size of the vector whose x component the channel is.
    pub magnitude: bool,
    /// Values that must be reproduced, in the order of the table.
    pub points: Vec<OraclePoint>,
    /// Values known to be wrong: they must not be reproduced.
    pub expected: Vec<ExpectedCell>,
    /// Finding that says why the whole series is wrong; its values must not all be reproduced.
    pub finding: Option<String>,
}

/// One published value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OraclePoint {
    /// Crank angle (rad, as the scenario measures it).
    pub crank: f64,
    /// Value in the channel's SI unit.
    pub value: f64,
    /// Half a unit of the last printed digit, and the error that the numbers are known to have, in the channel's SI unit.
    pub bound: f64,
    /// Number of printed decimals, in the printed unit.
    pub digits: i32,
}

/// A published value that is known to be wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedCell {
    /// The value as published.
    pub point: OraclePoint,
    /// Anchor of the finding that says so, in `docs/findings.md`.
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
        let mut oracle = Oracle { name: String::new(), source, series: Vec::new(), figures: Vec::new() };
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
    /// Decimals that a table has, where zeros at the end are not printed.
    pub digits: Option<i32>,
    /// Error that the published numbers are known to have, in the printed unit.
    pub slack: f64,
}

impl Known<'_> {
    /// The same for a table with so many decimals, of which zeros at the end are not printed, and with such an error.
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
        let endings: Vec<&str> = kinds.flat_map(|kind| printed::endings(kind.suffix)).collect();
        match name.rsplit_once('.') {
            Some((of, ending)) if !endings.is_empty() => {
                format!("after `{of}.`, {}", suggestion(ending, endings, "`"))
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
        let printed = number(&mut entry)?;
        let finding = entry.optional_string("finding")?;
        entry.finish()?;
        let (value, bound) = (channel.to_si(printed.value), channel.to_si(printed.half_unit()));
        let point = OraclePoint { crank, value, bound, digits: printed.digits };
        let PrintedChannel { channel, magnitude, .. } = channel;
        series.push(OracleSeries { name, channel, magnitude, points: vec![point], expected: Vec::new(), finding });
    }
    if series.is_empty() {
        return Err(table.wrong(ErrorKind::Input, "values", "there is no value").help(VALUE_HELP));
    }
    Ok(series)
}

const VALUE_HELP: &str = "write `values = [{ channel = \"link.rocker.angle_deg\", value = 82, digits = 3 }]`";

/// `value` and `digits` of a number in the scenario itself, where TOML does not keep the printed text.
pub(super) fn number(entry: &mut Table) -> Result<Printed> {
    let value = entry.number("value")?;
    let digits = digits(entry)?;
    Ok(Printed { value, digits })
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
