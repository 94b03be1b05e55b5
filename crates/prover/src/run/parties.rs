//! Compares the parties of a proof with each other, to find the party that disagrees with all others. The parties are
//! the reference and the engines.

use super::engine_proof::EngineProof;
use crate::bounds::largest_difference;
use linkage::trajectory::{Channel, Trajectory};

/// A channel in which not all parties agree.
#[derive(Clone, Debug, PartialEq)]
pub struct Dispute {
    /// The channel.
    pub channel: String,
    /// Pairs of parties whose difference exceeds the sum of their bounds.
    pub pairs: Vec<[&'static str; 2]>,
    /// The party that is the only cause of the dispute: without this party, all others agree. `None` if no single party
    /// is the cause, or if there are only two parties.
    pub odd: Option<&'static str>,
}

/// A party: its values and the bound on their error.
struct Party<'a> {
    name: &'static str,
    values: &'a [f64],
    bound: f64,
}

/// Every channel in which two parties differ by more than the sum of their bounds.
/// The bound of the reference is set to 0, because the bounds of the engines include the error of the reference.
/// Engines with an inconclusive verdict are left out.
#[must_use]
pub fn disputes(name: &'static str, reference: &Trajectory, engines: &[EngineProof]) -> Vec<Dispute> {
    reference.iter().filter_map(|(channel, values)| dispute(name, channel, values, engines)).collect()
}

fn dispute(name: &'static str, channel: &Channel, values: &[f64], engines: &[EngineProof]) -> Option<Dispute> {
    let mut parties = vec![Party { name, values, bound: 0.0 }];
    for engine in engines {
        let judged = engine.channels.iter().find(|judged| judged.residual.channel == *channel);
        let trusted = judged.filter(|judged| judged.verdict.word() != "inconclusive");
        let column = engine.trajectory.as_ref().and_then(|trajectory| trajectory.column(channel));
        if let (Some(judged), Some(values)) = (trusted, column) {
            parties.push(Party { name: engine.info.name, values, bound: judged.bound });
        }
    }
    let (pairs, odd) = apart(&parties, channel.kind.periodic)?;
    Some(Dispute { channel: channel.to_string(), pairs, odd })
}

/// Pairs of parties that differ by more than the sum of their bounds, and the party that occurs in all these pairs if
/// there is exactly one such party.
/// `None` if no pair differs.
fn apart(parties: &[Party], periodic: bool) -> Option<(Vec<[&'static str; 2]>, Option<&'static str>)> {
    let differ = |a: &Party, b: &Party| {
        let largest = largest_difference(a.values, b.values, periodic);
        // This form of the comparison counts NaN as a difference.
        !(largest <= a.bound + b.bound)
    };
    let all = parties.iter().enumerate().flat_map(|(index, a)| parties[index + 1..].iter().map(move |b| (a, b)));
    let pairs: Vec<_> = all.filter(|(a, b)| differ(a, b)).map(|(a, b)| [a.name, b.name]).collect();
    if pairs.is_empty() {
        return None;
    }
    let mut alone = parties.iter().map(|party| party.name).filter(|name| pairs.iter().all(|pair| pair.contains(name)));
    let odd = match (parties.len(), alone.next(), alone.next()) {
        (3.., Some(one), None) => Some(one),
        _ => None,
    };
    Some((pairs, odd))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn party(name: &'static str, values: &'static [f64], bound: f64) -> Party<'static> {
        Party { name, values, bound }
    }

    #[test]
    fn the_party_contradicted_by_all_others_is_the_odd_one_out() {
        let reference = party("assur", &[1.0, 2.0], 0.0);
        let close = party("rapier", &[1.001, 2.0], 0.01);
        let wrong = party("impulse", &[1.0, 2.5], 0.01);
        let (pairs, odd) = apart(&[reference, close, wrong], false).unwrap();
        assert_eq!((pairs, odd), (vec![["assur", "impulse"], ["rapier", "impulse"]], Some("impulse")));
    }

    #[test]
    fn the_reference_can_be_the_odd_one_out() {
        let wrong = party("assur", &[1.5], 0.0);
        let found = apart(&[wrong, party("rapier", &[1.0], 0.01), party("simbody", &[1.0], 1e-9)], false);
        assert_eq!(found.unwrap().1, Some("assur"));
    }

    #[test]
    fn two_or_all_different_parties_have_no_odd_one_out() {
        let two = [party("assur", &[1.0], 0.0), party("rapier", &[2.0], 0.01)];
        assert_eq!(apart(&two, false), Some((vec![["assur", "rapier"]], None)));
        let three = [party("assur", &[1.0], 0.0), party("rapier", &[2.0], 0.01), party("simbody", &[3.0], 0.01)];
        assert_eq!(apart(&three, false).unwrap().1, None);
        let agreed = [party("assur", &[1.0], 0.0), party("rapier", &[1.005], 0.01)];
        assert_eq!(apart(&agreed, false), None);
    }

    #[test]
    fn nan_differs_from_everything() {
        let parties = [party("a", &[1.0], 0.0), party("b", &[1.0], 0.1), party("c", &[f64::NAN], 0.1)];
        assert_eq!(apart(&parties, false).unwrap().1, Some("c"));
    }
}
