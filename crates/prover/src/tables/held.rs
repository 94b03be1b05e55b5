//! Contents of a table about a mechanism: values of channels or expressions at instants.

use crate::sentences;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use super::Raw;
use columns::{MISSING, UNDEFINED, is_missing};
use formula::{FormulaFault, FormulaGraph, FormulaTree, NodeShape, Program, Rounded};
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::statistics::ascending;
use linkage::trajectory::{Channel, Trajectory};
use scenario::mapping::{INSTANTS, Mapped, Mapping};
use scenario::words::{choice, nearest};
use scenario::{Claim, PrintedChannel};
use std::ops::Range;

/// Instants of the rows of a party (a solver or a table of numbers): times, crank angles, or both.
#[derive(Clone, Debug, Default)]
pub struct Instants {
    /// Times (s).
    pub times: Option<Vec<Rounded>>,
    /// Values of the input: crank angles, for example (SI unit, as the scenario states them).
    pub cranks: Option<Vec<Rounded>>,
    /// What the input measures.
    pub input: Input,
}

/// Quantity by which rows are matched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// Times.
    Time,
    /// Values of the input, such as crank angles.
    Crank,
}

/// The instants by which rows are matched.
#[derive(Clone, Debug)]
pub struct RowKey {
    /// Times (s), or values of the input (rad or m).
    pub values: Vec<Rounded>,
    /// Whether the values are values of the input.
    pub is_crank: bool,
}

impl RowKey {
    /// Rows in ascending order of their instants.
    #[must_use]
    pub fn ascending(&self) -> Vec<usize> {
        ascending(&self.values.iter().map(|at| at.value).collect::<Vec<f64>>())
    }

    /// The first row (counted from 0) at which the instants turn back, against the direction of the table's first step.
    /// Returns the index of the reversing row, the instant of the row before it, and the instant of the reversing row.
    /// A time that jumps back marks the start of a new run.
    #[must_use]
    pub fn turns_back(&self) -> Option<(usize, [f64; 2])> {
        let step = |row: usize| self.values[row].value - self.values[row - 1].value;
        let way = (1..self.values.len()).map(step).find(|step| *step != 0.0)?;
        let row = (1..self.values.len()).find(|&row| step(row) * way < 0.0)?;
        Some((row, [self.values[row - 1].value, self.values[row].value]))
    }
}

/// Values of a party for a channel, or for an expression of channels.
#[derive(Clone, Debug)]
pub struct PartyColumn {
    /// The channel or expression, in its unit.
    pub claim: Claim,
    /// Values by row, in the unit of the claim. [`MISSING`] means that nothing was measured.
    /// Any NaN other than `MISSING` means that the calculation gave no number.
    pub values: Vec<Rounded>,
    /// Scale of the channel over a complete trajectory, in the unit of the claim.
    /// `None` if only the values of this column are known.
    pub scale: Option<f64>,
    /// The line of the mapping for this column; `None` if the table's own header names the channel.
    pub mapped: Option<Mapped>,
}

/// All data of a party.
#[derive(Clone, Debug, Default)]
pub struct Held {
    /// Instants of the party's rows.
    pub at: Instants,
    /// The party's values at these instants, one column for each channel or expression.
    pub columns: Vec<PartyColumn>,
    /// Whether the data comes from an analytic side. The error bounds of such data are known.
    pub is_analytic: bool,
    /// Columns of a table that are used neither for instants nor for channels.
    pub unused: Vec<String>,
    places: Places,
}

/// Indices of a party's columns, by the text of the column and by its channel. If several columns match, the first one
/// counts.
/// An expression is found only by its text. The magnitude of a vector counts as a separate channel.
/// The maps are needed for speed: every line of a mapping adds a column, and every column is looked up.
#[derive(Clone, Debug, Default)]
struct Places {
    texts: BTreeMap<String, usize>,
    channels: BTreeMap<(String, bool), usize>,
}

impl Places {
    fn of(columns: &[PartyColumn]) -> Self {
        let mut places = Places::default();
        for (index, column) in columns.iter().enumerate() {
            places.texts.entry(column.claim.text.clone()).or_insert(index);
            if let Some(own) = single(&column.claim) {
                places.channels.entry((own.channel.to_string(), own.magnitude)).or_insert(index);
            }
        }
        places
    }
}

/// Further column names that mean the time in seconds. Like the names in [`INSTANTS`], they need no mapping.
const TIMES: [&str; 2] = ["t_s", "t"];

impl Held {
    /// Columns of a party that is not analytic.
    #[must_use]
    pub fn of_columns(at: Instants, columns: Vec<PartyColumn>) -> Held {
        let places = Places::of(&columns);
        Held { at, columns, is_analytic: false, unused: Vec::new(), places }
    }

    /// The data of this party, marked as results of an analytic side.
    #[must_use]
    pub fn analytic(self) -> Held {
        Held { is_analytic: true, ..self }
    }

    /// Reads a table; `mapping` states which channels or instants its columns contain. A column with the name of a
    /// channel, unit included, needs no mapping.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for an unknown column or channel, with its location.
    /// [`ErrorKind::Input`] also if nothing states the instants of the rows or the meaning of a column.
    pub fn of_table(raw: &Raw, mapping: &Mapping) -> Result<Held> {
        let mut reader = Reader::of(raw);
        let mut at = Instants::default();
        let own: Vec<Mapped> = if mapping.at.is_empty() { instants_of(raw) } else { Vec::new() };
        for mapped in mapping.at.iter().chain(&own) {
            let (factor, input) =
                mapped.instant().ok_or_else(|| mapped.wrong(sentences::THIS_IS_NO_INSTANT, sentences::MAP_A_TIME))?;
            let printed = reader.column(mapped)?;
            let chosen = if mapped.name.ends_with("_deg") { columns::degrees_chosen } else { columns::chosen };
            let is_chosen = chosen(&printed);
            // Printed instants may be chosen values, such as 0, 0.1 and 0.2. Such instants are exact as printed: their
            // only error is the rounding error of the conversion to SI units.
            let exact = |own: Rounded| if is_chosen { Rounded::nearly(own.value) } else { own };
            let values: Vec<Rounded> = printed.into_iter().map(|own| exact(scaled(own, factor))).collect();
            if let Some(row) = values.iter().position(|own| !(own.value + own.error).is_finite()) {
                let message = sentences::holds_at_no_instant_is_no_number(&raw.place(row), &mapped.text);
                return Err(mapped.wrong(&message, sentences::TAKE_THE_ROW_OUT_OR_COMPLETE));
            }
            if let Some(input) = input {
                at.input = input;
            }
            *(if input.is_some() { &mut at.cranks } else { &mut at.times }) = Some(values);
        }
        if at.times.is_none() && at.cranks.is_none() {
            let message = sentences::nothing_says_where_the_rows(&some(&raw.names));
            let help = sentences::MAP_A_COLUMN_TO_TIME_TIME;
            return Err(Error::new(ErrorKind::Input, message).help(help));
        }
        let mapped: BTreeSet<&str> = mapping.channels.iter().map(|mapped| mapped.name.as_str()).collect();
        let is_own = |name: &&String| PrintedChannel::named(name).is_some() && !mapped.contains(name.as_str());
        let channels = raw.names.iter().filter(is_own);
        let own: Vec<Mapped> = channels.map(|name| Mapped::same(name, name)).collect();
        let mut column = |mapped: &Mapped| -> Result<PartyColumn> {
            let claim = claim_of(&mapped.name).map_err(|fault| mapped.wrong(&fault.message, &fault.help))?;
            Ok(PartyColumn { claim, values: reader.column(mapped)?, scale: None, mapped: None })
        };
        let given = mapping.channels.iter().map(|mapped| (mapped, Some(mapped.clone())));
        let all = given.chain(own.iter().map(|mapped| (mapped, None)));
        let of = |(own, mapped): (&Mapped, _)| Ok(PartyColumn { mapped, ..column(own)? });
        let columns: Vec<PartyColumn> = all.map(of).collect::<Result<_>>()?;
        if columns.is_empty() {
            let message = sentences::no_column_of_the_table_is_a_channel(&some(&raw.names));
            let help = sentences::MAP_COLUMNS_TO_CHANNELS_SUCH_AS_PHI3;
            return Err(Error::new(ErrorKind::Input, message).help(help));
        }
        let unused = raw.names.iter().filter(|name| !reader.used.contains(name.as_str())).cloned().collect();
        Ok(Held { unused, ..Held::of_columns(at, columns) })
    }

    /// The data of a trajectory that does not come from an analytic side.
    #[must_use]
    pub fn of_trajectory(trajectory: &Trajectory) -> Held {
        let exact = |values: &[f64]| -> Vec<Rounded> { values.iter().map(|&value| Rounded::nearly(value)).collect() };
        let times = Some(trajectory.times().iter().map(|&time| Rounded::exact(time)).collect());
        let cranks = Some(exact(trajectory.inputs()));
        let column = |(channel, values): (&Channel, &[f64])| {
            let name = channel.to_string();
            let claim = Claim::of_channels(&name, std::slice::from_ref(channel)).ok()?;
            Some(PartyColumn { claim, values: exact(values), scale: None, mapped: None })
        };
        let columns = trajectory.iter().filter_map(column).collect();
        Held::of_columns(Instants { times, cranks, input: trajectory.input() }, columns)
    }

    /// The instants of the party's rows, as crank angles or times.
    /// If `by` is `None`, times are preferred.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if the requested instants are missing.
    pub fn at(&self, by: Option<By>) -> Result<RowKey> {
        let Instants { times, cranks, .. } = &self.at;
        let is_crank = by.map_or(times.is_none(), |by| by == By::Crank);
        let found = if is_crank { cranks } else { times };
        let [lacks, has] = if is_crank { ["crank angles", "times"] } else { ["times", "crank angles"] };
        let values = found.clone().ok_or_else(|| {
            Error::new(ErrorKind::Input, sentences::the_rows_of_a_table_have_and_no(&has, &lacks))
                .help(sentences::compare_by_or_map_a_column(&has, &lacks))
        })?;
        Ok(RowKey { values, is_crank })
    }

    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.at.times.as_ref().or(self.at.cranks.as_ref()).map_or(0, Vec::len)
    }

    /// Whether the party has no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether the party has numbers for a claim.
    #[must_use]
    pub fn holds(&self, claim: &Claim) -> bool {
        self.column_of(claim).is_some()
    }

    /// The party's numbers for a claim, in the claim's unit.
    /// The numbers come from a column with the same text, or with the same channel in another unit.
    #[must_use]
    pub fn values_of(&self, claim: &Claim) -> Option<Cow<'_, [Rounded]>> {
        match self.column_of(claim)? {
            (column, 1.0) => Some(Cow::Borrowed(&column.values)),
            (column, factor) => Some(column.values.iter().map(|&value| scaled(value, factor)).collect()),
        }
    }

    /// The scale of a claim, in the claim's unit. `None` if no complete trajectory gives the scale.
    #[must_use]
    pub fn scale_of(&self, claim: &Claim) -> Option<f64> {
        let (column, factor) = self.column_of(claim)?;
        Some(column.scale? * factor)
    }

    /// The column of a claim, and the ratio of the column's unit to the claim's unit.
    fn column_of(&self, claim: &Claim) -> Option<(&PartyColumn, f64)> {
        if let Some(&index) = self.places.texts.get(&claim.text) {
            return Some((&self.columns[index], 1.0));
        }
        let wanted = single(claim)?;
        let column = &self.columns[*self.places.channels.get(&(wanted.channel.to_string(), wanted.magnitude))?];
        let unit = single(&column.claim)?.to_si(1.0);
        Some((column, unit / wanted.to_si(1.0)))
    }
}

/// The channel of a claim that is not an expression of channels.
fn single(claim: &Claim) -> Option<&PrintedChannel> {
    matches!(claim.tree.shape, NodeShape::Name(_)).then(|| &claim.channels[0].1)
}

/// The columns whose names identify them as instants. An exact name has priority over a name in words, such as `Time
/// [s]`.
fn instants_of(raw: &Raw) -> Vec<Mapped> {
    let seconds = TIMES.into_iter().find(|name| raw.names.iter().any(|own| own == name));
    let named = INSTANTS.iter().map(|(name, ..)| *name).filter(|name| raw.names.iter().any(|own| own == name));
    let mut all: Vec<Mapped> =
        named.map(|name| Mapped::same(name, name)).chain(seconds.map(|name| Mapped::same("time_s", name))).collect();
    for name in &raw.names {
        let Some(mapped) = in_words(name).map(|instant| Mapped::same(instant, name)) else { continue };
        let is_crank = |of: &Mapped| of.instant().is_some_and(|(_, input)| input.is_some());
        if !all.iter().any(|own| is_crank(own) == is_crank(&mapped)) {
            all.push(mapped);
        }
    }
    all
}

/// The entry of [`INSTANTS`] that a descriptive column name means: `Time`, `t [s]`, `time (ms)`, `Crank [deg]`.
fn in_words(name: &str) -> Option<&'static str> {
    let bracketed = ["[]", "()"].iter().find_map(|pair| {
        let (open, close) = pair.split_at(1);
        name.trim_end().strip_suffix(close)?.rsplit_once(open)
    });
    let (word, unit) = bracketed.map_or((name.trim(), None), |(word, unit)| (word.trim(), Some(unit.trim())));
    let is = |one: &str| word.eq_ignore_ascii_case(one);
    match unit {
        None | Some("s") if is("time") => Some("time_s"),
        Some("s") if word == "t" => Some("time_s"),
        Some("ms") if word == "t" || is("time") => Some("time_ms"),
        Some("deg") if is("crank") || is("crank angle") => Some("crank_deg"),
        Some("rad") if is("crank") || is("crank angle") => Some("crank_rad"),
        None | Some(_) => None,
    }
}

/// The claim that a text states. The claim may use the channels of any mechanism.
///
/// # Errors
/// If the text cannot be parsed, or a name is not a channel.
fn claim_of(text: &str) -> std::result::Result<Claim, FormulaFault> {
    let known = |name: &str| PrintedChannel::named(name).map(|own| own.channel);
    let all: Vec<Channel> = match known(text) {
        Some(channel) => vec![channel],
        None => FormulaTree::parse(text)?.names().iter().filter_map(|(name, _)| known(name)).collect(),
    };
    Claim::of_channels(text, &all)
}

fn scaled(number: Rounded, factor: f64) -> Rounded {
    match factor {
        1.0 => number,
        _ => Rounded::pair(formula::Operator::Times, number, Rounded::nearly(factor)),
    }
}

/// Names of the first columns.
fn some(names: &[String]) -> String {
    let shown = names.iter().take(NAMED).map(String::as_str);
    match names.len().saturating_sub(NAMED) {
        0 => choice(shown, "`"),
        more => sentences::and_more(&(shown.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")), &more),
    }
}

/// A message names at most this number of columns. The remaining columns are only counted.
const NAMED: usize = 8;

/// Evaluates expressions over the columns of a table.
struct Reader<'a> {
    raw: &'a Raw,
    graph: FormulaGraph,
    /// Index of the first column with each name.
    places: BTreeMap<&'a str, usize>,
    used: BTreeSet<&'a str>,
    /// The numbers of one row, for the columns used in an expression.
    inputs: Vec<Rounded>,
}

impl<'a> Reader<'a> {
    fn of(raw: &'a Raw) -> Self {
        let names: Vec<&str> = raw.names.iter().map(String::as_str).collect();
        let places = names.iter().enumerate().rev().map(|(index, name)| (*name, index)).collect();
        let inputs = vec![Rounded::exact(0.0); raw.columns.len()];
        Reader { raw, graph: FormulaGraph::new(&names, 0), places, used: BTreeSet::new(), inputs }
    }

    fn column(&mut self, mapped: &Mapped) -> Result<Vec<Rounded>> {
        let (text, names) = (mapped.text.as_str(), &self.raw.names);
        let is_whole = self.places.contains_key(text);
        let tree = match is_whole {
            true => Ok(FormulaTree { shape: NodeShape::Name(text.into()), at: 0..text.len() }),
            false => FormulaTree::parse(text),
        };
        let tree = tree.map_err(|fault| mapped.refused(&fault))?;
        let named = tree.names();
        let column = |name: &str| self.places.get(name).copied();
        if let Some((name, at)) = named.iter().find(|(name, _)| !self.graph.knows(name)) {
            return Err(mapped.refused(&self.unknown(name, at.clone())));
        }
        let node = self.graph.add_defined(&tree).map_err(|fault| mapped.refused(&fault))?;
        let used: Vec<usize> = named.iter().filter_map(|(name, _)| column(name)).collect();
        self.used.extend(used.iter().map(|&column| names[column].as_str()));
        if is_whole && let [index] = used[..] {
            return Ok(self.raw.columns[index].clone());
        }
        let mut program = Program::of(&self.graph, &[node]);
        let inputs = &mut self.inputs;
        let mut row = |row: usize| {
            for &index in &used {
                inputs[index] = self.raw.columns[index][row];
            }
            // If a measurement is missing, the result of the expression is missing too. If measured values give no
            // number, the expression in the mapping is wrong.
            if used.iter().any(|&index| is_missing(&inputs[index])) {
                return Ok(MISSING);
            }
            let found = program.run(inputs)[0];
            if found.is_undefined() && used.iter().all(|&index| !inputs[index].is_undefined()) {
                let of = |name: &str| column(name).map_or(Rounded::nearly(std::f64::consts::PI), |own| inputs[own]);
                if let Err(fault) = tree.evaluated(&of) {
                    let help = sentences::else_leave_the_row_out_or_its_cell(&fault.help);
                    let message = format!("in {} {}", self.raw.place(row), fault.message);
                    return Err(mapped.refused(&FormulaFault { message, help, ..fault }));
                }
            }
            Ok(if found.value.is_finite() { found } else { UNDEFINED })
        };
        (0..self.raw.len()).map(&mut row).collect()
    }

    /// The error for an unknown name. The help of the error names the most similar column or, if no column is similar,
    /// the first columns.
    fn unknown(&self, name: &str, at: Range<usize>) -> FormulaFault {
        let message = sentences::the_table_has_no_column(&name);
        let help = match nearest(name, self.raw.names.iter().map(String::as_str)) {
            Some(near) => sentences::did_you_mean(&near),
            None => sentences::its_columns_are_backquotes_hold(&some(&self.raw.names)),
        };
        FormulaFault { message, at, help }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// If two columns have the same text, the first one counts.
    /// A channel is also found in a column that has another unit. The magnitude of a vector counts as a separate
    /// channel.
    #[test]
    fn a_claim_is_found_by_its_text_or_by_its_channel() {
        let names = ["point.B.x_mm", "2*point.B.x_m", "point.B.x_mm", "point.B.x_m", "joint.A.f_N", "joint.B.fx_N"];
        let column = |(index, text): (usize, &&str)| {
            let values = vec![Rounded::exact(1.0 + index as f64)];
            PartyColumn { claim: claim_of(text).unwrap(), values, scale: None, mapped: None }
        };
        let held = Held::of_columns(Instants::default(), names.iter().enumerate().map(column).collect());
        let value = |text: &str| held.values_of(&claim_of(text).unwrap()).map(|values| values[0].value);
        for (text, expected) in [
            ("point.B.x_mm", Some(1.0)),
            ("2*point.B.x_m", Some(2.0)),
            ("point.B.x_m", Some(4.0)),
            ("joint.A.f_N", Some(5.0)),
            ("joint.A.fx_N", None),
            ("joint.B.f_N", None),
            ("3*point.B.x_m", None),
        ] {
            let same = |found: f64| expected.is_some_and(|own| (found - own).abs() < 1e-15);
            assert!(value(text).map_or(expected.is_none(), same), "{text}: {:?}", value(text));
            assert_eq!(held.holds(&claim_of(text).unwrap()), expected.is_some(), "{text}");
        }
    }
}
