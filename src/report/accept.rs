//! Changes of accepted figures, as text and as JSON.

use crate::sentences;
use std::path::Path;

use serde_json::{Value, json};

use super::json::Failure;
use super::pretty::{list, pretty};
use crate::plain::Tell;
use crate::plain::cells::{counted, table, trimmed};
use crate::plain::diagnosis::number;
use crate::plain::judged::{Grade, grade};
use linkage::error::Error;
use linkage::trajectory::Channel;
use prover::accept::{ChannelFigure, FigureComparison, Moved, Wider};
use prover::numbers;
use prover::run::Proof;
use scenario::accepted::Accepted;

/// Number of channels whose figures are shown; further channels are only counted.
const SHOWN: usize = 20;

linkage::words! {
    /// Action on the file of accepted figures.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Deed: word {
        /// The figures of the run were compared with those in the file, and the file stays unchanged.
        Checked = "checked",
        /// The file did not exist, and was written.
        Written = "written",
        /// The file was written again, with the figures of this run.
        Renewed = "renewed",
        /// No figure has changed, so the file stays unchanged.
        Kept = "kept",
        /// The proof does not agree: nothing was written.
        Refused = "refused",
    }
}

/// A scenario with its accepted figures.
pub(crate) struct Item<'a> {
    /// The proof that gave the figures.
    pub(crate) proof: &'a Proof,
    /// Figures of this run.
    pub(crate) found: &'a Accepted,
    /// The changes; `None` if nothing was accepted before.
    pub(crate) comparison: Option<&'a FigureComparison>,
    /// Action on the file.
    pub(crate) deed: Deed,
    /// The file of accepted figures.
    pub(crate) file: &'a Path,
}

impl Item<'_> {
    /// Number of channels without figures, because their bounds are not finite.
    fn without_figures(&self) -> usize {
        self.proof.reference_trajectory.channels().len() - self.found.channels.len()
    }
}

/// The report on one scenario: first the result, then the changes.
pub(crate) fn text(item: &Item) -> String {
    let mut text = format!("{}\n", headline(item));
    if let Some(comparison) = item.comparison {
        changes(comparison, &mut text);
    }
    if item.without_figures() > 0 {
        say!(text, sentences::have_no_finite_bound_and_no_figures(&channels(item.without_figures())));
    }
    text
}

fn headline(item: &Item) -> String {
    let (name, file) = (&item.found.scenario, item.file.display());
    let all = channels(item.found.channels.len());
    match (item.deed, item.comparison) {
        (Deed::Checked, Some(comparison)) => match grade(&comparison.verdict) {
            Grade::Agree => sentences::agree_is_as_accepted_in_within(&name, &file, &all),
            Grade::Open => sentences::inconclusive_is_not_proven_to_be_as_accepted(&name, &file, &counts(comparison)),
            Grade::Disagree => sentences::disagree_is_not_as_accepted(&name, &file, &counts(comparison)),
        },
        (Deed::Renewed, Some(comparison)) => sentences::accepted_anew_in(&name, &file, &counts(comparison)),
        (Deed::Kept, _) => sentences::nothing_has_moved_stays_as_it_is(&name, &file, &all),
        (Deed::Refused, _) => sentences::not_accepted_the_proof_is(&name, &item.proof.verdict.word()),
        (Deed::Written | Deed::Checked | Deed::Renewed, _) => sentences::accepted_in(&name, &all, &file),
    }
}

fn channels(count: usize) -> String {
    counted(count, "channel")
}

/// Counts of the changes.
fn counts(comparison: &FigureComparison) -> String {
    let FigureComparison { wider, looser, new, gone, is_other_grid, proof, .. } = comparison;
    let moved = comparison.moved_channels().len();
    let mut parts = Vec::new();
    if let Some([accepted, found]) = proof {
        let now = if accepted == found { "still is" } else { &format!("is {found}") };
        parts.push(sentences::the_proof_was_accepted_as_and(&accepted, &now));
    }
    if *is_other_grid {
        parts.push(sentences::ITS_INSTANTS_ARE_OTHERS_VALUES.into());
    }
    let all = comparison.channels;
    if all == 0 {
        parts.push(sentences::THERE_IS_NO_FIGURE.into());
    }
    let counted = [
        (moved, "moved"),
        (wider.len(), sentences::KNOWN_TIMES_WORSE_OR_MORE),
        (looser.len(), sentences::ACCEPTED_WITHIN_TIMES_THE_BOUND),
        (new.len(), "new"),
        (gone.len(), "gone"),
    ];
    let counted = counted.into_iter().filter(|(count, _)| *count > 0);
    parts.extend(counted.map(|(count, word)| match word {
        "gone" => format!("{count} gone"),
        _ => format!("{count} of {} {word}", channels(all)),
    }));
    parts.join(", ")
}

/// Lists, for every channel that has changed, the figure with the largest change.
/// Also lists the channels that are new, that are missing in this run, or whose bound is much wider or much narrower
/// than the accepted bound.
fn changes(comparison: &FigureComparison, text: &mut String) {
    let worst_of = |channel: &&str| {
        let own = comparison.moved.iter().filter(|moved| moved.channel == *channel);
        own.max_by(|a, b| a.bounds().total_cmp(&b.bounds()))
    };
    let moved = comparison.moved_channels();
    let mut worst: Vec<&Moved> = moved.iter().filter_map(worst_of).collect();
    worst.sort_by(|a, b| b.bounds().total_cmp(&a.bounds()));
    let row = |moved: &&Moved| {
        // The accepted figure and the found figure are shown with enough digits to differ.
        let [accepted, found] = [(moved.accepted, moved.found), (moved.found, moved.accepted)]
            .map(|(value, other)| numbers::told_apart(value, other));
        let by = format!("{:+.1e} {}", moved.found - moved.accepted, numbers::shown(unit(&moved.channel)));
        let [bound, bounds] = [moved.bound, moved.bounds()].map(|number| format!("{number:.1e}"));
        let (word, at) = figure(moved.figure);
        let figure = at.map_or(word.to_string(), |t| format!("{word} {} s", number(t)));
        [moved.channel.clone(), figure, accepted, found, by, bound, bounds]
    };
    if !worst.is_empty() {
        let mut table = table("channel | figure | accepted> | found> | moved by> | bound> | bounds>");
        say!(text, "\n{}", trimmed(table.add_rows(worst.iter().take(SHOWN).map(row))));
    }
    if worst.len() > SHOWN {
        say!(text, sentences::and_more_channels_the_json(&(worst.len() - SHOWN)));
    }
    for (word, names) in [("new", &comparison.new), ("gone", &comparison.gone)] {
        if !names.is_empty() {
            say!(text, "\n{word}: {}", listed(names));
        }
    }
    for other in comparison.wider.iter().take(SHOWN).chain(comparison.looser.iter().take(SHOWN)) {
        let (channel, unit) = (&other.channel, numbers::shown(unit(&other.channel)));
        say!(
            text,
            sentences::its_bound_was_now(
                &channel,
                &format_args!("{:.1e}", other.accepted),
                &unit,
                &format_args!("{:.1e}", other.found)
            )
        );
    }
}

fn listed(names: &[String]) -> String {
    let more = names.len().saturating_sub(SHOWN);
    let names = names.iter().take(SHOWN).map(String::as_str).collect::<Vec<_>>().join(", ");
    if more == 0 { names } else { sentences::and_more_4(&names, &more) }
}

fn unit(channel: &str) -> &'static str {
    Channel::named(channel).map_or("", |channel| channel.kind.unit.symbol())
}

/// The name of a figure, and its instant (s) if it has one.
fn figure(figure: ChannelFigure) -> (&'static str, Option<f64>) {
    match figure {
        ChannelFigure::At(t) => ("at", Some(t)),
        ChannelFigure::Least => ("least", None),
        ChannelFigure::Greatest => ("greatest", None),
        ChannelFigure::Rms => ("rms", None),
    }
}

/// The results of a command as JSON.
pub(crate) struct Document {
    files: Vec<Value>,
    errors: Vec<Failure>,
    tell: Tell,
}

impl Document {
    /// An empty document; `tell` puts the advice into words.
    pub(crate) fn told_by(tell: Tell) -> Self {
        Document { files: Vec::new(), errors: Vec::new(), tell }
    }

    /// Adds a scenario.
    pub(crate) fn add(&mut self, item: &Item) {
        let comparison = item.comparison.map(|comparison| {
            json!({
                "verdict": comparison.verdict.word(), "other_grid": comparison.is_other_grid,
                "moved": list(&comparison.moved, row), "wider": list(&comparison.wider, bounds),
                "looser": list(&comparison.looser, bounds), "new": comparison.new, "gone": comparison.gone,
                "accepted_proof": comparison.proof.as_ref().map(|[accepted, _]| accepted),
            })
        });
        self.files.push(json!({
            "scenario": item.found.scenario, "accepted_file": item.file.display().to_string(),
            "deed": item.deed.word(), "proof": item.proof.verdict.word(),
            "reason": item.proof.verdict.reason(self.tell), "channels": item.found.channels.len(),
            "channels_without_figures": item.without_figures(), "comparison": comparison,
        }));
    }

    /// Adds a file that could not be judged.
    pub(crate) fn add_failure(&mut self, scenario: &str, error: &Error) {
        self.errors.extend(Failure::each(scenario, error, self.tell));
    }

    /// The document as text, with a newline at its end.
    pub(crate) fn text(&self) -> String {
        pretty(&json!({ "schema": 1, "files": self.files, "errors": self.errors }))
    }
}

fn bounds(own: &Wider) -> Value {
    json!({
        "channel": own.channel, "unit": unit(&own.channel), "accepted_bound": own.accepted, "found_bound": own.found,
    })
}

fn row(moved: &Moved) -> Value {
    let (figure, t) = figure(moved.figure);
    json!({
        "channel": moved.channel, "unit": unit(&moved.channel), "figure": figure, "t_s": t,
        "accepted": moved.accepted, "found": moved.found, "bound": moved.bound, "bounds": moved.bounds(),
    })
}
