//! Outcomes as Markdown, for a comment to a pull request.
//! The verdict comes first, then the reasons against agreement.

use crate::sentences;
use std::cmp::Reverse;

use super::outcomes::{Case, Entry, Outcomes};
use crate::plain::cells::{counted, marked};
use crate::plain::judged::{Grade, counts, grade};

/// Number of reasons written in full for one scenario; further reasons are only counted.
const REASONS: usize = 10;

/// The outcomes as a document.
#[must_use]
pub fn text(outcomes: &Outcomes) -> String {
    let (entries, noun) = (&outcomes.entries, outcomes.noun);
    let words = ["disagree", "error", "inconclusive", "agree"];
    let told = ["disagree", sentences::CANNOT_BE_PROVEN, "could not be decided", "agree"];
    let parts = words.into_iter().zip(told).filter_map(|(word, told)| {
        let count = entries.iter().filter(|entry| entry.verdict == word).count();
        (count > 0).then(|| format!("{count} {told}"))
    });
    let parts: Vec<String> = parts.collect();
    let mut text = format!("**linkproof**: {}, {}\n\n| {noun} ", counted(entries.len(), noun), parts.join(", "));
    text += "| verdict | agree | expected | disagree | undecided |\n|---|---|---|---|---|---|\n";
    for entry in entries {
        let verdict = if entry.verdict == "agree" { "agree".into() } else { format!("**{}**", entry.verdict) };
        let counts = counts(entry.cases.iter().map(|case| &case.verdict)).map(|count| count.to_string());
        say!(text, "{}", marked(&[&[cell(&entry.name), verdict], &counts[..]].concat()));
    }
    for entry in entries {
        reasons(entry, &mut text);
    }
    entries.iter().for_each(|entry| figures(entry, &mut text));
    text
}

/// The figures of a scenario, folded, because a comment may have many scenarios.
fn figures(entry: &Entry, text: &mut String) {
    let Some((head, rows)) = entry.figures.split_first() else { return };
    say!(text, "\n<details><summary>{}: {}</summary>\n", line(&entry.name), sentences::FIGURES_OF_THE_MOTION);
    say!(text, "{}\n|---|---:|---|---|", marked(head));
    for row in rows {
        say!(text, "{}", marked(&row.each_ref().map(|own| cell(own))));
    }
    say!(text, "\n</details>");
}

/// Faults and open points of a scenario, disagreements first.
fn reasons(entry: &Entry, text: &mut String) {
    let mut all: Vec<&Case> = entry.cases.iter().filter(|case| grade(&case.verdict) != Grade::Agree).collect();
    all.sort_by_key(|case| Reverse(grade(&case.verdict)));
    if all.is_empty() && entry.error.is_none() {
        return;
    }
    let title = if entry.title.is_empty() { String::new() } else { format!(": {}", line(&entry.title)) };
    say!(text, "\n### {}{title}\n", line(&entry.name));
    if let Some(error) = &entry.error {
        say!(text, "- {}", line(error));
    }
    for Case { by, name, reason, .. } in all.iter().take(REASONS) {
        say!(text, "- `{name}` ({by}): {}", line(reason.as_deref().unwrap_or_default()));
    }
    if all.len() > REASONS {
        say!(text, sentences::and_more_5(&(all.len() - REASONS)));
    }
}

/// Text in one line, without characters that could be taken for markup.
fn line(text: &str) -> String {
    let one: Vec<&str> = text.split_whitespace().collect();
    one.join(" ").replace('<', "&lt;").replace('*', "\\*")
}

/// Untrusted text in one line, without links, code or markup.
pub(super) fn foreign(text: &str) -> String {
    let mut shown = String::new();
    for letter in text.split_whitespace().collect::<Vec<_>>().join(" ").chars() {
        match letter {
            '<' => shown.push_str("&lt;"),
            '&' => shown.push_str("&amp;"),
            '\\' | '`' | '*' | '[' | ']' | '>' | '|' | '#' | '~' | '!' | '$' => shown.extend(['\\', letter]),
            _ => shown.push(letter),
        }
    }
    shown
}

fn cell(text: &str) -> String {
    line(text).replace('|', "\\|")
}
