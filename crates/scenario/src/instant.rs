//! Where the numbers of an oracle hold: at a crank angle, or at a time.

use super::reader::Table;
use super::series::When;
use super::unit::{ANGLE, TIME, Unit};
use formula::Rounded;
use linkage::case::{Case, Grid};
use linkage::drive::Drive;
use linkage::error::Result;
use linkage::math::KeepNan;

/// Share of the last instant by which a time may lie beyond it: the rounding of a number in other units.
const ROUNDING: f64 = 1e-12;

const HELP: &str = "a number holds at a crank angle (of the nominal motion, where forces decide it) or at a time";

/// The instant of a table under `crank` or `time` with a unit.
pub fn read(table: &mut Table, case: &Case) -> Result<When> {
    let crank = table.optional_si("crank")?;
    let time = table.optional_si("time")?;
    match (crank, time) {
        (Some(crank), None) => Ok(When::Crank(crank)),
        (None, Some(time)) => {
            checked(case, end(case), time).or_else(|message| table.refuse("time", message, TIME_HELP))?;
            Ok(When::Time(time))
        }
        (Some(_), Some(_)) => {
            table.refuse("time", "a crank angle and a time are both given", format!("keep one of the two: {HELP}"))
        }
        (None, None) => Err(table.lacks(&["crank_deg", "crank_rad", "time_s", "time_ms"], HELP)),
    }
}

/// The column of a file that says where its rows hold.
pub struct Rows {
    /// Name of the column.
    pub column: String,
    /// The key that names it.
    pub key: &'static str,
    unit: &'static Unit,
    is_time: bool,
}

impl Rows {
    /// The column under `crank` or `time`, with its unit as ending.
    pub fn read(table: &mut Table) -> Result<Self> {
        let (crank, time) = (table.optional_string("crank")?, table.optional_string("time")?);
        let (key, column, is_time) = match (crank, time) {
            (Some(column), None) => ("crank", column, false),
            (None, Some(column)) => ("time", column, true),
            (Some(_), Some(_)) => {
                let message = "a column of crank angles and one of times are both named";
                return table.refuse("time", message, format!("keep one of the two: {HELP}"));
            }
            (None, None) => return Err(table.lacks(&["crank", "time"], COLUMN_HELP)),
        };
        let (units, help) = match is_time {
            false => (ANGLE.units, "the column of crank angles ends in `_deg` or `_rad`"),
            true => (TIME.units, "the column of times ends in `_s` or `_ms`"),
        };
        match units.iter().find(|unit| column.ends_with(&format!("_{}", unit.suffix))) {
            Some(unit) => Ok(Rows { column, key, unit, is_time }),
            None => table.refuse(key, format!("column \"{column}\" does not say its unit"), help),
        }
    }

    /// Whether the column is of crank angles in degrees.
    pub fn are_degrees(&self) -> bool {
        !self.is_time && self.unit.suffix == "deg"
    }

    /// The instant of a row, in a motion with this [`end`], and by how much it may be off (rad or s). A rounded time
    /// may lie a little beyond the motion.
    ///
    /// # Errors
    /// A message for a time that the motion does not have.
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

/// A time brought into the motion of a drive: from zero to the end of its law.
#[must_use]
pub fn within(drive: &Drive, time: f64) -> f64 {
    match drive.constant_speed() {
        Some(_) => time,
        None => time.larger(0.0).smaller(drive.end().unwrap_or(f64::INFINITY)),
    }
}

const COLUMN_HELP: &str =
    "name the column of crank angles (`crank = \"crank_deg\"`) or that of times (`time = \"t_s\"`)";

/// The way out for a time that the motion does not have.
pub const TIME_HELP: &str = "give a time within the run, or let the grid go further";

/// The last instant (s) of a motion that forces decide; `None` of another, or where another grid replaces its grid.
pub fn end(case: &Case) -> Option<f64> {
    let is_solved = case.is_free() && !case.grid.is_empty();
    is_solved.then(|| case.grid.ascending().last().map_or(0.0, |&row| case.grid.times[row]))
}

/// Whether the case's own motion is solved at this time (s): within its run, to `end`, and where its law is defined.
fn checked(case: &Case, end: Option<f64>, time: f64) -> std::result::Result<(), String> {
    Grid::of_times(case.crank(), vec![time]).check(case.crank())?;
    let Some(end) = end else { return Ok(()) };
    match (0.0..=end * (1.0 + ROUNDING)).contains(&time) {
        true => Ok(()),
        false => Err(format!("{time} s is not in the run, which goes from 0 to {end} s")),
    }
}
