//! Compares two parties: scenarios, recordings, or tables of other programs.
//!
//! One party is evaluated at the instants of the other.
//! A scenario is solved at these instants. A table has values at these instants or is interpolated.
//! Each channel is then compared within the known errors of both parties plus the allowed tolerance.

mod align;
mod allowed;
mod analytic_party;
mod cause;
mod judge;
mod pair;
mod scale;

use crate::sentences;
pub use allowed::ComparisonRule;
pub use cause::Explained;
pub use judge::{Compared, RowPair};
pub use pair::{Contradiction, SidePair};

use self::judge::Which;
use self::pair::Side;
use self::scale::Scales;
use crate::bounds::{Verdict, overall};
use crate::tables::{Held, May, load_within};
use linkage::error::{Error, ErrorKind, Result};
use linkage::trajectory::Trajectory;
use scenario::Scenario;
use scenario::mapping::Mapping;
use scenario::words::choice;
use std::path::Path;

/// One of the two parties of a comparison.
pub struct ComparedParty {
    name: String,
    holds: Holds,
}

enum Holds {
    /// A scenario, which is solved.
    Scenario(Box<Scenario>),
    /// Trajectories by the names of their sides.
    Recording(Vec<(String, Trajectory)>),
    Table(Box<Held>),
}

impl ComparedParty {
    /// A recording: trajectories by the names of their sides. The side `reference` is analytic. `name` is the party's
    /// name in messages.
    pub fn recording(name: impl Into<String>, sides: Vec<(String, Trajectory)>) -> ComparedParty {
        ComparedParty { name: name.into(), holds: Holds::Recording(sides) }
    }

    /// A CSV or Parquet file, and the mapping of its columns to channels.
    /// If a column's name is the name of a channel with its unit, the mapping needs no line for this column.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] if the file cannot be read.
    /// [`ErrorKind::Input`], with the location, if the file is not a table of numbers or the mapping does not fit it.
    pub fn table(path: impl AsRef<Path>, mapping: &Mapping) -> Result<ComparedParty> {
        ComparedParty::table_within(path, mapping, &|_, _| Ok(()))
    }

    /// Does the same as [`ComparedParty::table`], but asks `may` before each allocation whether it is permitted.
    ///
    /// # Errors
    /// The errors of [`ComparedParty::table`] and the errors of `may`.
    pub fn table_within(path: impl AsRef<Path>, mapping: &Mapping, may: May) -> Result<ComparedParty> {
        let path = path.as_ref();
        let held = Held::of_table(&load_within(path, may)?, mapping)?;
        Ok(ComparedParty { name: path.display().to_string(), holds: Holds::Table(Box::new(held)) })
    }
}

/// A scenario as a party. The scenario is solved at the instants of the other party.
impl From<Scenario> for ComparedParty {
    fn from(scenario: Scenario) -> ComparedParty {
        ComparedParty { name: scenario.path.display().to_string(), holds: Holds::Scenario(Box::new(scenario)) }
    }
}

/// The result of another program or an engine: numbers with unknown errors.
impl From<Trajectory> for ComparedParty {
    fn from(trajectory: Trajectory) -> ComparedParty {
        ComparedParty::recording("the trajectory", vec![(String::new(), trajectory)])
    }
}

/// The data read from a table.
impl From<Held> for ComparedParty {
    fn from(held: Held) -> ComparedParty {
        ComparedParty { name: "the table".into(), holds: Holds::Table(Box::new(held)) }
    }
}

/// Two parties compared.
pub struct PartyComparison {
    /// The compared pairs of sides, in order. A recording may have several sides.
    pub pairs: Vec<SidePair>,
    /// The verdict on all pairs.
    pub verdict: Verdict,
}

/// Name of the analytic side in a recording.
const REFERENCE: &str = "reference";

/// Compares two parties channel by channel, within the known errors of both plus the allowed tolerance.
///
/// # Errors
/// [`ErrorKind::Input`] if the parties have no instant or no channel in common, or if `how` names a side or channel
/// that does not exist.
/// The errors that occur while an analytic side is solved.
pub fn compare(parties: [ComparedParty; 2], how: &ComparisonRule) -> Result<PartyComparison> {
    let names = parties.each_ref().map(|party| party.name.clone());
    let [first, second] = parties.map(|party| party.holds);
    let beside = |scenario: &Scenario, which: Which, other: Holds| -> Result<Vec<SidePair>> {
        sides(other, how)?.into_iter().map(|side| analytic_party::beside(scenario, which, side, how)).collect()
    };
    let pairs = match (first, second) {
        (Holds::Scenario(one), other) => beside(&one, Which::First, other)?,
        (one, Holds::Scenario(other)) => beside(&other, Which::Second, one)?,
        (one, other) => {
            let (ones, others) = (sides(one, how)?, sides(other, how)?);
            let pairs = paired(&ones, &others, &names)?;
            pairs.into_iter().map(|[one, other]| align::beside(one, other, how)).collect::<Result<_>>()?
        }
    };
    how.check_used(pairs.iter().flat_map(|pair| &pair.channels).map(|own| &own.claim))?;
    let verdicts: Vec<Verdict> = pairs.iter().map(SidePair::verdict).collect();
    Ok(PartyComparison { verdict: overall(&verdicts), pairs })
}

/// The requested sides of a party.
fn sides(party: Holds, how: &ComparisonRule) -> Result<Vec<Side>> {
    let alone = |held: Held| vec![Side { name: String::new(), held }];
    match party {
        Holds::Scenario(scenario) => Ok(alone(analytic_party::held(&scenario)?)),
        Holds::Table(held) => Ok(alone(*held)),
        Holds::Recording(all) => asked(all, how),
    }
}

/// The requested sides of a recording.
fn asked(all: Vec<(String, Trajectory)>, how: &ComparisonRule) -> Result<Vec<Side>> {
    let names: Vec<String> = all.iter().map(|(name, _)| name.clone()).collect();
    let is_asked = |name: &str| how.side.as_deref().is_none_or(|side| side == name);
    let held = |(name, own): (String, Trajectory)| {
        let mut held = Held::of_trajectory(&own);
        held.is_analytic = name == REFERENCE;
        let scales = Scales::of_trajectory(&own);
        held.columns.iter_mut().for_each(|column| column.scale = scales.of_claim(&column.claim));
        if held.is_analytic {
            for column in &mut held.columns {
                let known = scales.known(&column.claim.channels[0].1.channel);
                column.values.iter_mut().for_each(|value| value.error += known);
            }
        }
        Side { name, held }
    };
    let asked: Vec<Side> = all.into_iter().filter(|(name, _)| is_asked(name)).map(held).collect();
    match (&how.side, asked.is_empty()) {
        (Some(side), true) => Err(Error::new(ErrorKind::Input, sentences::a_recording_has_no_side(&side))
            .help(sentences::it_has(&choice(names.iter().map(String::as_str), "")))),
        _ => Ok(asked),
    }
}

/// Pairs the sides of two parties.
/// A single side is paired with each side of the other party. If both parties have several sides, sides of the same
/// name are paired.
fn paired<'a>(ones: &'a [Side], others: &'a [Side], names: &[String; 2]) -> Result<Vec<[&'a Side; 2]>> {
    let pairs: Vec<[&Side; 2]> = match (ones, others) {
        ([one], others) => others.iter().map(|other| [one, other]).collect(),
        (ones, [other]) => ones.iter().map(|one| [one, other]).collect(),
        (ones, others) => {
            let same = |one: &'a Side| Some([one, others.iter().find(|other| other.name == one.name)?]);
            ones.iter().filter_map(same).collect()
        }
    };
    if pairs.is_empty() {
        let message = sentences::and_have_no_side_of_the_same(&names[0], &names[1]);
        return Err(Error::new(ErrorKind::Input, message).help(sentences::NAME_A_SIDE_THAT_BOTH_HAVE_SUCH_AS_REFERENCE));
    }
    Ok(pairs)
}
