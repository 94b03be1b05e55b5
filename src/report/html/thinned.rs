//! The instants that a page shows, and the errors of engines at all these instants.

use std::collections::BTreeSet;

use linkage::math::statistics::{self, ascending, differences};
use linkage::trajectory::{Channel, Stage, Trajectory};

use prover::run::Proof;

/// Errors of an engine at all instants, for each channel of the reference; NaN where the engine has no value.
/// `None` if the engine does not have the channel.
pub(super) type Errors = Vec<Option<Vec<f64>>>;

/// The part of all instants that a page shows.
pub(super) struct Thinned {
    /// Rows of the reference's grid, in ascending order of time.
    pub(super) rows: Vec<usize>,
    /// Number of all instants.
    pub(super) all: usize,
}

impl Thinned {
    /// The instants of a page: all instants, or as many as fit.
    /// If not all instants fit, the page has evenly chosen instants, and the instants with extreme values and errors.
    /// `beside` is the number of single-precision values in a row in addition to channels and errors.
    /// `bytes` is the limit for all columns, in bytes of base64.
    pub(super) fn of(proof: &Proof, errors: &[Errors], beside: usize, bytes: usize) -> Thinned {
        let reference = &proof.reference_trajectory;
        let times = reference.times();
        let mut rows = ascending(times);
        rows.dedup_by_key(|row| times[*row].to_bits());
        let all = rows.len();
        let most = (bytes / bytes_of_row(reference, errors, beside)).max(2);
        if all <= most {
            return Thinned { rows, all };
        }
        let mut kept: BTreeSet<usize> = extremes(reference, errors).into_iter().take(most / 2).collect();
        let stride = all.div_ceil(most - kept.len());
        kept.extend(rows.iter().step_by(stride));
        kept.extend(rows.last());
        rows.retain(|row| kept.contains(row));
        Thinned { rows, all }
    }
}

/// Whether a page stores a channel in double precision. Positions are stored in double precision, so that joined links
/// meet in the picture even far from the origin.
pub(super) fn is_wide(channel: &Channel) -> bool {
    channel.kind.stage == Stage::Positions
}

/// Bytes of base64 that an instant needs.
fn bytes_of_row(reference: &Trajectory, errors: &[Errors], beside: usize) -> usize {
    let values: usize = reference.channels().iter().map(|own| if is_wide(own) { 8 } else { 4 }).sum();
    let errors: usize = errors.iter().flatten().map(|own| if own.is_some() { 4 } else { 0 }).sum();
    // Time and crank angle are doubles; base64 uses four characters for three bytes.
    (16 + values + errors + 4 * beside) * 4 / 3
}

/// Rows at which a channel has its largest error, its smallest or its largest value; rows of errors come first.
fn extremes(reference: &Trajectory, errors: &[Errors]) -> Vec<usize> {
    let place = |values: &[f64], better: fn(f64, f64) -> bool| {
        let mut best: Option<(usize, f64)> = None;
        for (row, &value) in values.iter().enumerate() {
            if value.is_finite() && best.is_none_or(|(_, own)| better(value, own)) {
                best = Some((row, value));
            }
        }
        best.map(|(row, _)| row)
    };
    let largest = |values: &Vec<f64>| place(&values.iter().map(|value| value.abs()).collect::<Vec<_>>(), |a, b| a > b);
    let of_errors = errors.iter().flatten().flatten().filter_map(largest);
    let of_values =
        reference.iter().flat_map(|(_, values)| [place(values, |a, b| a > b), place(values, |a, b| a < b)]).flatten();
    of_errors.chain(of_values).collect()
}

/// Engine minus reference over the whole grid, for every engine. If an engine stopped, the later errors are missing.
pub(super) fn errors(proof: &Proof) -> Vec<Errors> {
    let reference = &proof.reference_trajectory;
    let of = |own: &Trajectory| -> Errors {
        let rows = matching(reference.times(), own.times());
        let pairs: Vec<(usize, usize)> =
            rows.iter().enumerate().filter_map(|(row, other)| Some((row, (*other)?))).collect();
        let of_channel = |(index, (channel, ours)): (usize, (&Channel, &[f64]))| {
            let theirs = own.column_near(channel, index)?;
            let [ours, theirs]: [Vec<f64>; 2] = [
                pairs.iter().map(|(row, _)| ours[*row]).collect(),
                pairs.iter().map(|(_, row)| theirs[*row]).collect(),
            ];
            let mut all = vec![f64::NAN; rows.len()];
            for ((row, _), error) in pairs.iter().zip(differences(&ours, &theirs, channel.kind.periodic)) {
                all[*row] = error;
            }
            Some(all)
        };
        reference.iter().enumerate().map(of_channel).collect()
    };
    let nothing = || vec![None; reference.channels().len()];
    proof.engines.iter().map(|engine| engine.trajectory.as_ref().map_or_else(nothing, of)).collect()
}

/// For every instant of a grid, the row of another grid at the same instant.
fn matching(times: &[f64], others: &[f64]) -> Vec<Option<usize>> {
    let order = ascending(others);
    let at = |time: &f64| {
        let place = order.partition_point(|&row| others[row] < *time);
        order.get(place).copied().filter(|&row| others[row] == *time)
    };
    times.iter().map(at).collect()
}

/// Smallest and largest of some numbers; zeros if there are no numbers.
pub(super) fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let [low, high] = statistics::ends(values);
    if low <= high { [low, high] } else { [0.0; 2] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instants_are_matched_in_any_order() {
        assert_eq!(matching(&[0.0, 2.0, 1.0], &[1.0, 0.0]), [Some(1), None, Some(0)]);
        assert_eq!(matching(&[0.0], &[]), [None]);
        assert_eq!(ends([2.0, -1.0].into_iter()), [-1.0, 2.0]);
        assert_eq!(ends([].into_iter()), [0.0; 2]);
    }
}
