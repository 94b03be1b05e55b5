//! Finds which of several parties contradicts the others.

use crate::bounds::largest_difference;
use linkage::trajectory::{Channel, Trajectory};

/// One party: its results and their error bounds.
#[derive(Clone, Debug)]
pub struct DiagnosedParty<'a> {
    /// Name for reports.
    pub name: &'a str,
    /// Results of the party.
    pub trajectory: &'a Trajectory,
    /// Bound on the party's error in every judged channel, in the channel's unit. Channels without a bound are ignored.
    pub bounds: Vec<(Channel, f64)>,
}

impl DiagnosedParty<'_> {
    fn bound(&self, channel: &Channel) -> Option<f64> {
        self.bounds.iter().find(|(own, _)| own == channel).map(|(_, bound)| *bound)
    }

    /// Whether this party and `other` differ in a channel by more than the sum of their bounds.
    fn contradicts(&self, other: &DiagnosedParty) -> bool {
        self.trajectory.iter().any(|(channel, ours)| {
            let (Some(own), Some(theirs)) = (self.bound(channel), other.bound(channel)) else { return false };
            let Some(values) = other.trajectory.column(channel) else { return false };
            // This form of the comparison counts NaN as a difference.
            !(largest_difference(ours, values, channel.kind.periodic) <= own + theirs)
        })
    }
}

/// Which parties contradict each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PartyStanding {
    /// No party contradicts another.
    Together,
    /// One party contradicts all others, and the others do not contradict each other.
    Alone(String),
    /// The parties form two camps. Parties of the same camp agree, and parties of different camps contradict each
    /// other.
    Camps([Vec<String>; 2]),
    /// Some parties contradict each other but do not form two camps, or there are only two parties. The variant
    /// contains the contradicting pairs. At most one party of each pair is right; the data do not show which party is
    /// right.
    Open(Vec<[String; 2]>),
}

/// Which parties contradict each other.
#[must_use]
pub fn standing(parties: &[DiagnosedParty]) -> PartyStanding {
    let count = parties.len();
    let mut apart = vec![vec![false; count]; count];
    let mut pairs = Vec::new();
    for one in 0..count {
        for other in one + 1..count {
            if parties[one].contradicts(&parties[other]) {
                (apart[one][other], apart[other][one]) = (true, true);
                pairs.push([parties[one].name.to_string(), parties[other].name.to_string()]);
            }
        }
    }
    let Some(first) = apart.iter().position(|row| row.contains(&true)) else { return PartyStanding::Together };
    // The camp of `first`: the parties that agree with `first`.
    let (own, others): (Vec<usize>, Vec<usize>) = (0..count).partition(|&other| !apart[first][other]);
    let split =
        (0..count).all(|one| (0..count).all(|other| apart[one][other] == (own.contains(&one) != own.contains(&other))));
    if !split || count < 3 {
        return PartyStanding::Open(pairs);
    }
    let names = |camp: &[usize]| camp.iter().map(|&index| parties[index].name.to_string()).collect::<Vec<_>>();
    match (own.as_slice(), others.as_slice()) {
        ([one], _) | (_, [one]) => PartyStanding::Alone(parties[*one].name.to_string()),
        (own, others) => PartyStanding::Camps([names(own), names(others)]),
    }
}
