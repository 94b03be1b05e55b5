//! The numbers of a recording, for viewers that draw curves and nothing else.

use super::recording::Side;
use super::table::topic_name;
use super::view::{Plot, plots};
use super::{messages, read};
use linkage::error::Result;
use linkage::trajectory::{Channel, Trajectory};
use std::collections::BTreeSet;
use std::path::Path;

/// The numbers of a recording.
#[derive(Clone, Debug)]
pub struct Numbers {
    /// Topics of the sides and of their errors.
    pub topics: Vec<String>,
    /// Plots, the most interesting first: the values of all sides, then their errors.
    pub plots: Vec<Plot>,
}

/// Reads which numbers a recording has.
///
/// # Errors
/// Those of [`load`](super::load).
pub fn numbers(path: &Path) -> Result<Numbers> {
    let bytes = read::bytes(path)?;
    let sides = read::read_bytes(&bytes, path)?;
    let mut topics = BTreeSet::new();
    messages::each(&bytes, path, |message| {
        let topic = message.channel.topic.as_str();
        let side = topic.strip_prefix('/').and_then(|rest| rest.split_once('/')).map(|(side, _)| side);
        if side.is_some_and(|side| side == "error" || sides.iter().any(|(own, _)| own == side)) {
            topics.insert(topic.to_string());
        }
        Ok(())
    })?;
    Ok(Numbers { plots: plotted(&sides, &topics), topics: topics.into_iter().collect() })
}

/// Plots of the sides, and of those errors that have a topic.
pub(super) fn plotted(sides: &[(String, Trajectory)], topics: &BTreeSet<String>) -> Vec<Plot> {
    let named: Vec<Side> = sides.iter().map(|(name, trajectory)| Side { name, trajectory }).collect();
    let errors: Vec<Channel> = (named.first().iter().flat_map(|side| side.trajectory.channels()))
        .filter(|channel| topics.contains(&topic_name("error", channel.kind.subject, &channel.of)))
        .cloned()
        .collect();
    plots(&named, &errors)
}
