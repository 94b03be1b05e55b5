//! Values of other channels: exchanged columns, the values of a neighbouring link, the difference of two angles.

use super::cause::DataSlip;
use super::question::{DiagnosisInput, Found, Rank};
use super::slips::{Wrong, settled};
use crate::bounds::differences;
use linkage::math::statistics::half_range;
use linkage::trajectory::{Channel, Unit};

/// A channel can be identified by its values only if their half range exceeds this multiple of the bound.
const TELLING: f64 = 5.0;

/// Number of rows that are compared first.
const FEW: usize = 16;

/// Finds the disagreeing channels whose values come from other channels. Four origins are tried: an exchange with a
/// second channel, the values of one channel (also with the opposite sign), a magnitude, and the difference of two
/// channels.
pub(super) fn found(question: &DiagnosisInput, wrong: &[Wrong]) -> Vec<Found> {
    let mut causes = Vec::new();
    let mut put =
        |slip: DataSlip, rank: Rank, explained: Vec<Channel>| causes.push(Found::of_values(slip, rank, explained));
    for (index, one) in wrong.iter().enumerate() {
        let is_exchanged = |other: &&Wrong| one.has_values_of(other.right) && other.has_values_of(one.right);
        if let Some(other) = wrong[index + 1..].iter().find(is_exchanged) {
            let both = [one.channel.clone(), other.channel.clone()];
            put(DataSlip::Exchanged(both.clone()), Rank::Slip, both.to_vec());
            continue;
        }
        let others = || question.reference.iter().filter(|(channel, _)| alike(channel, one.channel));
        let own = vec![one.channel.clone()];
        if let Some((channel, _)) = others().find(|(_, values)| one.has_values_of(values)) {
            put(DataSlip::Instead(channel.clone()), Rank::Change, own);
            continue;
        }
        let opposite = |values: &[f64]| one.has_values_of(&values.iter().map(|value| -value).collect::<Vec<f64>>());
        if let Some((channel, _)) = others().find(|(_, values)| opposite(values)) {
            put(DataSlip::Opposite(channel.clone()), Rank::Change, own);
            continue;
        }
        if let Some(both) = magnitude(question, one) {
            put(DataSlip::Magnitude(both), Rank::Change, own);
            continue;
        }
        let pairs = question.reference.iter().filter(|(channel, _)| channel.kind.suffix == one.channel.kind.suffix);
        // Constant channels are left out. Values that differ from a channel by a constant are not necessarily relative
        // to another link or point.
        let all: Vec<(&Channel, &[f64])> = pairs.filter(|(_, values)| one.varies(values)).collect();
        if let Some(slip) = between(one, &all) {
            let is_plain = matches!(slip, DataSlip::Between { offset: 0.0, .. });
            put(slip, if is_plain { Rank::Change } else { Rank::Fitted }, own);
        }
    }
    causes
}

/// Whether the values of two channels may be confused: the channels have the same unit and the same stage, or one
/// channel is the rate of the other channel.
fn alike(one: &Channel, other: &Channel) -> bool {
    let is_rate = |of: &Channel, rate: &Channel| of.rate().is_some_and(|own| own == *rate);
    let is_neighbour = is_rate(one, other) || is_rate(other, one);
    one != other && (one.kind.unit == other.kind.unit && one.kind.stage == other.kind.stage || is_neighbour)
}

/// The two components of a vector, if the channel has the vector's magnitude instead of one component.
fn magnitude(question: &DiagnosisInput, one: &Wrong) -> Option<[Channel; 2]> {
    let suffix = one.channel.kind.suffix;
    let other = if suffix.contains('y') { suffix.replacen('y', "x", 1) } else { suffix.replacen('x', "y", 1) };
    let other = Channel::named(&format!("{}.{other}", one.channel.subject()))?;
    let across = question.reference.column(&other)?;
    let sizes: Vec<f64> = one.right.iter().zip(across).map(|(a, b)| a.hypot(*b)).collect();
    one.has_values_of(&sizes).then(|| [one.channel.clone(), other])
}

/// The difference of two channels of one kind: values relative to another link or point. For angles, the difference may
/// also contain a constant offset, because a relative angle may be counted from another axis of the link.
fn between(one: &Wrong, all: &[(&Channel, &[f64])]) -> Option<DataSlip> {
    if !one.varies(one.found) {
        return None;
    }
    for (first, minuend) in all {
        for (second, subtrahend) in all.iter().filter(|(second, _)| second != first) {
            // A few rows are compared first, because they exclude most pairs.
            let gap = |row: usize| one.found[row] - (minuend[row] - subtrahend[row]);
            let few = (0..FEW).map(|part| part * (one.found.len() - 1) / (FEW - 1));
            if few.map(gap).any(|own| !((own - gap(0)).abs() <= 2.0 * one.bound)) {
                continue;
            }
            let difference: Vec<f64> = minuend.iter().zip(*subtrahend).map(|(a, b)| a - b).collect();
            let gaps = differences(&difference, one.found, one.channel.kind.periodic);
            let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
            let offset = if mean.abs() <= one.bound { 0.0 } else { mean };
            let is_it = |offset: f64| gaps.iter().all(|gap| (gap - offset).abs() <= one.bound);
            if is_it(offset) && (offset == 0.0 || one.channel.kind.unit == Unit::Radian) {
                let offset = if offset == 0.0 { 0.0 } else { settled(offset, true, &is_it) };
                return Some(DataSlip::Between { of: [(*first).clone(), (*second).clone()], offset });
            }
        }
    }
    None
}

impl Wrong<'_> {
    /// Whether the channel has the values `others`, and whether these values vary enough to identify a channel.
    pub(super) fn has_values_of(&self, others: &[f64]) -> bool {
        self.varies(others)
            && differences(others, self.found, self.channel.kind.periodic).iter().all(|gap| gap.abs() <= self.bound)
    }

    pub(super) fn varies(&self, values: &[f64]) -> bool {
        half_range(values) > TELLING * self.bound
    }
}
