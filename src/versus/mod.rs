//! Two parties side by side: scenarios, recordings, tables of other programs.
//!
//! One of the two is brought to the instants of the other: a scenario is solved there, a table has them or is
//! interpolated. Then channel by channel is compared, within what is known of both and what is allowed besides.

mod align;
mod allowed;
mod analytic_party;
mod cause;
mod judge;

pub use allowed::How;
pub use cause::Explained;
pub use judge::{Compared, Instant};

use std::path::Path;

use crate::compare::{Check, Verdict, overall};
use crate::scenario::Scenario;
use crate::tables::Held;
use linkage::error::{Error, ErrorKind, Result};
use linkage::trajectory::Trajectory;

/// One of the two that are compared.
pub enum Party {
    /// A scenario, which is solved.
    Scenario(Box<Scenario>),
    /// What a recording holds: trajectories by the names of their sides.
    Recording(Vec<(String, Trajectory)>),
    /// A table.
    Table(Box<Held>),
}

/// Two parties compared.
pub struct Comparison {
    /// One after the other: a recording may have several sides.
    pub pairs: Vec<Pair>,
    /// The verdict on all of them.
    pub verdict: Verdict,
}

/// Two sides compared.
pub struct Pair {
    /// What they are called in the recordings; empty for others.
    pub names: [String; 2],
    /// Channel by channel, in the order of the second party.
    pub channels: Vec<Compared>,
    /// Checks of the analytic sides on each other, where a scenario was solved.
    pub checks: Vec<Check>,
    /// Number of instants of the party that gives them.
    pub instants: usize,
    /// Number of those that the other does not have.
    pub unshared: usize,
    /// Channels that only one of the two has.
    pub alone: [Vec<String>; 2],
    /// Whether the instants are crank angles.
    pub by_crank: bool,
    /// Why channels are off, where that is simple.
    pub causes: Vec<Explained>,
}

/// Name of the analytic side in a recording.
const REFERENCE: &str = "reference";

/// Compares two parties; `paths` name them in messages.
///
/// # Errors
/// [`ErrorKind::Input`] if they have no instant or no channel in common, and those of the sides.
pub fn compare(parties: [Party; 2], paths: [&Path; 2], how: &How) -> Result<Comparison> {
    let mut pairs = Vec::new();
    let [first, second] = parties;
    let named = |all: Vec<(String, Trajectory)>| -> Vec<(String, Held)> {
        all.into_iter()
            .map(|(name, own)| {
                let held = Held::of_trajectory(&own, name == REFERENCE);
                (name, held)
            })
            .collect()
    };
    let unnamed = |held: Held| vec![(String::new(), held)];
    let sides = |party: Party| match party {
        Party::Scenario(_) => None,
        Party::Recording(all) => Some(named(all)),
        Party::Table(held) => Some(unnamed(*held)),
    };
    match (first, second) {
        (Party::Scenario(one), Party::Scenario(other)) => {
            let held = analytic_party::held(&one)?;
            pairs.push(analytic_party::beside(&other, (String::new(), held), false, how)?);
        }
        (Party::Scenario(scenario), other) => {
            for side in sides(other).unwrap_or_default() {
                pairs.push(analytic_party::beside(&scenario, side, true, how)?);
            }
        }
        (other, Party::Scenario(scenario)) => {
            for side in sides(other).unwrap_or_default() {
                pairs.push(analytic_party::beside(&scenario, side, false, how)?);
            }
        }
        (one, other) => {
            let (ones, others) = (sides(one).unwrap_or_default(), sides(other).unwrap_or_default());
            for [one, other] in paired(&ones, &others, paths, how)? {
                pairs.push(align::beside(one, other, how)?);
            }
        }
    }
    how.check_used(&pairs)?;
    let verdicts: Vec<&Verdict> = pairs
        .iter()
        .flat_map(|pair| {
            let channels = pair.channels.iter().map(|channel| &channel.verdict);
            channels.chain(pair.checks.iter().map(|check| &check.verdict))
        })
        .collect();
    let verdict = overall(verdicts);
    Ok(Comparison { pairs, verdict })
}

type Side = (String, Held);

/// Which sides of two parties belong together: those of the same name, or all with one that is alone.
fn paired<'a>(ones: &'a [Side], others: &'a [Side], paths: [&Path; 2], how: &How) -> Result<Vec<[&'a Side; 2]>> {
    let asked = |side: &&Side| how.side.as_ref().is_none_or(|name| side.0 == *name || side.0.is_empty());
    let (ones, others): (Vec<&Side>, Vec<&Side>) =
        (ones.iter().filter(asked).collect(), others.iter().filter(asked).collect());
    let pairs: Vec<[&Side; 2]> = match (ones.as_slice(), others.as_slice()) {
        ([one], others) => others.iter().map(|other| [*one, *other]).collect(),
        (ones, [other]) => ones.iter().map(|one| [*one, *other]).collect(),
        (ones, others) => {
            let same = |one: &&'a Side| Some([*one, *others.iter().find(|other| other.0 == one.0)?]);
            ones.iter().filter_map(same).collect()
        }
    };
    if pairs.is_empty() {
        let message = format!("{} and {} have no side of the same name", paths[0].display(), paths[1].display());
        return Err(Error::new(ErrorKind::Input, message).help("name a side that both have, such as reference"));
    }
    Ok(pairs)
}
