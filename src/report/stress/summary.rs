//! Results of the stress families as text. The overall verdict comes first.
//! A table for each family then shows at which parameter values each solver and engine agrees.
//! The page in Markdown has the same tables, each with the map of its family.

use crate::sentences;
use std::collections::BTreeMap;

use linkage::math::KeepNan;
use linkage::math::statistics::distinct;

use super::super::chart::label as dial;
use super::super::chart::label;
use super::super::html::filled;
use crate::plain::cells::{marked, table};
use lab::stress::{PointEnd, QuantityGroup, StressFamily, StressOutcome};

/// Counts over all points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    /// All points that were run.
    pub(crate) points: usize,
    /// Points without results: points that are not valid cases, and points with a panic.
    pub(crate) refused: usize,
    /// Points at which a solver or engine panicked.
    pub(crate) panics: usize,
    /// Results of solvers and engines by verdict, in the order of [`PointEnd::ALL`].
    pub(crate) verdicts: [usize; PointEnd::ALL.len()],
    /// Number of channels that exceed their bounds although no verdict reports this excess.
    pub(crate) silent: usize,
}

impl Tally {
    /// Counts some points.
    pub(crate) fn of<'a>(outcomes: impl Iterator<Item = &'a StressOutcome>) -> Self {
        let mut tally = Tally::default();
        for own in outcomes {
            tally.points += 1;
            tally.panics += usize::from(own.refused == "panic");
            tally.refused += usize::from(!own.refused.is_empty());
            for party in &own.parties {
                tally.verdicts[party.verdict as usize] += 1;
                tally.silent += party.silent;
            }
        }
        tally
    }

    /// The verdict in a sentence.
    pub(crate) fn verdict(&self) -> String {
        let [agree, open, against, fails] = self.verdicts;
        let silent = match self.silent {
            0 => sentences::NO_SILENT_WRONG_NUMBER.to_string(),
            count => format!("{count} SILENT WRONG NUMBERS"),
        };
        let panics = match self.panics {
            0 => "no panic".to_string(),
            count => format!("{count} PANICS"),
        };
        sentences::points_of_results_agree_are_inconclusive(
            &self.points,
            &silent,
            &panics,
            &(self.verdicts.iter().sum::<usize>()),
            &agree,
            &open,
            &against,
            &fails,
            &self.refused,
        )
    }
}

/// The results of families, as text.
pub(crate) fn text(families: &[(&StressFamily, Vec<&StressOutcome>)]) -> String {
    let mut text = String::new();
    let tally = Tally::of(families.iter().flat_map(|(_, all)| all.iter().copied()));
    say!(text, "{}.\n", tally.verdict());
    for (family, outcomes) in families {
        say!(text, "{}: {}\ndial: {}\n{}", family.name, family.title, family.dial, body(outcomes));
    }
    text
}

/// One family: a table of its parties, and the reasons of all results other than agreement.
pub(super) fn body(outcomes: &[&StressOutcome]) -> String {
    let mut found =
        table("| agrees at | otherwise | largest error: positions | rates | forces | over bound> | widest bound>");
    let mut reasons = String::new();
    for name in names(outcomes) {
        let [agrees, others, positions, rates, forces, used, widest] = cells(outcomes, name);
        found.add_row([name.to_string(), agrees, others, positions, rates, forces, used, widest]);
        for (word, at, why) in told(outcomes, name) {
            say!(reasons, "  {name} {word} at {at}: {why}");
        }
    }
    for (at, why) in refused(outcomes) {
        say!(reasons, sentences::no_mechanism_at(&at, &why));
    }
    format!("{found}\n{reasons}")
}

/// Names of all parties, in the order of their occurrence.
pub(super) fn names<'a>(outcomes: &[&'a StressOutcome]) -> Vec<&'a str> {
    distinct(outcomes.iter().flat_map(|own| &own.parties).map(|party| party.name.as_str()))
}

/// Cells of a solver or engine: the parameter values at which it agrees, and those at which it does not agree.
/// Over the points with agreement, the cells show the largest error of each group of quantities, and the largest ratio
/// of error to bound. The last cell is the largest bound; at each point, only the worst channel of each group counts.
pub(super) fn cells(outcomes: &[&StressOutcome], name: &str) -> [String; 7] {
    let mut by_dial: Vec<(f64, PointEnd)> = Vec::new();
    let mut largest: BTreeMap<QuantityGroup, f64> = BTreeMap::new();
    let (mut used, mut widest): (f64, f64) = (0.0, 0.0);
    for own in outcomes {
        let Some(party) = own.parties.iter().find(|party| party.name == name) else { continue };
        match by_dial.last_mut().filter(|(dial, _)| *dial == own.dial) {
            Some((_, worst)) => *worst = party.verdict.max(*worst),
            None => by_dial.push((own.dial, party.verdict)),
        }
        if party.verdict == PointEnd::Agree {
            for own in &party.reached {
                let most = largest.entry(own.group).or_insert(0.0);
                *most = most.larger(own.error);
                used = used.larger(own.used);
                widest = widest.larger(own.bound);
            }
        }
    }
    let stretches = |wanted: PointEnd| stretches(&by_dial, wanted);
    let others = PointEnd::ALL[1..].iter().map(|&end| (end.word(), stretches(end))).filter(|(_, at)| !at.is_empty());
    let others: Vec<String> = others.map(|(word, at)| format!("{word} {at}")).collect();
    let error = |group: QuantityGroup| largest.get(&group).map_or_else(String::new, |error| format!("{error:.1e}"));
    let [positions, rates, forces] = QuantityGroup::ALL.map(error);
    let [used, widest] = [used, widest].map(|value| match largest.is_empty() {
        true => String::new(),
        false => format!("{value:.1e}"),
    });
    [stretches(PointEnd::Agree), others.join("; "), positions, rates, forces, used, widest]
}

/// Ranges of neighbouring parameter values with one verdict, as `1 .. 100`.
fn stretches(by_dial: &[(f64, PointEnd)], wanted: PointEnd) -> String {
    let same = by_dial.chunk_by(|one, next| one.1 == next.1).filter(|own| own[0].1 == wanted);
    let one = |own: &[(f64, PointEnd)]| match own {
        [(only, _)] => dial(*only),
        [(from, _), .., (to, _)] => format!("{} .. {}", dial(*from), dial(*to)),
        [] => String::new(),
    };
    same.map(one).collect::<Vec<_>>().join(", ")
}

/// Parameter values at which a party does not agree, by verdict, with the reason at the first of these values.
fn told(outcomes: &[&StressOutcome], name: &str) -> Vec<(&'static str, String, String)> {
    let mut found: Vec<(&'static str, String, String)> = Vec::new();
    for own in outcomes {
        let Some(party) = own.parties.iter().find(|party| party.name == name) else { continue };
        let word = party.verdict.word();
        if party.verdict != PointEnd::Agree && !found.iter().any(|(known, ..)| *known == word) {
            found.push((word, dial(own.dial), party.why.clone()));
        }
    }
    found
}

/// Points without results, each with its parameter value and the reason.
fn refused<'a>(outcomes: &[&'a StressOutcome]) -> Vec<(String, &'a str)> {
    let own = outcomes.iter().filter(|own| !own.refused.is_empty());
    own.map(|own| (dial(own.dial), own.refused.as_str())).collect()
}

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
