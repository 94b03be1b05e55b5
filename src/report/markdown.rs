//! Outcomes as Markdown: the comment to a pull request. The verdict first, then what stands in its way.

use super::outcomes::{Entry, Outcome, Outcomes};
use crate::plain::cells::marked;

/// Reasons that are written out for one scenario; the others are counted.
const REASONS: usize = 10;

/// The outcomes as a document.
#[must_use]
pub fn text(outcomes: &Outcomes) -> String {
    let entries = &outcomes.entries;
    let count = |word: &str| entries.iter().filter(|entry| entry.verdict == word).count();
    let [agree, disagree, open, error] = ["agree", "disagree", "inconclusive", "error"].map(count);
    let parts = [(disagree, "disagree"), (error, "cannot be proven"), (open, "prove nothing"), (agree, "agree")];
    let parts: Vec<String> =
        parts.into_iter().filter(|(count, _)| *count > 0).map(|(count, word)| format!("{count} {word}")).collect();
    let plural = if entries.len() == 1 { "" } else { "s" };
    let mut text = format!("**linkproof**: {} {}{plural}, {}\n\n", entries.len(), outcomes.noun, parts.join(", "));
    put!(text, "| {} ", outcomes.noun);
    text += "| verdict | agree | expected | disagree | open |\n|---|---|---|---|---|---|\n";
    for entry in entries {
        let mut counts = [0; 4];
        for case in &entry.cases {
            counts[match case.outcome {
                Outcome::Agrees => 0,
                Outcome::Expected(_) => 1,
                Outcome::Disagrees(_) => 2,
                Outcome::Open(_) => 3,
            }] += 1;
        }
        let verdict = if entry.verdict == "agree" { "agree".into() } else { format!("**{}**", entry.verdict) };
        let counts = counts.map(|count| count.to_string());
        say!(text, "{}", marked(&[&[cell(&entry.name), verdict], &counts[..]].concat()));
    }
    for entry in entries {
        reasons(entry, &mut text);
    }
    text
}

/// What is wrong or open in a scenario, what disagrees first.
fn reasons(entry: &Entry, text: &mut String) {
    let wrong = entry.cases.iter().filter_map(|case| match &case.outcome {
        Outcome::Disagrees(reason) => Some((case, reason)),
        Outcome::Agrees | Outcome::Expected(_) | Outcome::Open(_) => None,
    });
    let open = entry.cases.iter().filter_map(|case| match &case.outcome {
        Outcome::Open(reason) => Some((case, reason)),
        Outcome::Agrees | Outcome::Expected(_) | Outcome::Disagrees(_) => None,
    });
    let all: Vec<_> = wrong.chain(open).collect();
    if all.is_empty() && entry.error.is_none() {
        return;
    }
    let title = if entry.title.is_empty() { String::new() } else { format!(": {}", line(&entry.title)) };
    say!(text, "\n### {}{title}\n", line(&entry.name));
    if let Some(error) = &entry.error {
        say!(text, "- {}", line(error));
    }
    for (case, reason) in all.iter().take(REASONS) {
        say!(text, "- `{}` ({}): {}", case.name, case.by, line(reason));
    }
    if all.len() > REASONS {
        say!(text, "- ... and {} more", all.len() - REASONS);
    }
}

/// Text in one line, without signs that would be taken for markup.
fn line(text: &str) -> String {
    let one: Vec<&str> = text.split_whitespace().collect();
    one.join(" ").replace('<', "&lt;").replace('*', "\\*")
}

/// Text of strangers in one line: it names no link, is no code and no markup.
pub(super) fn foreign(text: &str) -> String {
    let one: Vec<&str> = text.split_whitespace().collect();
    let letters = one.join(" ");
    let mut shown = String::new();
    for letter in letters.chars() {
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
