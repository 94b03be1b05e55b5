//! Kind of an error without a simple cause: an error that grows with time, a small smooth error, or noise.

use super::question::DiagnosisInput;
use super::slips::Wrong;
use crate::bounds::{differences, scales};
use linkage::math::statistics::{ascending, rms};
use linkage::math::{KeepNan, largest_size};

/// Typical errors of numerical methods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ErrorNature {
    /// The error grows with time, approximately with this power of time; `None` if the power cannot be determined.
    Growing(Option<u32>),
    /// The error changes smoothly with time, and is at most this fraction of a channel's scale.
    Smooth(f64),
    /// The error is irregular in time, and is at most this fraction of a channel's scale.
    Noise(f64),
}

/// Number of parts of the run whose errors are compared.
const PARTS: usize = 6;
/// An error counts as growing if it is at least this many times as large in the last part as in the first part.
const GROWS: f64 = 4.0;
/// An error above this fraction of the channel's scale is not the error of a numerical method.
const SMALL: f64 = 0.02;
/// Limits of the ratio that `disorder` returns.
/// The error is smooth if the ratio is below the first limit, and noise if the ratio is above the second limit.
const ORDER: [f64; 2] = [0.15, 0.5];

/// The kind of the differences, if all disagreeing channels have the same kind.
pub(super) fn nature(question: &DiagnosisInput, wrong: &[Wrong]) -> Option<ErrorNature> {
    let rows = ascending(question.reference.times());
    if rows.len() < 2 * PARTS {
        return None;
    }
    let scales = scales(question.reference);
    let scale = |one: &Wrong| {
        let place = question.reference.channels().iter().position(|own| own == one.channel);
        place.map_or(0.0, |place| scales[place])
    };
    let all: Vec<(Vec<f64>, f64)> = wrong
        .iter()
        .map(|one| {
            let gaps = differences(one.right, one.found, one.channel.kind.periodic);
            (rows.iter().map(|&row| gaps[row]).collect(), scale(one))
        })
        .collect();
    let times: Vec<f64> = rows.iter().map(|&row| question.reference.times()[row]).collect();
    let powers: Option<Vec<Option<u32>>> = all.iter().map(|(gaps, _)| growth(&times, gaps)).collect();
    if let Some(powers) = powers.filter(|powers| !powers.is_empty()) {
        let first = powers[0];
        return Some(ErrorNature::Growing(first.filter(|_| powers.iter().all(|own| *own == first))));
    }
    let share = all.iter().fold(0.0, |most: f64, (gaps, scale)| most.larger(largest_size(gaps) / scale));
    if !(share <= SMALL) {
        return None;
    }
    let orders: Vec<f64> = all.iter().map(|(gaps, _)| disorder(gaps)).collect();
    if orders.iter().all(|own| *own <= ORDER[0]) {
        Some(ErrorNature::Smooth(share))
    } else {
        orders.iter().all(|own| *own >= ORDER[1]).then_some(ErrorNature::Noise(share))
    }
}

/// Power of time with which an error grows; `None` if the error does not grow, `Some(None)` if the error grows without
/// a clear power.
fn growth(times: &[f64], gaps: &[f64]) -> Option<Option<u32>> {
    let size = gaps.len() / PARTS;
    let parts: Vec<f64> = (0..PARTS).map(|part| rms(&gaps[part * size..(part + 1) * size])).collect();
    let grows = parts.windows(2).all(|pair| pair[1] > pair[0]) && parts[PARTS - 1] >= GROWS * parts[0];
    if !grows {
        return None;
    }
    // Only the second half of the run is used, because the times within a late part differ little from the time at the
    // middle of the part.
    let middle = |part: usize| times[part * size + size / 2] - times[0];
    let power = (parts[PARTS - 1] / parts[PARTS / 2]).ln() / (middle(PARTS - 1) / middle(PARTS / 2)).ln();
    let whole = power.round();
    Some(((power - whole).abs() <= 0.2 && (1.0..=4.0).contains(&whole)).then_some(whole as u32))
}

/// Root mean square of the second differences, divided by the value that independent random numbers with the same root
/// mean square would give.
fn disorder(gaps: &[f64]) -> f64 {
    let second: Vec<f64> = gaps.windows(3).map(|three| three[2] - 2.0 * three[1] + three[0]).collect();
    rms(&second) / (6f64.sqrt() * rms(gaps))
}
