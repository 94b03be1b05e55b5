//! Reference and engines as equals: who stands against all others.

use super::engines::EngineProof;
use crate::trajectory::{Channel, Trajectory};

/// A channel in which not all agree.
#[derive(Clone, Debug, PartialEq)]
pub struct Dispute {
    /// The channel.
    pub channel: String,
    /// Pairs that differ by more than the bounds of both.
    pub pairs: Vec<[&'static str; 2]>,
    /// The one without which all others agree; `None` if there is no single one, or if there are only two.
    pub odd: Option<&'static str>,
}

/// One side: its values, and how wrong they may be.
struct Party<'a> {
    name: &'static str,
    values: &'a [f64],
    bound: f64,
}

/// Every channel in which two sides differ by more than both may be wrong. The reference's own error is rounding; an engine without
/// a bound that it can be held to takes no part.
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
    let apart = |a: &Party, b: &Party| {
        let largest = crate::compare::largest_difference(a.values, b.values, channel.kind.periodic);
        // Written so that NaN is a difference.
        !(largest <= a.bound + b.bound)
    };
    let mut pairs = Vec::new();
    for (index, a) in parties.iter().enumerate() {
        pairs.extend(parties[index + 1..].iter().filter(|b| apart(a, b)).map(|b| [a.name, b.name]));
    }
    if pairs.is_empty() {
        return None;
    }
    let mut alone = parties.iter().map(|party| party.name).filter(|name| pairs.iter().all(|pair| pair.contains(name)));
    let odd = match (parties.len(), alone.next(), alone.next()) {
        (3.., Some(one), None) => Some(one),
        _ => None,
    };
    Some(Dispute { channel: channel.to_string(), pairs, odd })
}
