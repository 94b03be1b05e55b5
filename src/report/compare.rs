//! Comparisons of two parties as text and JSON.

use crate::sentences;
use std::path::Path;

use serde_json::json;

use super::json::DiagnosisRow;
use super::pretty::{list, pretty};
use crate::plain::cells::{counted, flush, some, trimmed};
use crate::plain::judged::{Grade, counts, grade};
use crate::plain::style::{self, Detail};
use crate::plain::{Tell, diagnosis};
use linkage::input::Input;
use linkage::math::KeepNan;
use prover::bounds::Check;
use prover::check::FormulaCause;
use prover::compare::{Compared, Contradiction, Explained, PartyComparison, RowPair, SidePair};
use prover::numbers;

/// Number of channels shown for a pair in a short report.
const SHOWN: usize = 3;
/// If a number is below its rounding error and below this fraction of the other number, it is shown as zero.
const NOTHING: f64 = 1e-4;
/// Number of names that are listed; further names are only counted.
const NAMED: usize = 3;

/// The report in lines of at most `width` columns. The report has the verdict, the most serious channels, and the
/// reasons of disagreements.
#[must_use]
pub fn text(paths: [&Path; 2], comparison: &PartyComparison, detail: Detail, tell: Tell, width: usize) -> String {
    let mut text = String::new();
    for pair in &comparison.pairs {
        if !text.is_empty() && detail != Detail::Verdict {
            text.push('\n');
        }
        say!(text, "{}", style::wrapped(&sentence(paths, pair), Some(width), 2));
        if detail != Detail::Verdict {
            put!(text, "{}", of_pair(pair, detail == Detail::Whole, tell, width));
        }
    }
    text
}

fn of_pair(pair: &SidePair, all: bool, tell: Tell, width: usize) -> String {
    let mut text = String::new();
    let mut order: Vec<&Compared> = pair.channels.iter().collect();
    order.sort_by(|a, b| rank(b).total_cmp(&rank(a)));
    let shown = if all { order.len() } else { SHOWN.min(order.len()) };
    let at = if pair.by_crank { pair.input.shown_in().0 } else { "s" };
    let header = format!("channel | at {at}> | first> | second> | difference> | bound> |");
    let rows = order[..shown].iter().map(|own| row(own, pair.by_crank.then_some(pair.input)));
    let mut told = trimmed(flush(&header, Some(width)).add_rows(rows));
    let more = order.len() - shown;
    if more > 0 {
        let is_fine = order[shown..].iter().all(|own| rank(own) <= 1.0);
        put!(told, sentences::and_more_6(&more, &(if is_fine { sentences::ALL_WITHIN_THEIR_BOUNDS } else { "" })));
    }
    told += &notes(pair);
    say!(text, "\n{told}");
    let paragraph = |text: &mut String, told: &str| {
        say!(text, "\n{}", style::wrapped(told, Some(width), 2));
    };
    for own in order.iter().filter(|own| grade(&own.verdict) == Grade::Open).take(SHOWN) {
        paragraph(&mut text, &format!("{}: {}", own.claim.text, own.verdict.reason(tell).unwrap_or_default()));
    }
    for explained in &pair.causes {
        say!(text, "\n{}", cause(pair, explained, width));
    }
    if pair.is_search_cut {
        paragraph(&mut text, sentences::THE_SEARCH_OF_A_COMPARISON_ENDED);
    }
    if pair.channels.iter().any(|own| looks_like_a_simulation(pair, own)) {
        paragraph(&mut text, SIMULATION);
    }
    for check in &pair.checks {
        if let Some(reason) = check.verdict.reason(tell) {
            paragraph(&mut text, &format!("{}: {reason}", check.name()));
        }
    }
    text
}

/// The row of a channel; `by` is the input by which the rows are matched, or `None` if they are matched by time.
fn row(own: &Compared, by: Option<Input>) -> [String; 7] {
    let [at, first, second, difference, bound] = own.worst.map_or_else(Default::default, |at| {
        let when = by.map_or_else(|| numbers::fixed(at.time, 6), |input| numbers::fixed(input.shown(at.crank), 2));
        // An angle may differ by whole revolutions, which do not count as a difference, so they are subtracted.
        // A value is shown as zero only if it is rounding error and negligible beside the other value.
        // Allowed differences do not reduce the number of digits shown.
        let values = [at.values[0], if at.difference.is_nan() { at.values[1] } else { at.values[0] + at.difference }];
        let largest = values[0].abs().larger_number(values[1].abs());
        let [first, second] = numbers::beside(values, at.known.smaller_number(NOTHING * largest));
        [when, first, second, numbers::error(at.difference), numbers::error(at.bound)]
    });
    let word = grade(&own.verdict).of(["", "undecided", "OFF"]);
    [own.claim.text.clone(), at, first, second, difference, bound, word.into()]
}

const SIMULATION: &str = sentences::THE_REST_IS_OFF_BY_LESS_THAN_A_FIFTIETH;

/// Whether the error of a channel may be the numerical error of a simulation: the error is small, and no cause was
/// found.
fn looks_like_a_simulation(pair: &SidePair, own: &Compared) -> bool {
    let is_explained = pair.causes.iter().any(|cause| cause.of.contains(&own.claim.text));
    own.is_derived && own.wrong > 0 && !own.is_gross() && !is_explained
}

/// Names of the two compared parties.
pub(super) fn who(paths: [&Path; 2], pair: &SidePair) -> String {
    let [first, second] = [0, 1].map(|side: usize| match pair.names[side].as_str() {
        "" => paths[side].display().to_string(),
        own => format!("{} ({own})", paths[side].display()),
    });
    format!("{second} against {first}")
}

fn sentence(paths: [&Path; 2], pair: &SidePair) -> String {
    let [agree, _, disagree, open] = counts(pair.channels.iter().map(|own| &own.verdict));
    let all = pair.channels.len();
    let told = match (disagree, open, pair.crank_is_off()) {
        (0, 0, false) => sentences::all_channels(&agree),
        (0, 0, true) => sentences::the_input_and_none(&pair.input.noun(), &all),
        (0, open, false) => sentences::of_channels(&open, &all),
        (disagree, _, true) => sentences::the_input_and_of_channels(&pair.input.noun(), &disagree, &all),
        (disagree, _, false) => sentences::of_channels(&disagree, &all),
    };
    let by = counted(pair.instants - pair.unshared, matched_by(pair));
    let values = match pair.values() {
        [judged, of] if judged == of => counted(judged, "value"),
        [judged, of] => sentences::of_values(&judged, &of),
    };
    format!("{}: {told} at {by}, {values}: {}", style::verdict(&pair.verdict()), who(paths, pair))
}

/// The quantity by which the rows are matched.
fn matched_by(pair: &SidePair) -> &'static str {
    if pair.by_crank { pair.input.noun() } else { "time" }
}

fn rank(own: &Compared) -> f64 {
    let used = own.worst.map_or(0.0, |at| at.used());
    match grade(&own.verdict) {
        Grade::Agree => used.smaller(1.0),
        Grade::Open => 2.0,
        // The most serious channels come first: those whose difference, divided by the scale, is largest.
        Grade::Disagree => 3.0 + own.largest.map_or(0.0, |at| at.difference.abs() / own.scale),
    }
}

/// Lines about what was not compared, about rows that contradict each other, and about a row whose time or input jumps
/// back.
fn notes(pair: &SidePair) -> String {
    let mut text = String::new();
    if pair.unshared > 0 {
        put!(text, sentences::left_out_instants_of_the_second(&pair.unshared));
    }
    let missing: usize = pair.channels.iter().map(|own| own.missing).max().unwrap_or(0);
    if missing > pair.unshared {
        let count = missing - pair.unshared;
        put!(text, sentences::left_out_up_to_instants_of_a_channel(&count));
    }
    let undefined: Vec<&Compared> = pair.channels.iter().filter(|own| own.undefined > 0).collect();
    let what = matched_by(pair).rsplit(' ').next().unwrap_or_default();
    let (factor, unit) = if pair.by_crank { (pair.input.shown(1.0), pair.input.shown_in().0) } else { (1.0, "s") };
    for own in undefined.iter().take(SHOWN) {
        let first = own.undefined_since.map_or(f64::NAN, |at| if pair.by_crank { at.crank } else { at.time });
        let first = numbers::significant(factor * first, 6);
        put!(
            text,
            sentences::has_no_number_at(&own.claim.text, &counted(own.undefined, "instant"), &what, &first, &unit)
        );
    }
    if undefined.len() > SHOWN {
        put!(text, sentences::further_channels_have_no_number(&counted(undefined.len() - SHOWN, "channel")));
    }
    if let Some(Contradiction { rows: [one, other], at, channel, values }) = &pair.contradiction {
        let at = numbers::significant(factor * at, 6);
        let [first, second] = numbers::beside(*values, 0.0);
        put!(
            text,
            sentences::rows_and_hold_at_the_same(
                &(one + 1),
                &(other + 1),
                &what,
                &at,
                &unit,
                &channel,
                &first,
                &second
            )
        );
    }
    if let Some((row, [from, to])) = pair.turns_back {
        let [from, to] = [from, to].map(|at| numbers::significant(factor * at, 6));
        put!(text, sentences::the_jumps_back_in_row_from_to_has_it_begun(&what, &(row + 1), &from, &to, &unit));
    }
    for (side, which) in ["first", "second"].into_iter().enumerate() {
        if !pair.alone[side].is_empty() {
            put!(text, sentences::only_in_the(&which, &some(&pair.alone[side], NAMED)));
        }
    }
    text
}

fn cause(pair: &SidePair, explained: &Explained, width: usize) -> String {
    let Explained { of, diagnosis: found, left, .. } = explained;
    let mut text = style::wrapped(&format!("{}:", some(of, NAMED)), Some(width), 2);
    let mut line = |what: &str, told: &str| {
        put!(text, "\n{}", style::wrapped(&format!("  {what:<8}{told}"), Some(width), 10));
    };
    if let Some(since) = pair.since(of) {
        let at = numbers::input_told(pair.input.at(since.crank), 3);
        line("since", &sentences::at_time(&numbers::fixed(since.time, 6), &at));
    }
    let Some(cause) = cause_of(explained) else {
        line("cause", "not found: no simple slip explains it");
        if let Some(own) = found.nature {
            line("error", &diagnosis::nature(own));
        }
        return text;
    };
    let most = if *left > 0.0 { sentences::FOR_THE_MOST_PART_2 } else { "" };
    line("cause", &format!("{most}{cause}"));
    for one in found.also.iter().filter(|_| explained.terms.is_empty()) {
        line("or", &sentences::which_explains_as_much(&diagnosis::cause(one)));
    }
    let but = explained
        .but
        .map_or(String::new(), |time| sentences::but_for_the_row_at_which_is_off(&numbers::fixed(time, 6)));
    line(
        "remains",
        &match *left {
            0.0 => sentences::nothing_beyond_the_bounds(&but),
            left => sentences::at_most_of_the_difference(&numbers::percent(left), &but),
        },
    );
    text
}

/// The cause in words, if there is one.
fn cause_of(explained: &Explained) -> Option<String> {
    let terms = (!explained.terms.is_empty()).then(|| FormulaCause::Terms(explained.terms.clone()).to_string());
    terms.or_else(|| explained.diagnosis.cause.as_ref().map(diagnosis::cause))
}

/// The cause of a difference in words. If no cause was found, the text describes the error; `None` if the error has no
/// description either.
#[must_use]
pub fn why(explained: &Explained) -> Option<String> {
    cause_of(explained).or_else(|| explained.diagnosis.nature.map(diagnosis::nature))
}

/// The comparison as JSON, schema 1.
#[must_use]
pub fn json(paths: [&Path; 2], comparison: &PartyComparison, tell: Tell) -> String {
    // NaN is written as `null`.
    let instant = |at: &RowPair, input: Input| {
        json!({
            "t_s": at.time, input.shown_in().1: input.shown(at.crank), "first": at.values[0], "second": at.values[1],
            "difference": at.difference, "bound": at.bound, "known": at.known,
        })
    };
    let channel = |own: &Compared, input: Input| {
        let instant = |at: &RowPair| instant(at, input);
        json!({
            "channel": own.claim.text, "unit": own.claim.unit(),
            "verdict": own.verdict.word(), "reason": own.verdict.reason(tell),
            "instants": own.judged, "missing": own.missing, "undefined": own.undefined, "scale": own.scale, "rms": own.rms,
            "bound_is": if own.is_derived { "derived" } else { "allowed" },
            "largest": own.largest.as_ref().map(instant), "worst": own.worst.as_ref().map(instant),
            "since": own.since.as_ref().map(instant),
        })
    };
    let cause = |own: &Explained| {
        json!({
            "channels": own.of, "cause": cause_of(own), "left_over_share": own.left, "but_for_t_s": own.but,
            "diagnosis": DiagnosisRow::of(&own.diagnosis),
        })
    };
    let check = |check: &Check| {
        json!({
            "name": check.name(), "value": check.value, "bound": check.bound, "verdict": check.verdict.word(),
            "reason": check.verdict.reason(tell),
        })
    };
    let pair = |pair: &SidePair| {
        json!({
            "first": pair.names[0], "second": pair.names[1], "by": matched_by(pair),
            "instants": pair.instants, "unshared": pair.unshared, "values": pair.values()[0],
            "jumps_back_in_row": pair.turns_back.map(|(row, _)| row + 1),
            "rows_that_contradict": pair.contradiction.as_ref().map(|own| own.rows.map(|row| row + 1)),
            "only_in_first": pair.alone[0], "only_in_second": pair.alone[1],
            "channels": list(&pair.channels, |own| channel(own, pair.input)), "causes": list(&pair.causes, cause),
            "checks": list(&pair.checks, check),
        })
    };
    let [first, second] = paths.map(|path| path.display().to_string());
    pretty(&json!({
        "schema": 1, "first": first, "second": second, "verdict": comparison.verdict.word(),
        "reason": comparison.verdict.reason(tell), "pairs": list(&comparison.pairs, pair),
    }))
}
