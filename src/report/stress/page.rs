//! The documentation page: all families with their tables and maps.

use super::super::chart::label;
use super::super::html::filled;
use super::summary::{Tally, cells, names};
use crate::plain::cells::marked;
use lab::stress::{StressFamily, StressOutcome};

/// The page as Markdown.
/// `command` generates it; `maps` is the directory of the maps, relative to the page.
pub(crate) fn page(families: &[(&StressFamily, Vec<&StressOutcome>)], command: &str, maps: &str) -> String {
    let tally = Tally::of(families.iter().flat_map(|(_, all)| all.iter().copied()));
    let mut text = filled(include_str!("page.md"), &[("command", command), ("verdict", &tally.verdict())]);
    for (family, outcomes) in families {
        put!(
            text,
            "\n## {}\n\n{}.\nDial: {}.\n\n| | agrees at | otherwise | positions | rates | forces | over bound | widest bound |\n|---|---|---|---|---|---|---|---|\n",
            family.name,
            capital(family.title),
            family.dial
        );
        for name in names(outcomes) {
            let row = [name.to_string()].into_iter().chain(cells(outcomes, name)).collect::<Vec<_>>();
            say!(text, "{}", marked(&row));
        }
        for own in outcomes.iter().filter(|own| !own.refused.is_empty()) {
            say!(text, "\nAt {}: {}.", label(own.dial), own.refused);
        }
        say!(text, "\n![{}]({maps}/{}.svg)", family.name, family.name);
    }
    text
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}
