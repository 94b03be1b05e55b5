//! Two parties side by side: scenarios, recordings, tables of other programs.
//!
//! One of the two is brought to the instants of the other: a scenario is solved there, a table has them or is
//! interpolated. Then channel by channel is compared, within what is known of both and what is allowed besides.

mod align;
mod allowed;
mod analytic_party;
mod cause;
mod contradiction;
mod crank;
mod instants;
mod interpolate;
mod judge;
mod pair;
mod scale;

pub use allowed::How;
pub use cause::Explained;
pub use contradiction::Contradiction;
pub use judge::{Compared, Row};
pub use pair::Pair;

use std::path::Path;

use self::pair::Side;
use self::scale::Scales;
use crate::compare::{Verdict, overall};
use crate::tables::Held;
use linkage::error::{Error, ErrorKind, Result};
use linkage::trajectory::Trajectory;
use scenario::Scenario;
use scenario::words::choice;

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

/// Name of the analytic side in a recording.
const REFERENCE: &str = "reference";

/// Compares two parties; `paths` name them in messages.
///
/// # Errors
/// [`ErrorKind::Input`] if they have no instant or no channel in common, and those of the sides.
pub fn compare(parties: [Party; 2], paths: [&Path; 2], how: &How) -> Result<Comparison> {
    let mut pairs = Vec::new();
    let [first, second] = parties;
    let sides = |party: Party| match party {
        Party::Scenario(_) => Ok(Vec::new()),
        Party::Recording(all) => asked(all, how),
        Party::Table(held) => Ok(vec![(String::new(), *held)]),
    };
    match (first, second) {
        (Party::Scenario(one), Party::Scenario(other)) => {
            let held = analytic_party::held(&one)?;
            pairs.push(analytic_party::beside(&other, (String::new(), held), false, how)?);
        }
        (Party::Scenario(scenario), other) => {
            for side in sides(other)? {
                pairs.push(analytic_party::beside(&scenario, side, true, how)?);
            }
        }
        (other, Party::Scenario(scenario)) => {
            for side in sides(other)? {
                pairs.push(analytic_party::beside(&scenario, side, false, how)?);
            }
        }
        (one, other) => {
            let (ones, others) = (sides(one)?, sides(other)?);
            for [one, other] in paired(&ones, &others, paths)? {
                pairs.push(align::beside(one, other, how)?);
            }
        }
    }
    how.check_used(pairs.iter().flat_map(|pair| &pair.channels).map(|own| &own.claim))?;
    let verdicts: Vec<Verdict> = pairs.iter().map(Pair::verdict).collect();
    let verdict = overall(&verdicts);
    Ok(Comparison { pairs, verdict })
}

/// The sides of a recording that are asked for.
fn asked(all: Vec<(String, Trajectory)>, how: &How) -> Result<Vec<Side>> {
    let names: Vec<String> = all.iter().map(|(name, _)| name.clone()).collect();
    let is_asked = |name: &str| how.side.as_deref().is_none_or(|side| side == name);
    let held = |(name, own): (String, Trajectory)| {
        let mut held = Held::of_trajectory(&own, name == REFERENCE);
        let scales = Scales::of_trajectory(&own);
        held.columns.iter_mut().for_each(|column| column.scale = scales.of_claim(&column.claim));
        if held.is_analytic {
            for column in &mut held.columns {
                let known = scales.known(&column.claim.channels[0].1.channel);
                column.values.iter_mut().for_each(|value| value.error += known);
            }
        }
        (name, held)
    };
    let asked: Vec<Side> = all.into_iter().filter(|(name, _)| is_asked(name)).map(held).collect();
    match (&how.side, asked.is_empty()) {
        (Some(side), true) => Err(Error::new(ErrorKind::Input, format!("a recording has no side {side}"))
            .help(format!("it has {}", choice(names.iter().map(String::as_str), "")))),
        _ => Ok(asked),
    }
}

/// Which sides of two parties belong together: those of the same name, or all with one that is alone.
fn paired<'a>(ones: &'a [Side], others: &'a [Side], paths: [&Path; 2]) -> Result<Vec<[&'a Side; 2]>> {
    let pairs: Vec<[&Side; 2]> = match (ones, others) {
        ([one], others) => others.iter().map(|other| [one, other]).collect(),
        (ones, [other]) => ones.iter().map(|one| [one, other]).collect(),
        (ones, others) => {
            let same = |one: &'a Side| Some([one, others.iter().find(|other| other.0 == one.0)?]);
            ones.iter().filter_map(same).collect()
        }
    };
    if pairs.is_empty() {
        let message = format!("{} and {} have no side of the same name", paths[0].display(), paths[1].display());
        return Err(Error::new(ErrorKind::Input, message).help("name a side that both have, such as reference"));
    }
    Ok(pairs)
}
