//! Input of a diagnosis, and the candidates for its cause.

use super::cause::{DataSlip, DisagreementCause};
use linkage::case::Case;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};

/// A channel of the suspect that is judged by a bound.
#[derive(Clone, Debug, PartialEq)]
pub struct SuspectChannel {
    /// The channel.
    pub channel: Channel,
    /// Bound on the suspect's error, in the channel's unit.
    pub bound: f64,
    /// Whether the channel exceeds its bound.
    pub disagrees: bool,
}

/// The disagreement to be diagnosed.
pub struct DiagnosisInput<'a> {
    /// Name of the suspect.
    pub suspect: &'a str,
    /// Trajectory that counts as right.
    pub reference: &'a Trajectory,
    /// Trajectory that contradicts the reference, on the same grid.
    pub suspicious: &'a Trajectory,
    /// All channels with reliable bounds. Agreeing channels are included, because a cause must not make an agreeing
    /// channel disagree.
    pub judged: &'a [SuspectChannel],
    /// The reference's case, on the grid of both trajectories.
    pub case: &'a Case,
    /// Solver for changed cases, with errors far below the bounds.
    pub solver: &'a dyn Solver,
    /// Time step of the suspect, or time between the suspect's rows (s), and the word "step" or "row"; `None` if this
    /// time is not constant or not known.
    pub step: Option<(f64, &'static str)>,
}

/// A cause with the channels that it explains.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub(super) cause: DisagreementCause,
    /// Simplicity of the cause.
    pub(super) rank: Rank,
    /// The disagreeing channels that the cause explains to within their bounds.
    pub(super) explained: Vec<Channel>,
}

impl Found {
    /// A slip in the values of the channels `explained`.
    pub(super) fn of_values(slip: DataSlip, rank: Rank, explained: Vec<Channel>) -> Found {
        Found { cause: DisagreementCause::Values { slip, channels: explained.clone() }, rank, explained }
    }
}

/// Simplicity of a cause, the simplest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    /// A slip without a free number: a wrong sign, a wrong unit, a factor 2 or 1/2.
    Slip,
    /// A change of the case without a free number: a part that is missing or reversed.
    Change,
    /// A part of the case multiplied by a factor with a known meaning, such as a factor between units.
    Scale,
    /// A number of the case, or all instants, changed by a fitted amount.
    Number,
    /// Values changed by a fitted number.
    Fitted,
}
