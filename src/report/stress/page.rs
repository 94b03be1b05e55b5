//! The page of the documentation: all families with their tables and maps.

use super::summary::{Tally, cells, names};
use crate::stress::{Family, Outcome};

/// The page as Markdown. `command` is what makes it, `maps` the directory of the maps as the page names it.
pub(crate) fn page(families: &[(&Family, Vec<&Outcome>)], command: &str, maps: &str) -> String {
    let tally = Tally::of(families.iter().flat_map(|(_, all)| all.iter().copied()));
    let mut text = format!(
        "# Numerical stability\n\n\
         Made by `{command}`; [benchmarks of growth](../benches/chain.rs) are not part of it.\n\n\
         **{}.**\n\n\
         Every family turns one dial.\n\
         Errors are shares of a channel's scale, half its range over the run, of the worst channel.\n\
         *Over bound* is the largest error over bound of any channel where the verdict agrees: above 1 it would be a wrong \
         number that nobody is told of.\n\
         *Widest bound* is that of a worst channel: agreement within a bound of 1 and more proves nothing by itself, and there \
         the error against double-double is what counts.\n\
         The analytic sides `assur` and `newton` are held against numbers in double-double arithmetic (31 digits) where \
         these can be had, and against each other where not.\n\
         In the maps the thin dashed line is the bound, the full one the error.\n\
         A mark is filled where the verdict agrees, hollow where nothing is proven, crossed where it disagrees; what fails \
         stands in the strip above.\n",
        tally.verdict()
    );
    for (family, outcomes) in families {
        put!(
            text,
            "\n## {}\n\n{}.\nDial: {}.\n\n| | agrees at | not | positions | rates | forces | over bound | widest bound |\n|---|---|---|---|---|---|---|---|\n",
            family.name,
            capital(family.title),
            family.dial
        );
        for name in names(outcomes) {
            let [agrees, others, positions, rates, forces, used, widest] = cells(outcomes, name);
            say!(text, "| {name} | {agrees} | {others} | {positions} | {rates} | {forces} | {used} | {widest} |");
        }
        for own in outcomes.iter().filter(|own| !own.refused.is_empty()) {
            say!(text, "\nAt {}: {}.", super::summary::dial(own.dial), own.refused);
        }
        say!(text, "\n![{}]({maps}/{}.svg)", family.name, family.name);
    }
    text
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}
