//! Planted faults: which were found, by which checks, and which were missed.

use crate::sentences;
use serde_json::{Value, json};

use super::pretty::{list, pretty};
use crate::plain::cells::{marked, table, trimmed, worded};

use lab::mutate::{
    FaultCounts, FaultKind, FaultTally, FaultyParty, FaultyProof, Mutant, Mutated, Plant, Share, Sight, Spoiled, all,
    tally,
};
use linkage::input::Input;
use linkage::math::KeepNan;

/// The result as text, the verdict first.
pub(crate) fn text(found: &[Mutated]) -> String {
    let tally = tally(found);
    let mut text = format!("{}\n\n", headline(&tally));
    for one in found.iter().filter(|one| !one.instead.is_empty()) {
        let (name, instead) = (&one.scenario, one.instead.join(", "));
        let formulas = if one.formulas == 0 { sentences::NO_FORMULA_OF_IT_CLAIMS_AN_EXACT } else { "" };
        say!(text, sentences::no_fault_of_the_kinds_asked(&name, &instead, &formulas));
    }
    say!(text, "{}\n", scenarios(found));
    say!(text, "{}\n", trimmed(table(KINDS).add_rows(kinds(found))));
    say!(text, "{LEGEND}\n");
    for (title, lines) in lists(found, &tally).into_iter().filter(|(_, lines)| !lines.is_empty()) {
        say!(text, "{title}\n  {}\n", lines.join("\n  "));
    }
    text
}

const LEGEND: &str = sentences::LEAST_MARGIN_DIFFERENCE_OVER_ITS_BOUND;

/// One sentence with the summary in capitals, the number of kinds, and how many faults were found.
fn headline(tally: &FaultCounts) -> String {
    let FaultCounts { planted, formulas, trunk_kinds, trunk_found, kinds, .. } = tally;
    if tally.end() == FaultTally::Nothing {
        return sentences::NOTHING_PLANTED_NO_FAULT_OF_THE_KINDS.into();
    }
    let word = match tally.end() {
        FaultTally::AllFound => "ALL FOUND",
        FaultTally::NoneEscapes => "NONE ESCAPES",
        FaultTally::SomeEscape => "SOME ESCAPE",
        FaultTally::TrunkOpen => "SHARED FAULTS NOT FOUND",
        FaultTally::Nothing => "NOTHING PLANTED",
    };
    let mut line = format!("{word}  {} kinds", kinds.len());
    if *planted != Share::default() || *formulas == Share::default() {
        put!(line, "; {}", of_share(planted, sentences::FAULTS_IN_ONE_PARTY));
    }
    if !trunk_kinds.is_empty() {
        let [found, all] = [trunk_found.len(), trunk_kinds.len()];
        put!(line, sentences::in_the_trunk_of_kinds_are_found(&found, &all, &percent(found, all)));
    }
    if *formulas != Share::default() {
        put!(line, "\nformulas: {}", of_share(formulas, "mistakes"));
    }
    line
}

/// How many faults, or mistakes in formulas, were found.
fn of_share(share: &Share, what: &str) -> String {
    let Share { inconclusive, escaped, equivalent, .. } = share;
    let ([found, real], part) = ([share.found(), share.real()], percent(share.found(), share.real()));
    sentences::of_found_inconclusive_escaped_change(&found, &real, &what, &part, &inconclusive, &escaped, &equivalent)
}

fn percent(part: usize, whole: usize) -> String {
    if whole == 0 { "-".into() } else { format!("{:.1} %", 100.0 * part as f64 / whole as f64) }
}

fn scenarios(found: &[Mutated]) -> String {
    let rows = found.iter().map(|one| {
        let FaultCounts { planted, trunk, formulas, .. } = tally(std::slice::from_ref(one));
        let Share { inconclusive, escaped, equivalent, .. } = planted;
        let of_trunk = [trunk.real(), trunk.found(), formulas.real(), formulas.found()];
        let counts = [planted.real(), planted.found(), inconclusive, escaped, equivalent].into_iter().chain(of_trunk);
        [one.scenario.clone(), one.verdict.to_string()].into_iter().chain(counts.map(|count| count.to_string()))
    });
    let header = "scenario | no fault | faults> | found> | undecided> | escaped> | no effect> | shared> | \
                  found outside> | in formulas> | of these found>";
    trimmed(table(header).add_rows(rows))
}

/// Outcome of all planted faults of one kind, in all scenarios.
#[derive(Default)]
struct OfKind {
    sides: Share,
    engine: Share,
    trunk: Share,
    formulas: Share,
    margin: f64,
    /// Sizes above which every fault of the kind is found in all scenarios: the first for faults in a side or a
    /// formula, the second for faults in the engine.
    size: [Option<f64>; 2],
}

fn of_kind(found: &[Mutated], kind: &FaultKind) -> Option<OfKind> {
    let own: Vec<&Mutant> =
        found.iter().flat_map(|one| &one.mutants).filter(|mutant| mutant.kind.name == kind.name).collect();
    if own.is_empty() {
        return None;
    }
    let mut all = OfKind { margin: f64::INFINITY, ..OfKind::default() };
    for mutant in own {
        let (share, size) = match mutant.party {
            FaultyParty::Assur | FaultyParty::Newton => (&mut all.sides, Some(&mut all.size[0])),
            FaultyParty::Engine => (&mut all.engine, Some(&mut all.size[1])),
            FaultyParty::All => (&mut all.trunk, None),
            FaultyParty::Formulas => (&mut all.formulas, Some(&mut all.size[0])),
        };
        share.add(&mutant.outcome);
        if let (Some(size), Some(smallest)) = (size, mutant.smallest) {
            *size = Some(size.map_or(smallest, |most| most.larger(smallest)));
        }
        if mutant.party != FaultyParty::All {
            all.margin = all.margin.smaller(mutant.outcome.margin().unwrap_or(f64::INFINITY));
        }
    }
    Some(all)
}

fn cells(kind: &FaultKind, own: &OfKind) -> [String; 9] {
    let of = |share: &Share| match share.real() {
        0 => "-".into(),
        real => format!("{} of {real}", share.found()),
    };
    let size = |size: Option<f64>| size.map_or("-".into(), |size| format!("{size:.1e}"));
    let margin = if own.margin.is_finite() { format!("{:.1e}", own.margin) } else { "-".into() };
    [
        kind.name.into(),
        kind.family.name().into(),
        of(&own.sides),
        of(&own.engine),
        margin,
        size(own.size[0]),
        size(own.size[1]),
        of(&own.trunk),
        of(&own.formulas),
    ]
}

const KINDS: &str = "kind | family | in a side> | in the engine> | least margin> | side, found down to> | \
                     engine, found down to> | in all parties> | in formulas>";

/// The planted kinds, with their outcomes.
fn kinds(found: &[Mutated]) -> impl Iterator<Item = [String; 9]> {
    all().filter_map(|kind| Some(cells(kind, &of_kind(found, kind)?)))
}

/// Missed faults planted in one party, with the reason.
fn not_found(found: &[Mutated]) -> Vec<String> {
    let mut lines = Vec::new();
    for one in found {
        for mutant in &one.mutants {
            let why = match &mutant.outcome {
                FaultyProof::Inconclusive(reason) => format!("inconclusive: {reason}"),
                FaultyProof::Escaped => sentences::EVERY_COMPARISON_AGREES.into(),
                FaultyProof::Detected { .. } | FaultyProof::Refused(_) | FaultyProof::Equivalent(_) => continue,
            };
            if mutant.party != FaultyParty::All {
                let change = mutant.effect.map_or(String::new(), |change| format!(" (changes {change:.1e})"));
                let (scenario, kind) = (&one.scenario, mutant.kind.name);
                let party = match &mutant.formula {
                    Some(Spoiled { formula, right, wrong }) => sentences::the_formula_for(&formula, &wrong, &right),
                    None => mutant.party.name().into(),
                };
                lines.push(format!("{scenario}: {kind} in {party}{change}: {why}"));
            }
        }
    }
    lines
}

/// Two lists of missed faults, each with a title.
/// The first list has faults in one party, the second has kinds of faults in code that all parties share.
fn lists(found: &[Mutated], tally: &FaultCounts) -> [(&'static str, Vec<String>); 2] {
    [(sentences::NOT_FOUND_IN_ONE_PARTY, not_found(found)), (sentences::OPEN_IN_THE_TRUNK, open(tally))]
}

/// Kinds of faults that have an effect in the shared code but are found in no scenario.
fn open(tally: &FaultCounts) -> Vec<String> {
    let open = all().filter(|kind| tally.trunk_kinds.contains(&kind.name) && !tally.trunk_found.contains(&kind.name));
    open.map(|kind| format!("{}: {}", kind.name, kind.says)).collect()
}

/// All kinds as text.
pub(crate) fn all_kinds(width: Option<usize>) -> String {
    format!(
        "{}\n",
        trimmed(worded("kind | family | where | size> | what is wrong", width).add_rows(all().map(described)))
    )
}

fn described(kind: &FaultKind) -> [String; 5] {
    [
        kind.name.into(),
        kind.family.name().into(),
        place(kind).into(),
        kind.size.map_or(String::new(), |size| size.to_string()),
        kind.says.into(),
    ]
}

fn place(kind: &FaultKind) -> &'static str {
    match kind.plant {
        Plant::Case(_) => "case",
        Plant::Answer(_) => "answer",
        Plant::Formula(_) => "formula",
    }
}

/// All kinds as a table in Markdown.
#[must_use]
pub fn kinds_markdown() -> String {
    let mut text = String::from("| kind | family | where | size | what is wrong |\n|---|---|---|---|---|\n");
    for kind in all() {
        say!(text, "{}", marked(&described(kind)));
    }
    text
}

/// Outcomes of all kinds as a table in Markdown. The numbers of found faults are above it, the missed faults below it.
pub(crate) fn markdown(found: &[Mutated]) -> String {
    let tally = tally(found);
    let mut text = format!("{}.\n\n| {} |\n|{}\n", headline(&tally), KINDS.replace('>', ""), "---|".repeat(9));
    for row in kinds(found) {
        say!(text, "{}", marked(&row));
    }
    for (title, lines) in lists(found, &tally) {
        say!(text, "\n{title}\n");
        lines.iter().for_each(|line| say!(text, "- {line}"));
    }
    text
}

/// The result as JSON, schema 1.
pub(crate) fn json(found: &[Mutated], failures: &[(String, String)]) -> String {
    let tally = tally(found);
    let kinds = list(all().filter(|kind| tally.kinds.contains(&kind.name)), |kind| {
        let (family, place) = (kind.family.name(), place(kind));
        json!({ "name": kind.name, "family": family, "where": place, "size": kind.size, "says": kind.says })
    });
    let scenarios = list(found, |one| {
        json!({
            "scenario": one.scenario, "verdict_without": one.verdict, "engine": one.engine,
            "faults": list(&one.mutants, |own| mutant(own, one.input)), "without_part": one.without, "kinds_instead": one.instead,
            "formulas": one.formulas,
        })
    });
    let open = tally.trunk_kinds.iter().filter(|name| !tally.trunk_found.contains(name)).collect::<Vec<_>>();
    pretty(&json!({
        "schema": 1,
        "figures": {
            "kinds": tally.kinds.len(), "planted": share(&tally.planted), "trunk": share(&tally.trunk),
            "formulas": share(&tally.formulas), "trunk_kinds": tally.trunk_kinds.len(),
            "trunk_kinds_found": tally.trunk_found.len(), "trunk_kinds_open": open,
        },
        "kinds": kinds, "scenarios": scenarios,
        "failures": list(failures, |(file, error)| json!({"file": file, "error": error})),
    }))
}

fn share(share: &Share) -> Value {
    let Share { detected, refused, inconclusive, escaped, equivalent } = *share;
    json!({
        "real": share.real(), "found": share.found(), "detected": detected, "refused": refused,
        "inconclusive": inconclusive, "escaped": escaped, "equivalent": equivalent,
    })
}

fn mutant(mutant: &Mutant, input: Input) -> Value {
    let mut value = json!({
        "kind": mutant.kind.name, "party": mutant.party.name(), "outcome": mutant.outcome.word(),
        "change": mutant.effect, "smallest": mutant.smallest,
    });
    if let Some(Spoiled { formula, right, wrong }) = &mutant.formula {
        value["formula"] = json!({ "name": formula, "right": right, "wrong": wrong });
    }
    match &mutant.outcome {
        FaultyProof::Detected { first, clearest, channels, checks } => {
            value["first"] = sight(first, input);
            value["clearest"] = sight(clearest, input);
            value["channels"] = json!(channels);
            value["checks"] = json!(checks);
        }
        FaultyProof::Refused(reason) | FaultyProof::Inconclusive(reason) => value["reason"] = json!(reason),
        FaultyProof::Escaped | FaultyProof::Equivalent(_) => {}
    }
    value
}

fn sight(sight: &Sight, input: Input) -> Value {
    json!({
        "what": sight.what, "margin": sight.margin,
        "time_s": sight.since.map(|(time, _)| time),
        input.shown_in().1: sight.since.map(|(_, crank)| input.shown(crank)),
    })
}
