//! The diagnosis as a whole.

use super::alone::{Party, Standing, standing};
use super::cause::{Cause, Change, How};
use super::nature::{Nature, nature};
use super::question::{Found, Question, Rank};
use super::since::{Since, since};
use super::{changes, derived, others, slips};
use linkage::trajectory::Channel;

/// What can be said about a disagreement.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// The party that was examined.
    pub suspect: String,
    /// Which party stands alone.
    pub alone: Standing,
    /// The channels beyond their bounds, the earliest first.
    pub since: Vec<Since>,
    /// Number of instants of the grid.
    pub instants: usize,
    /// The simplest cause that explains all channels, or, where there is none, the largest part of them. `None`: no
    /// simple cause.
    pub cause: Option<Cause>,
    /// Causes that explain as much, less simple.
    pub also: Vec<Cause>,
    /// Disagreeing channels that the cause leaves unexplained; all of them if there is no cause.
    pub left_over: Vec<Channel>,
    /// What the differences look like, where no cause explains all of them.
    pub nature: Option<Nature>,
    /// Number of changed cases that were solved.
    pub solved: usize,
}

impl Diagnosis {
    /// The channels that left their bounds first, at the same instant.
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

/// Examines a disagreement. `None` if no channel is beyond its bound.
///
/// The causes are tried in the order of their simplicity. One that explains every disagreeing channel to within its
/// bound, and spoils no agreeing one, is named; others that do so too are mentioned.
#[must_use]
pub fn diagnose(question: &Question, parties: &[Party]) -> Option<Diagnosis> {
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
    // A number is found for a part of the channels more easily than for all: that is no evidence.
    found.retain(|one| one.explained.len() == wrong.len() || !has_number(&one.cause));
    // The sort is stable: of equally simple causes the one that was tried first.
    found.sort_by_key(|one| (wrong.len() - one.explained.len(), one.rank));
    let best = found.first().map_or(0, |one| one.explained.len());
    let mut named = found.into_iter().filter(|one| one.explained.len() == best);
    let first = named.next();
    let explained = first.as_ref().map_or(&[][..], |one| &one.explained[..]);
    let left_over: Vec<Channel> = wrong.iter().filter(|channel| !explained.contains(channel)).cloned().collect();
    // A number that was fitted says no more than a slip that needs none. Partial explanations beside each other would
    // only confuse, unless they are of the same part.
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

/// Whether a case has another number, which was fitted.
fn has_number(cause: &Cause) -> bool {
    matches!(cause, Cause::Case(Change { how: How::Instead { .. }, .. }))
}

/// Number of causes that are mentioned besides the one that is named.
const MENTIONED: usize = 3;
