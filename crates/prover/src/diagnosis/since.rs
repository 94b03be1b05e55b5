//! Since when channels are beyond their bounds.

use super::question::Judged;
use crate::compare::differences;
use linkage::math::statistics::ascending;
use linkage::trajectory::{Channel, Trajectory};

/// Where a channel first leaves its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Since {
    /// The channel.
    pub channel: Channel,
    /// First instant beyond the bound (s).
    pub time: f64,
    /// Crank angle of the reference there (rad).
    pub crank: f64,
    /// Suspect minus reference there, in the channel's unit.
    pub difference: f64,
    /// The bound, in the channel's unit.
    pub bound: f64,
    /// Number of instants beyond the bound.
    pub beyond: usize,
}

/// The first instant beyond its bound of every channel that has one, the earliest first. Of channels that leave their
/// bounds together, positions stand before rates and forces, and then the one that is farther beyond its bound.
#[must_use]
pub fn since(reference: &Trajectory, suspect: &Trajectory, judged: &[Judged]) -> Vec<Since> {
    let rows = ascending(reference.times());
    let mut found: Vec<Since> =
        judged.iter().filter_map(|judged| of_channel(reference, suspect, judged, &rows)).collect();
    let excess = |one: &Since| one.difference.abs() / one.bound;
    found.sort_by(|a, b| {
        let stage = a.channel.kind.stage.cmp(&b.channel.kind.stage);
        a.time.total_cmp(&b.time).then(stage).then(excess(b).total_cmp(&excess(a)))
    });
    found
}

fn of_channel(reference: &Trajectory, suspect: &Trajectory, judged: &Judged, rows: &[usize]) -> Option<Since> {
    let Judged { channel, bound, .. } = judged;
    let values = differences(reference.column(channel)?, suspect.column(channel)?, channel.kind.periodic);
    // Written so that NaN counts as beyond.
    let is_beyond = |row: &&usize| !(values[**row].abs() <= *bound);
    let first = *rows.iter().find(is_beyond)?;
    Some(Since {
        channel: channel.clone(),
        time: reference.times()[first],
        crank: reference.inputs()[first],
        difference: values[first],
        bound: *bound,
        beyond: rows.iter().filter(is_beyond).count(),
    })
}
