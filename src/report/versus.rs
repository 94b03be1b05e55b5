//! Comparisons of two parties as text and JSON.

use std::path::Path;

use serde_json::{Value, json};

use super::diagnosis_json;
use super::pretty::pretty;
use crate::plain::cells::{flush, trimmed};
use crate::plain::diagnosis;
use crate::plain::style::{self, Detail};
use crate::plain::tell::Tell;
use linkage::math::KeepNan;
use prover::claims::Cause;

use prover::compare::Verdict;

use prover::numbers;

use prover::versus::{Compared, Comparison, Contradiction, Explained, Pair, Row};

/// Channels of agreeing pairs that a short report shows.
const SHOWN: usize = 3;
/// Share of the other number below which one is nothing.
const NOTHING: f64 = 1e-4;
/// Names that are listed; the others are counted.
const NAMED: usize = 3;

/// The report in lines of at most `width` columns: the verdict, the channels that use most of their bounds, and why
/// others are off.
#[must_use]
pub fn text(paths: [&Path; 2], comparison: &Comparison, detail: Detail, tell: Tell, width: usize) -> String {
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

fn of_pair(pair: &Pair, all: bool, tell: Tell, width: usize) -> String {
    let mut text = String::new();
    let mut order: Vec<&Compared> = pair.channels.iter().collect();
    order.sort_by(|a, b| rank(b).total_cmp(&rank(a)));
    let shown = if all { order.len() } else { SHOWN.min(order.len()) };
    let at = if pair.by_crank { "at deg" } else { "at s" };
    let header = ["channel", at, "first", "second", "difference", "bound", ""];
    let mut table = flush(header, &[1, 2, 3, 4, 5], Some(width));
    for own in &order[..shown] {
        table.add_row(row(own, pair.by_crank));
    }
    let mut told = trimmed(&table);
    let more = order.len() - shown;
    if more > 0 {
        let is_fine = order[shown..].iter().all(|own| rank(own) <= 1.0);
        put!(told, "\nand {more} more{}", if is_fine { ", all within their bounds" } else { "" });
    }
    told += &notes(pair);
    say!(text, "\n{told}");
    let paragraph = |text: &mut String, told: &str| {
        say!(text, "\n{}", style::wrapped(told, Some(width), 2));
    };
    for own in order.iter().filter(|own| matches!(own.verdict, Verdict::Inconclusive { .. })).take(SHOWN) {
        paragraph(&mut text, &format!("{}: {}", own.claim.text, own.verdict.reason(tell).unwrap_or_default()));
    }
    for explained in &pair.causes {
        say!(text, "\n{}", cause(pair, explained, width));
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

fn row(own: &Compared, by_crank: bool) -> [String; 7] {
    let [at, first, second, difference, bound] = own.worst.map_or_else(Default::default, |at| {
        let when = if by_crank { numbers::fixed(at.crank.to_degrees(), 2) } else { numbers::fixed(at.time, 6) };
        // An angle may differ by whole turns, which nobody counts as a difference. What is allowed hides no digits: only
        // what is known to be rounding, and is nothing beside the other, is zero.
        let values = [at.values[0], if at.difference.is_nan() { at.values[1] } else { at.values[0] + at.difference }];
        let largest = values[0].abs().larger_number(values[1].abs());
        let [first, second] = numbers::beside(values, at.known.smaller_number(NOTHING * largest));
        [when, first, second, numbers::error(at.difference), numbers::error(at.bound)]
    });
    [own.claim.text.clone(), at, first, second, difference, bound, word(&own.verdict).into()]
}

const SIMULATION: &str = "The rest is off by less than a fiftieth of its scale, as by the error of a method or of its \
                          step. Bounds are what digits and the analytic sides leave open: say what the other party is \
                          trusted to.";

/// Whether a channel is off by as little as a simulation is wrong, and no cause was found.
fn looks_like_a_simulation(pair: &Pair, own: &Compared) -> bool {
    let is_explained = pair.causes.iter().any(|cause| cause.of.contains(&own.claim.text));
    own.is_derived && own.since.is_some() && !own.is_gross() && !is_explained
}

/// Which two are compared.
pub(super) fn who(paths: [&Path; 2], pair: &Pair) -> String {
    let [first, second] = [0, 1].map(|side: usize| match pair.names[side].as_str() {
        "" => paths[side].display().to_string(),
        own => format!("{} ({own})", paths[side].display()),
    });
    format!("{second} against {first}")
}

fn sentence(paths: [&Path; 2], pair: &Pair) -> String {
    let count = |word: &str| pair.channels.iter().filter(|own| own.verdict.word() == word).count();
    let [agree, disagree, open] = ["agree", "disagree", "inconclusive"].map(count);
    let word = style::verdict(&pair.verdict());
    let all = pair.channels.len();
    let verdict = match (disagree, open, pair.crank_is_off()) {
        (0, 0, false) => format!("{word}: all {agree} channels"),
        (0, 0, true) => format!("{word}: the crank angle, and none of {all} channels"),
        (0, open, false) => format!("{word}: {open} of {all} channels"),
        (disagree, _, is_off) => {
            format!("{word}: {}{disagree} of {all} channels", if is_off { "the crank angle, and " } else { "" })
        }
    };
    let by = if pair.by_crank { "crank angle" } else { "time" };
    let count = pair.instants - pair.unshared;
    let several = if count == 1 { "" } else { "s" };
    let values = match pair.values() {
        [1, 1] => "1 value".to_string(),
        [judged, of] if judged == of => format!("{judged} values"),
        [judged, of] => format!("{judged} of {of} values"),
    };
    format!("{verdict} at {count} {by}{several}, {values}: {}", who(paths, pair))
}

fn rank(own: &Compared) -> f64 {
    let used = own.worst.map_or(0.0, |at| at.used());
    match own.verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => used.smaller(1.0),
        Verdict::Inconclusive { .. } => 2.0,
        // The gravest first: beyond its bound by most, measured by its own scale.
        Verdict::Disagree { .. } => 3.0 + own.largest.map_or(0.0, |at| at.difference.abs() / own.scale),
    }
}

fn word(verdict: &Verdict) -> &'static str {
    match verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => "",
        Verdict::Disagree { .. } => "OFF",
        Verdict::Inconclusive { .. } => "open",
    }
}

/// What was not compared.
fn notes(pair: &Pair) -> String {
    let mut text = String::new();
    if pair.unshared > 0 {
        put!(text, "\nleft out: {} instants of the second that the first does not have", pair.unshared);
    }
    let missing: usize = pair.channels.iter().map(|own| own.missing).max().unwrap_or(0);
    if missing > pair.unshared {
        let count = missing - pair.unshared;
        put!(text, "\nleft out: up to {count} instants of a channel at which nothing was measured");
    }
    let (what, factor, unit) = if pair.by_crank { ("angle", 1f64.to_degrees(), "deg") } else { ("time", 1.0, "s") };
    if let Some(Contradiction { rows: [one, other], at, channel, values }) = &pair.contradiction {
        let at = numbers::significant(factor * at, 6);
        let [first, second] = numbers::beside(*values, 0.0);
        put!(
            text,
            "\nrows {} and {} hold at the same {what}, {at} {unit}, and contradict each other: {channel} is {first} and \
             {second}",
            one + 1,
            other + 1
        );
    }
    if let Some((row, [from, to])) = pair.turns_back {
        let [from, to] = [from, to].map(|at| numbers::significant(factor * at, 6));
        put!(text, "\nthe {what} jumps back in row {}, from {from} to {to} {unit}: has it begun anew?", row + 1);
    }
    for (side, which) in ["first", "second"].into_iter().enumerate() {
        if !pair.alone[side].is_empty() {
            put!(text, "\nonly in the {which}: {}", some(&pair.alone[side]));
        }
    }
    text
}

/// The first of some names, and how many there are besides.
fn some(names: &[String]) -> String {
    match names.len().saturating_sub(NAMED) {
        0 => names.join(", "),
        more => format!("{} and {more} more", names[..NAMED].join(", ")),
    }
}

fn cause(pair: &Pair, explained: &Explained, width: usize) -> String {
    let Explained { of, diagnosis: found, left, .. } = explained;
    let mut text = style::wrapped(&format!("{}:", some(of)), Some(width), 2);
    let mut line = |what: &str, told: &str| {
        put!(text, "\n{}", style::wrapped(&format!("  {what:<8}{told}"), Some(width), 10));
    };
    if let Some(since) = pair.since(of) {
        let [time, crank] = [numbers::fixed(since.time, 6), numbers::fixed(since.crank.to_degrees(), 3)];
        line("since", &format!("t = {time} s, crank angle {crank} deg"));
    }
    let Some(cause) = cause_of(explained) else {
        line("cause", "nothing simple");
        if let Some(own) = found.nature {
            line("error", &diagnosis::nature(own));
        }
        return text;
    };
    let most = if *left > 0.0 { "for the most part, " } else { "" };
    line("cause", &format!("{most}{cause}"));
    for one in found.also.iter().filter(|_| explained.terms.is_empty()) {
        line("or", &format!("{}, which explains as much", diagnosis::cause(one)));
    }
    let but = explained.but.map_or(String::new(), |time| {
        format!(", but for the row at t = {} s, which is off by itself", numbers::fixed(time, 6))
    });
    line(
        "left",
        &match *left {
            0.0 => format!("nothing beyond the bounds{but}"),
            left => format!("at most {} of the difference{but}", numbers::percent(left)),
        },
    );
    text
}

/// The cause in words, if one was found.
fn cause_of(explained: &Explained) -> Option<String> {
    let terms = (!explained.terms.is_empty()).then(|| Cause::Terms(explained.terms.clone()).to_string());
    terms.or_else(|| explained.diagnosis.cause.as_ref().map(diagnosis::cause))
}

/// The cause in words, or what the error looks like, where that can be told.
#[must_use]
pub fn why(explained: &Explained) -> Option<String> {
    cause_of(explained).or_else(|| explained.diagnosis.nature.map(diagnosis::nature))
}

/// The comparison as JSON, schema 1.
#[must_use]
pub fn json(paths: [&Path; 2], comparison: &Comparison, tell: Tell) -> String {
    let instant = |at: &Row| {
        let crank = if at.crank.is_nan() { Value::Null } else { at.crank.to_degrees().into() };
        let time = if at.time.is_nan() { Value::Null } else { at.time.into() };
        json!({
            "t_s": time, "crank_deg": crank, "first": at.values[0], "second": at.values[1],
            "difference": at.difference, "bound": at.bound, "known": at.known,
        })
    };
    let channel = |own: &Compared| {
        json!({
            "channel": own.claim.text,
            "unit": own.claim.unit(),
            "verdict": own.verdict.word(),
            "reason": own.verdict.reason(tell),
            "instants": own.judged,
            "missing": own.missing,
            "scale": own.scale,
            "rms": own.rms,
            "bound_is": if own.is_derived { "derived" } else { "allowed" },
            "largest": own.largest.as_ref().map(instant),
            "worst": own.worst.as_ref().map(instant),
            "since": own.since.as_ref().map(instant),
        })
    };
    let cause = |own: &Explained| {
        json!({
            "channels": own.of, "cause": cause_of(own), "left_over_share": own.left, "but_for_t_s": own.but, "diagnosis": diagnosis_json::Row::of(&own.diagnosis),
        })
    };
    let pair = |pair: &Pair| {
        json!({
            "first": pair.names[0],
            "second": pair.names[1],
            "by": if pair.by_crank { "crank angle" } else { "time" },
            "instants": pair.instants,
            "unshared": pair.unshared,
            "values": pair.values()[0],
            "jumps_back_in_row": pair.turns_back.map(|(row, _)| row + 1),
            "rows_that_contradict": pair.contradiction.as_ref().map(|own| own.rows.map(|row| row + 1)),
            "only_in_first": pair.alone[0],
            "only_in_second": pair.alone[1],
            "channels": pair.channels.iter().map(channel).collect::<Vec<_>>(),
            "causes": pair.causes.iter().map(cause).collect::<Vec<_>>(),
            "checks": pair.checks.iter().map(|check| json!({
                "name": check.name(), "value": check.value, "bound": check.bound, "verdict": check.verdict.word(),
                "reason": check.verdict.reason(tell),
            })).collect::<Vec<_>>(),
        })
    };
    pretty(&json!({
        "schema": 1,
        "first": paths[0].display().to_string(),
        "second": paths[1].display().to_string(),
        "verdict": comparison.verdict.word(),
        "reason": comparison.verdict.reason(tell),
        "pairs": comparison.pairs.iter().map(pair).collect::<Vec<_>>(),
    }))
}
