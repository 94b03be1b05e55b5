//! Values of one channel from an oracle, and the channels that an oracle may name.
//! Every value is valid at an input of the first drive (crank angle or slide) or at a time.

use crate::sentences;

use super::printed::{self, PrintedChannel};
use super::reader::{Sign, TomlTable};
use super::unit::{NamedUnit, TIME, of_input};
use super::words::suggestion;
use formula::Rounded;
use linkage::case::{Case, Grid, When};
use linkage::drive::Drive;
use linkage::error::Result;
use linkage::math::KeepNan;
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
    /// Values known to be wrong, each with a separate finding.
    pub expected: Vec<ExpectedCell>,
    /// For a column in which every value is wrong: the finding that explains the error, and all values.
    /// The lists `points` and `expected` are empty for such a column.
    pub wrong: Option<(String, Vec<ExpectedCell>)>,
}

/// One published value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OraclePoint {
    /// The instant of the value.
    pub at: When,
    /// Largest rounding error of the instant (rad, m or s), if a table prints the instant.
    /// The rounding error is 0 for numbers in the scenario itself.
    pub at_error: f64,
    /// Value in the channel's SI unit.
    pub value: f64,
    /// Half a unit of the last digit of the column, plus the known error of the numbers, in the channel's SI unit.
    pub bound: f64,
    /// Number of printed decimals, in the printed unit.
    pub digits: i32,
}

/// A printed value that is known to be wrong. The mechanism must reproduce the correct value, not the printed one.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedCell {
    /// The value as printed.
    pub point: OraclePoint,
    /// The correct value.
    pub right: OraclePoint,
    /// Anchor of the finding that explains the error, in `docs/findings.md`.
    pub finding: String,
}

/// The channels that an oracle may name.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    pub channels: &'a [Channel],
    pub wanted: &'a [Channel],
    /// Number of decimals in a table that does not print trailing zeros.
    pub digits: Option<i32>,
    /// Known error of the published numbers, in the printed unit.
    pub slack: f64,
    /// Upper limit of the memory for the numbers of tables (bytes).
    pub memory: Option<f64>,
}

impl OracleSeries {
    /// The channel of the vector's y component, if the values of the series are magnitudes of a vector.
    #[must_use]
    pub fn y(&self) -> Option<Channel> {
        let named = || Channel::named(&format!("joint.{}.fy_N", self.channel.of)).expect("joints have this channel");
        self.magnitude.then(named)
    }

    /// All values of the series as printed, including the wrong values.
    pub fn all(&self) -> impl Iterator<Item = &OraclePoint> {
        let wrong = self.wrong.iter().flat_map(|(_, cells)| cells);
        let cells = self.expected.iter().chain(wrong).map(|cell| &cell.point);
        self.points.iter().chain(cells)
    }

    /// The instants of the values.
    pub fn instants(&self) -> impl Iterator<Item = When> {
        self.all().map(|point| point.at)
    }
}

impl Known<'_> {
    /// The channels that an oracle may name, for a table whose published numbers have the known error `slack`.
    /// `digits` is the number of decimals of a table that does not print trailing zeros; `None` for other tables.
    pub fn of_table(self, digits: Option<i32>, slack: f64) -> Self {
        Known { digits, slack, ..self }
    }

    /// The channel under the key `channel` of `table`.
    pub fn channel(&self, table: &mut TomlTable) -> Result<(String, PrintedChannel)> {
        let name = table.string("channel")?;
        let found = PrintedChannel::named(&name).filter(|found| self.channels.contains(&found.channel));
        let Some(found) = found else {
            return table.refuse("channel", sentences::the_mechanism_has_no_channel(&name), self.help(&name));
        };
        let stage = found.channel.kind.stage;
        if self.wanted.contains(&found.channel) {
            return Ok((name, found));
        }
        let help = sentences::add_to_want_or_take_the_published(&stage.name());
        table.refuse("channel", sentences::this_channel_is_one_of_the_which_channels(&stage.name()), help)
    }

    fn help(&self, name: &str) -> String {
        if let Some(found) = PrintedChannel::named(name) {
            let subject = found.channel.kind.subject;
            let mut names: Vec<&str> =
                self.channels.iter().filter(|c| c.kind.subject == subject).map(|c| &*c.of).collect();
            names.dedup();
            return sentences::of_what_moves(&(suggestion(&found.channel.of, names, "\"")));
        }
        let subject = name.split('.').next().unwrap_or_default();
        let kinds = CHANNELS.iter().filter(|kind| kind.subject.word() == subject);
        let endings: Vec<String> = kinds.flat_map(printed::endings).collect();
        match name.rsplit_once('.') {
            Some((of, ending)) if !endings.is_empty() => {
                format!("after `{of}.`, {}", suggestion(ending, endings.iter().map(String::as_str), "`"))
            }
            _ => sentences::CHANNELS_ARE_NAMED_LIKE_POINT.into(),
        }
    }
}

/// Relative margin by which a time may exceed the last instant. The margin covers the rounding of unit conversions.
const ROUNDING: f64 = 1e-12;

const HELP: &str = sentences::A_NUMBER_HOLDS_AT_A_CRANK;

/// Reads an instant under `crank` or `time`, with a unit.
pub(super) fn instant(table: &mut TomlTable, case: &Case) -> Result<When> {
    let family = of_input(case.crank().input);
    let crank = table.optional_quantity("crank", family, Sign::Any)?;
    let time = table.optional_si("time")?;
    match (crank, time) {
        (Some(crank), None) => Ok(When::Crank(crank)),
        (None, Some(time)) => {
            checked(case, end(case), time).or_else(|message| table.refuse("time", message, TIME_HELP))?;
            Ok(When::Time(time))
        }
        (Some(_), Some(_)) => {
            table.refuse("time", sentences::A_CRANK_ANGLE_AND_A_TIME, sentences::keep_one_of_the_two_2(&HELP))
        }
        (None, None) => {
            let keys: Vec<String> =
                family.keys("crank").into_iter().rev().chain(["time_s".into(), "time_ms".into()]).collect();
            Err(table.lacks(&keys.iter().map(String::as_str).collect::<Vec<_>>(), HELP))
        }
    }
}

/// The column of a file that states the instants of the rows.
pub(super) struct Rows {
    /// Name of the column.
    pub column: String,
    /// The scenario's key that names the column.
    pub key: &'static str,
    unit: &'static NamedUnit,
    is_time: bool,
}

impl Rows {
    /// Reads the column that `crank` or `time` names. The column's name ends in its unit.
    pub fn read(table: &mut TomlTable, case: &Case) -> Result<Self> {
        let (crank, time) = (table.optional_string("crank")?, table.optional_string("time")?);
        let (key, column, is_time) = match (crank, time) {
            (Some(column), None) => ("crank", column, false),
            (None, Some(column)) => ("time", column, true),
            (Some(_), Some(_)) => {
                let message = sentences::A_COLUMN_OF_CRANK_ANGLES;
                return table.refuse("time", message, sentences::keep_one_of_the_two_2(&HELP));
            }
            (None, None) => return Err(table.lacks(&["crank", "time"], COLUMN_HELP)),
        };
        let (units, help) = match is_time {
            false => (of_input(case.crank().input).units, sentences::THE_COLUMN_OF_CRANK_ANGLES),
            true => (TIME.units, sentences::THE_COLUMN_OF_TIMES_ENDS),
        };
        match units.iter().find(|unit| column.ends_with(&format!("_{}", unit.suffix))) {
            Some(unit) => Ok(Rows { column, key, unit, is_time }),
            None => table.refuse(key, sentences::column_does_not_say_its_unit(&column), help),
        }
    }

    /// Whether the column contains crank angles in degrees.
    pub fn are_degrees(&self) -> bool {
        !self.is_time && self.unit.suffix == "deg"
    }

    /// Instant of a row, and the largest rounding error of this instant (rad, m or s). The motion ends at [`end`].
    /// If a rounded time lies slightly beyond the motion, it is moved to the end of the motion.
    ///
    /// # Errors
    /// A message for a time outside the motion.
    pub fn instant(&self, case: &Case, end: Option<f64>, printed: Rounded) -> std::result::Result<(When, f64), String> {
        let [value, error] = [printed.value, printed.error].map(|number| self.unit.to_si(number));
        if !self.is_time {
            return Ok((When::Crank(value), error));
        }
        let within = within(case.crank(), value).smaller(end.unwrap_or(f64::INFINITY));
        let value = if (within - value).abs() <= error { within } else { value };
        checked(case, end, value).map(|()| (When::Time(value), error))
    }
}

/// Limits a time to the motion of a drive: from zero to the end of its law. A constant speed does not limit the time.
#[must_use]
pub fn within(drive: &Drive, time: f64) -> f64 {
    match drive.constant_speed() {
        Some(_) => time,
        None => time.larger(0.0).smaller(drive.end().unwrap_or(f64::INFINITY)),
    }
}

const COLUMN_HELP: &str = sentences::NAME_THE_COLUMN_OF_CRANK;

/// The help for a time outside the motion.
pub(super) const TIME_HELP: &str = sentences::GIVE_A_TIME_WITHIN_THE_RUN;

/// The last instant (s) of a motion that forces determine.
/// `None` if a law prescribes the motion, or if the case has no grid because the caller replaces the grid of the file.
pub(super) fn end(case: &Case) -> Option<f64> {
    let is_solved = case.is_free() && !case.grid.is_empty();
    is_solved.then(|| case.grid.ascending().last().map_or(0.0, |&row| case.grid.times[row]))
}

/// Checks that the motion of the case is solved at the time `time` (s).
/// The time must be within the run up to `end`, and the law of motion must be defined at this time.
fn checked(case: &Case, end: Option<f64>, time: f64) -> std::result::Result<(), String> {
    Grid::of_times(case.crank(), vec![time]).check(&case.drives)?;
    let Some(end) = end else { return Ok(()) };
    match (0.0..=end * (1.0 + ROUNDING)).contains(&time) {
        true => Ok(()),
        false => Err(sentences::is_not_in_the_run_which_goes(&time, &end)),
    }
}
