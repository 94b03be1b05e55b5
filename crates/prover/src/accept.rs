//! Accepted values of a proof. Later runs are judged by comparison with the accepted values.
//! This module also reports which values have changed since they were accepted.
//! Values are compared within the bounds of the accepted run and the later run, never byte by byte.

use crate::sentences;
use std::collections::{BTreeMap, BTreeSet};

use crate::bounds::{Verdict, overall};
use crate::run::Proof;
use linkage::math::KeepNan;
use linkage::math::statistics::{rms, share};
use scenario::accepted::{Accepted, AcceptedChannel};

/// Number of instants at which values are kept.
/// The instants are evenly spaced between the ends of the grid and include these ends.
const INSTANTS: usize = 5;

/// Each stored bound is enlarged by this fraction of itself, because the stored numbers are rounded.
const WRITTEN: f64 = 0.05;

/// If the accepted bound and the bound of the present run differ by more than this factor, agreement proves nothing:
/// the channel is now known much less accurately, or its accepted bound was much too wide.
const WIDER: f64 = 100.0;

/// Two times count as the same instant if they differ by at most this fraction of the larger time.
const SAME_TIME: f64 = 1e-9;

/// Returns the values of a proof that are stored as accepted values. A channel whose bound is not finite is left out.
#[must_use]
pub fn figures(proof: &Proof) -> Accepted {
    let trajectory = &proof.reference_trajectory;
    let rows = rows(trajectory.times().len());
    let pick = |values: &[f64]| -> Vec<f64> { rows.iter().map(|&row| values[row]).collect() };
    let bounded = trajectory.iter().zip(&proof.reference_bounds).filter(|(_, bound)| bound.is_finite());
    let channels = bounded.map(|((channel, values), bound)| AcceptedChannel {
        name: channel.to_string(),
        bound: rounded_up(bound * (1.0 + WRITTEN)),
        at: pick(values),
        least: values.iter().copied().fold(f64::INFINITY, f64::smaller),
        greatest: values.iter().copied().fold(f64::NEG_INFINITY, f64::larger),
        rms: (!channel.kind.periodic).then(|| rms(values)),
    });
    Accepted {
        scenario: proof.scenario.clone(),
        verdict: proof.verdict.word().into(),
        instants: trajectory.times().len(),
        times: pick(trajectory.times()),
        channels: channels.collect(),
    }
}

/// Rows of a grid at which values are kept.
fn rows(count: usize) -> Vec<usize> {
    let mut rows: Vec<usize> = (0..INSTANTS).map(|part| part * count.saturating_sub(1) / (INSTANTS - 1)).collect();
    rows.dedup();
    rows
}

/// Rounds a bound upwards to two digits.
fn rounded_up(bound: f64) -> f64 {
    let unit = 10f64.powf(bound.log10().floor() - 1.0);
    let rounded: f64 = format!("{:.1e}", (bound / unit).ceil() * unit).parse().unwrap_or(bound);
    // A bound of zero, or a bound too small to have two digits, is returned unchanged.
    if rounded >= bound { rounded } else { bound }
}

/// A value of the present run and its accepted counterpart.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// Name of the channel.
    pub channel: String,
    /// The value compared.
    pub figure: ChannelFigure,
    /// Accepted value, in the channel's unit.
    pub accepted: f64,
    /// Value of the present run, in the channel's unit.
    pub found: f64,
    /// Largest difference that the accepted bound and the bound of the present run together allow.
    pub bound: f64,
}

/// Identifies one value of a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ChannelFigure {
    /// Value at this time (s).
    At(f64),
    /// Smallest value.
    Least,
    /// Largest value.
    Greatest,
    /// Root mean square.
    Rms,
}

impl Moved {
    /// Difference between the accepted value and the value of the present run, divided by the largest difference that
    /// the bounds of both values allow.
    #[must_use]
    pub fn bounds(&self) -> f64 {
        share((self.found - self.accepted).abs(), self.bound)
    }
}

/// A channel whose accepted or present bound is so wide that agreement proves nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Wider {
    /// Name of the channel.
    pub channel: String,
    /// Accepted bound, in the channel's unit.
    pub accepted: f64,
    /// Bound of the present run, in the channel's unit.
    pub found: f64,
}

/// Comparison of the values found with the accepted values.
#[derive(Clone, Debug)]
pub struct FigureComparison {
    /// Number of channels found.
    pub channels: usize,
    /// Values for which the accepted number and the number of the present run differ by more than the two bounds
    /// allow, in the order of channels.
    pub moved: Vec<Moved>,
    /// Channels whose bound is now much wider than the accepted bound.
    pub wider: Vec<Wider>,
    /// Channels whose accepted bound is much wider than the bound of the present run.
    /// Within so wide a bound, even a very different value agrees.
    pub looser: Vec<Wider>,
    /// Channels without accepted values.
    pub new: Vec<String>,
    /// Accepted channels that the present run does not have.
    pub gone: Vec<String>,
    /// Whether the grids of the accepted run and of the present run have different instants. Values on different grids
    /// are not compared.
    pub is_other_grid: bool,
    /// Verdict words of the accepted proof and of the present proof; `None` if both are `agree`.
    pub proof: Option<[String; 2]>,
    /// The verdict.
    /// - Disagree: the present proof disagrees, or values, channels or the grid have changed.
    /// - Otherwise inconclusive: a bound has changed much, one of the two proofs does not agree, or the run has no
    ///   channel.
    /// - Otherwise agree.
    pub verdict: Verdict,
}

impl FigureComparison {
    /// Whether everything recorded in the file of accepted values is unchanged.
    #[must_use]
    pub fn is_same(&self) -> bool {
        let is_other_proof = self.proof.as_ref().is_some_and(|[accepted, found]| accepted != found);
        let figures = [&self.new, &self.gone].into_iter().all(Vec::is_empty) && self.moved.is_empty();
        let bounds = self.wider.is_empty() && self.looser.is_empty();
        figures && bounds && !self.is_other_grid && !is_other_proof
    }

    /// Names of the channels with a moved value, each once.
    #[must_use]
    pub fn moved_channels(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self.moved.iter().map(|moved| moved.channel.as_str()).collect();
        names.dedup();
        names
    }
}

/// Compares the values found by a run with the accepted values.
#[must_use]
pub fn compared(accepted: &Accepted, found: &Accepted) -> FigureComparison {
    let is_other_grid = !is_same_grid(accepted, found);
    let known = by_name(accepted);
    let (mut moved, mut wider, mut looser, mut new) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut least_margin = f64::INFINITY;
    for own in &found.channels {
        let Some(kept) = counterpart(&known, own) else {
            new.push(own.name.clone());
            continue;
        };
        let both = || Wider { channel: own.name.clone(), accepted: kept.bound, found: own.bound };
        if own.bound > WIDER * kept.bound {
            wider.push(both());
        } else if kept.bound > WIDER * own.bound {
            looser.push(both());
        }
        if is_other_grid {
            continue;
        }
        for one in pairs(kept, own, &found.times) {
            match Verdict::of((one.found - one.accepted).abs(), one.bound, String::new) {
                Verdict::Agree { margin } => least_margin = least_margin.smaller(margin),
                Verdict::Disagree { .. } | Verdict::Expected { .. } | Verdict::Inconclusive { .. } => moved.push(one),
            }
        }
    }
    let left = by_name(found);
    let gone = accepted.channels.iter().filter(|kept| !left.contains_key(kept.name.as_str()));
    let gone: Vec<String> = gone.map(|kept| kept.name.clone()).collect();
    let verdicts = [accepted.verdict.clone(), found.verdict.clone()];
    let proof = verdicts.iter().any(|word| word != "agree").then_some(verdicts);
    let is_other =
        is_other_grid || !moved.is_empty() || !new.is_empty() || !gone.is_empty() || found.verdict == "disagree";
    // In a run without channels no value can differ, so the run proves nothing.
    let is_open = !wider.is_empty() || !looser.is_empty() || proof.is_some() || found.channels.is_empty();
    let parts = [
        Verdict::Agree { margin: least_margin },
        if is_other { Verdict::Disagree { place: sentences::NOT_AS_ACCEPTED.into() } } else { AGREE },
        if is_open { Verdict::open(sentences::TOO_LITTLE_IS_KNOWN_NOW_OR_WHEN) } else { AGREE },
    ];
    let verdict = overall(&parts);
    FigureComparison { channels: found.channels.len(), moved, wider, looser, new, gone, is_other_grid, proof, verdict }
}

/// Channels by their names.
fn by_name(accepted: &Accepted) -> BTreeMap<&str, &AcceptedChannel> {
    accepted.channels.iter().map(|kept| (kept.name.as_str(), kept)).collect()
}

/// Returns the accepted values of a channel.
/// `None` if the channel has none, or if only one of the two runs gives a root mean square for it.
fn counterpart<'a>(
    known: &BTreeMap<&str, &'a AcceptedChannel>,
    found: &AcceptedChannel,
) -> Option<&'a AcceptedChannel> {
    known.get(found.name.as_str()).copied().filter(|kept| kept.rms.is_some() == found.rms.is_some())
}

const AGREE: Verdict = Verdict::Agree { margin: f64::INFINITY };

fn is_same_grid(accepted: &Accepted, found: &Accepted) -> bool {
    let is_same = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME_TIME * a.abs().larger(b.abs());
    accepted.instants == found.instants
        && accepted.times.len() == found.times.len()
        && accepted.times.iter().zip(&found.times).all(is_same)
}

/// Pairs every accepted value of a channel with the value of the present run on the same grid.
fn pairs(kept: &AcceptedChannel, found: &AcceptedChannel, times: &[f64]) -> Vec<Moved> {
    // Angles that differ by a constant number of whole revolutions describe the same motion, so whole revolutions are
    // subtracted.
    let turns = match (found.rms, kept.at.first(), found.at.first()) {
        (None, Some(kept), Some(found)) => ((found - kept) / std::f64::consts::TAU).round() * std::f64::consts::TAU,
        _ => 0.0,
    };
    let pair = |figure: ChannelFigure, accepted: f64, own: f64| Moved {
        channel: found.name.clone(),
        figure,
        accepted,
        found: own - turns,
        bound: kept.bound + found.bound,
    };
    let at = times
        .iter()
        .zip(kept.at.iter().zip(&found.at))
        .map(|(&t, (&kept, &own))| pair(ChannelFigure::At(t), kept, own));
    let rms = kept.rms.zip(found.rms).map(|(kept, own)| pair(ChannelFigure::Rms, kept, own));
    let ends = [
        pair(ChannelFigure::Least, kept.least, found.least),
        pair(ChannelFigure::Greatest, kept.greatest, found.greatest),
    ];
    at.chain(ends).chain(rms).collect()
}

/// Returns the values to store after a run with the values `found`.
/// A channel keeps its accepted values unless a value has moved or its bound has become much wider or narrower.
/// The file of accepted values therefore changes only where the comparison reports a change.
/// If the run and the accepted values have different grids, the found values replace all accepted values.
#[must_use]
pub fn renewed(accepted: &Accepted, found: Accepted, comparison: &FigureComparison) -> Accepted {
    if comparison.is_other_grid {
        return found;
    }
    let moved = comparison.moved.iter().map(|moved| moved.channel.as_str());
    let bounds = comparison.wider.iter().chain(&comparison.looser).map(|own| own.channel.as_str());
    let others: BTreeSet<&str> = moved.chain(bounds).collect();
    let known = by_name(accepted);
    let kept = |own: AcceptedChannel| match counterpart(&known, &own) {
        Some(kept) if !others.contains(own.name.as_str()) => kept.clone(),
        Some(_) | None => own,
    };
    let channels = found.channels.into_iter().map(kept).collect();
    Accepted { times: accepted.times.clone(), channels, ..found }
}
