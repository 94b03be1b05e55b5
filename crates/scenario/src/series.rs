//! Values of one channel that an oracle has, and which channels it may name.

use std::fmt;

use super::printed::{self, PrintedChannel};
use super::reader::Table;
use super::words::suggestion;
use linkage::error::Result;
use linkage::input::Input;
use linkage::trajectory::{CHANNELS, Channel};

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
    /// Where the value holds.
    pub at: When,
    /// By how much the instant may be off, because a table has rounded it (rad or s); 0 of one that was chosen.
    pub at_error: f64,
    /// Value in the channel's SI unit.
    pub value: f64,
    /// Half a unit of the last digit of the column, plus the known error of the numbers, in the channel's SI unit.
    pub bound: f64,
    /// Number of printed decimals, in the printed unit.
    pub digits: i32,
}

/// Where a value holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// At a crank angle (rad, as the scenario measures it). Where forces decide the motion, of the nominal motion.
    Crank(f64),
    /// At a time (s) of the scenario's own motion.
    Time(f64),
}

impl When {
    /// The crank angle (rad) of a value at one.
    #[must_use]
    pub fn crank(self) -> Option<f64> {
        match self {
            When::Crank(crank) => Some(crank),
            When::Time(_) => None,
        }
    }

    /// The time (s) of a value at one.
    #[must_use]
    pub fn time(self) -> Option<f64> {
        match self {
            When::Crank(_) => None,
            When::Time(time) => Some(time),
        }
    }
}

impl fmt::Display for When {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            When::Crank(crank) => write!(f, "{:.3}", Input::Angle.at(*crank)),
            When::Time(time) => write!(f, "{time} s"),
        }
    }
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

/// The channels an oracle may name.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    pub channels: &'a [Channel],
    pub wanted: &'a [Channel],
    /// Number of decimals in a table that does not print zeros at the end.
    pub digits: Option<i32>,
    /// Known error of the published numbers, in the printed unit.
    pub slack: f64,
    /// Memory that the numbers of tables may take (bytes).
    pub memory: Option<f64>,
}

impl OracleSeries {
    /// The y component of a series of magnitudes.
    #[must_use]
    pub fn y(&self) -> Option<Channel> {
        let named = || Channel::named(&format!("joint.{}.fy_N", self.channel.of)).expect("joints have this channel");
        self.magnitude.then(named)
    }

    /// All its values as printed, those known to be wrong included.
    pub fn all(&self) -> impl Iterator<Item = &OraclePoint> {
        let wrong = self.wrong.iter().flat_map(|(_, cells)| cells);
        let cells = self.expected.iter().chain(wrong).map(|cell| &cell.point);
        self.points.iter().chain(cells)
    }

    /// Where they hold.
    pub fn instants(&self) -> impl Iterator<Item = When> {
        self.all().map(|point| point.at)
    }
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
            return table.refuse("channel", format!("the mechanism has no channel \"{name}\""), self.help(&name));
        };
        let stage = found.channel.kind.stage;
        if self.wanted.contains(&found.channel) {
            return Ok((name, found));
        }
        let message = format!("this channel is one of the {}, which `channels.want` leaves out", stage.name());
        let help = format!("add \"{}\" to `want`, or take the published numbers out", stage.name());
        table.refuse("channel", message, help)
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
