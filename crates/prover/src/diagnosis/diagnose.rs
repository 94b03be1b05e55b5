//! The complete diagnosis, and the instants at which channels exceed their bounds.

use super::alone::{DiagnosedParty, PartyStanding, standing};
use super::cause::{Change, DisagreementCause, PartChange};
use super::nature::{ErrorNature, nature};
use super::question::{DiagnosisInput, Found, Rank, SuspectChannel};
use super::{changes, derived, others, slips};
use crate::bounds::differences;
use linkage::input::Input;
use linkage::math::statistics::ascending;
use linkage::trajectory::{Channel, Trajectory};

/// Findings about a disagreement.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// The party that was examined.
    pub suspect: String,
    /// Which parties contradict each other.
    pub alone: PartyStanding,
    /// The channels that exceed their bounds, the earliest channel first.
    pub since: Vec<Since>,
    /// Number of instants of the grid.
    pub instants: usize,
    /// The simplest of the causes that explain the largest number of channels. `None` if there is no simple cause.
    pub cause: Option<DisagreementCause>,
    /// Less simple causes that explain the same channels.
    pub also: Vec<DisagreementCause>,
    /// Disagreeing channels that the cause does not explain; all disagreeing channels if there is no cause.
    pub left_over: Vec<Channel>,
    /// The kind of the differences, if no cause explains all of them.
    pub nature: Option<ErrorNature>,
    /// Number of changed cases that were solved.
    pub solved: usize,
}

impl Diagnosis {
    /// The channels that exceeded their bounds first, all at the same instant.
    #[must_use]
    pub fn first(&self) -> &[Since] {
        let Some(first) = self.since.first() else { return &[] };
        let together = self.since.iter().take_while(|one| one.time == first.time).count();
        &self.since[..together]
    }

    /// Whether the cause explains all disagreeing channels to within their bounds.
    #[must_use]
    pub fn is_explained(&self) -> bool {
        self.cause.is_some() && self.left_over.is_empty()
    }
}

/// Examines a disagreement. `None` if no channel exceeds its bound.
///
/// Causes are tried from the simplest to the most complicated.
/// The named cause explains the largest number of disagreeing channels. A channel is explained if the cause brings its
/// difference within its bound. The named cause must not make an agreeing channel disagree.
/// Further causes that explain the same channels are mentioned.
#[must_use]
pub fn diagnose(question: &DiagnosisInput, parties: &[DiagnosedParty]) -> Option<Diagnosis> {
    let since = since(question.reference, question.suspicious, question.judged);
    let wrong: Vec<Channel> =
        question.judged.iter().filter(|one| one.disagrees).map(|one| one.channel.clone()).collect();
    if since.is_empty() || wrong.is_empty() {
        return None;
    }
    let (of_case, solved) = changes::found(question);
    let off = slips::wrong(question);
    let mut found = slips::found(&off);
    found.extend(others::found(question, &off));
    found.extend(derived::found(question, &off));
    found.extend(of_case);
    // A cause with a fitted number is dropped if it explains only a part of the channels. A number that fits some
    // channels is easily found, so it is no evidence.
    found.retain(|one| one.explained.len() == wrong.len() || !has_number(&one.cause));
    // The sort is stable: equally simple causes stay in the order in which they were tried.
    found.sort_by_key(|one| (wrong.len() - one.explained.len(), one.rank));
    let best = found.first().map_or(0, |one| one.explained.len());
    let mut named = found.into_iter().filter(|one| one.explained.len() == best);
    let first = named.next();
    let explained = first.as_ref().map_or(&[][..], |one| &one.explained[..]);
    let left_over: Vec<Channel> = wrong.iter().filter(|channel| !explained.contains(channel)).cloned().collect();
    // Further causes are mentioned if they explain the same channels as the first cause. If the first cause is a slip,
    // a fitted number adds nothing and is not mentioned.
    let says_more = |one: &Found| one.rank != Rank::Fitted || first.as_ref().is_some_and(|own| own.rank != Rank::Slip);
    let also = named.filter(|one| one.explained == explained && says_more(one)).map(|one| one.cause);
    let also = also.take(MENTIONED).collect();
    let nature = if left_over.is_empty() { None } else { nature(question, &off) };
    Some(Diagnosis {
        suspect: question.suspect.to_string(),
        alone: standing(parties),
        since,
        instants: question.reference.times().len(),
        cause: first.map(|one| one.cause),
        also,
        left_over,
        nature,
        solved,
    })
}

/// Whether the cause is a fitted number that replaces a number in the case.
fn has_number(cause: &DisagreementCause) -> bool {
    matches!(cause, DisagreementCause::Case(Change { how: PartChange::Instead { .. }, .. }))
}

/// Largest number of causes that are mentioned besides the named cause.
const MENTIONED: usize = 3;

/// The first instant at which a channel exceeds its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Since {
    /// The channel.
    pub channel: Channel,
    /// Time of the first instant beyond the bound (s).
    pub time: f64,
    /// Input of the reference at the first instant beyond the bound (SI).
    pub crank: f64,
    /// What `crank` measures.
    pub input: Input,
    /// Suspect minus reference at the first instant beyond the bound, in the channel's unit.
    pub difference: f64,
    /// The bound, in the channel's unit.
    pub bound: f64,
    /// Number of instants beyond the bound.
    pub beyond: usize,
}

/// For every channel that exceeds its bound, the first instant beyond the bound; the earliest channel first.
/// If several channels exceed their bounds at the same instant, they are in the order of their stages: positions,
/// velocities, accelerations, reactions, balancing moment.
/// Within a stage, the channel with the larger ratio of difference to bound comes first.
#[must_use]
pub fn since(reference: &Trajectory, suspect: &Trajectory, judged: &[SuspectChannel]) -> Vec<Since> {
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

fn of_channel(reference: &Trajectory, suspect: &Trajectory, judged: &SuspectChannel, rows: &[usize]) -> Option<Since> {
    let SuspectChannel { channel, bound, .. } = judged;
    let values = differences(reference.column(channel)?, suspect.column(channel)?, channel.kind.periodic);
    // This form of the comparison counts NaN as beyond the bound.
    let is_beyond = |row: &&usize| !(values[**row].abs() <= *bound);
    let first = *rows.iter().find(is_beyond)?;
    Some(Since {
        channel: channel.clone(),
        time: reference.times()[first],
        crank: reference.inputs()[first],
        input: reference.input(),
        difference: values[first],
        bound: *bound,
        beyond: rows.iter().filter(is_beyond).count(),
    })
}
