//! What is known of two sides after they were compared.

use super::cause::Explained;
use super::contradiction::Contradiction;
use super::crank;
use super::judge::{Compared, Row};
use crate::compare::{Check, Verdict, overall};
use crate::tables::Held;

/// A side by its name in a recording; empty for others.
pub(super) type Side = (String, Held);

/// Two sides compared.
pub struct Pair {
    /// What they are called in the recordings; empty for others.
    pub names: [String; 2],
    /// Channel by channel, in the order of the second party.
    pub channels: Vec<Compared>,
    /// Checks of the analytic sides on each other, where a scenario was solved, and of the crank angle, where both have it.
    pub checks: Vec<Check>,
    /// Number of instants of the party that gives them.
    pub instants: usize,
    /// Number of those that the other does not have.
    pub unshared: usize,
    /// Channels that only one of the two has.
    pub alone: [Vec<String>; 2],
    /// The first row whose instant lies back, with the one before: see [`At::turns_back`](crate::tables::At::turns_back).
    pub turns_back: Option<(usize, [f64; 2])>,
    /// Two rows of the party that gives the instants which hold at the same one and contradict each other. No cause is
    /// sought then.
    pub contradiction: Option<Contradiction>,
    /// Whether the instants are crank angles.
    pub by_crank: bool,
    /// Why channels are off, where that is simple.
    pub causes: Vec<Explained>,
}

impl Pair {
    /// Number of values compared, and of those that there would be if none was missing.
    #[must_use]
    pub fn values(&self) -> [usize; 2] {
        let judged = self.channels.iter().map(|own| own.judged).sum();
        [judged, self.channels.len() * (self.instants - self.unshared)]
    }

    /// Whether the crank angles that both carry disagree.
    #[must_use]
    pub fn crank_is_off(&self) -> bool {
        let is_off = |check: &Check| check.family == crank::NAME && matches!(check.verdict, Verdict::Disagree { .. });
        self.checks.iter().any(is_off)
    }

    /// The first row at which one of some channels, by their texts, is beyond its bound.
    #[must_use]
    pub fn since(&self, channels: &[String]) -> Option<Row> {
        let own = self.channels.iter().filter(|own| channels.contains(&own.claim.text));
        own.filter_map(|own| own.since).min_by(|one, other| one.time.total_cmp(&other.time))
    }

    /// The verdict on all channels, and on the analytic sides that solved them.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let channels = self.channels.iter().map(|channel| &channel.verdict);
        overall(channels.chain(self.checks.iter().map(|check| &check.verdict)))
    }
}
