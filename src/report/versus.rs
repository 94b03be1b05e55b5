//! Comparisons of two parties as text and JSON.

use std::fmt::Write;
use std::path::Path;

use serde_json::{Value, json};

use super::cells::table;
use super::diagnosis;
use super::pretty::pretty;
use super::tell::Tell;
use crate::compare::Verdict;
use crate::versus::{Compared, Comparison, Explained, Pair, Row};
use linkage::math::KeepNan;

/// Channels of agreeing pairs that a short report shows.
const SHOWN: usize = 3;
/// Names that are listed; the others are counted.
const NAMED: usize = 3;

/// The report: the verdict, the channels that use most of their bounds, and why others are off. All channels if `all`.
#[must_use]
pub fn text(paths: [&Path; 2], comparison: &Comparison, all: bool, tell: Tell) -> String {
    let mut text = String::new();
    for pair in &comparison.pairs {
        let _ = writeln!(text, "{}", sentence(paths, pair));
        let mut order: Vec<&Compared> = pair.channels.iter().collect();
        order.sort_by(|a, b| rank(b).total_cmp(&rank(a)));
        let shown = if all { order.len() } else { SHOWN };
        let mut table = table(["channel", "at", "first", "second", "difference", "bound", ""], &[1, 2, 3, 4, 5]);
        for own in order.iter().take(shown) {
            let cells = match own.worst {
                None => std::array::from_fn(|_| String::new()),
                Some(at) => [
                    when(&at, pair.by_crank),
                    value(at.values[0], at.bound),
                    value(at.values[1], at.bound),
                    format!("{:.1e}", at.difference),
                    format!("{:.1e}", at.bound),
                ],
            };
            table.add_row([own.claim.text.clone()].into_iter().chain(cells).chain([word(&own.verdict).into()]));
        }
        let _ = writeln!(text, "\n{table}");
        let more = order.len().saturating_sub(shown);
        if more > 0 {
            let worst = if order[shown..].iter().any(|own| rank(own) > 1.0) { "" } else { ", all within their bounds" };
            let _ = writeln!(text, "and {more} more{worst}");
        }
        let _ = write!(text, "{}", notes(pair));
        for own in order.iter().filter(|own| matches!(own.verdict, Verdict::Inconclusive { .. })).take(SHOWN) {
            let _ = writeln!(text, "\n{}: {}", own.claim.text, own.verdict.reason(tell).unwrap_or_default());
        }
        for explained in &pair.causes {
            let _ = writeln!(text, "\n{}", cause(explained));
        }
        if pair.channels.iter().any(|own| looks_like_a_simulation(pair, own)) {
            let _ = writeln!(text, "\n{SIMULATION}");
        }
        for check in &pair.checks {
            if let Some(reason) = check.verdict.reason(tell) {
                let _ = writeln!(text, "\n{}: {reason}", check.name());
            }
        }
        let _ = writeln!(text);
    }
    text
}

const SIMULATION: &str = "\
The rest is off by less than a fiftieth of its scale, as by the error of a
method or of its step. Bounds are what digits and the analytic sides leave
open: say what the other party is trusted to.";

/// Whether a channel is off by as little as a simulation is wrong, and no cause was found.
fn looks_like_a_simulation(pair: &Pair, own: &Compared) -> bool {
    let is_explained = pair.causes.iter().any(|cause| cause.of.contains(&own.claim.text));
    own.is_derived && own.since.is_some() && !own.is_gross() && !is_explained
}

fn sentence(paths: [&Path; 2], pair: &Pair) -> String {
    let name = |side: usize| match pair.names[side].as_str() {
        "" => paths[side].display().to_string(),
        own => format!("{} ({own})", paths[side].display()),
    };
    let count = |word: &str| pair.channels.iter().filter(|own| own.verdict.word() == word).count();
    let [agree, disagree, open] = ["agree", "disagree", "inconclusive"].map(count);
    let verdict = match (disagree, open) {
        (0, 0) => format!("AGREE in all {agree} channels"),
        (0, open) => format!("INCONCLUSIVE in {open} of {} channels", pair.channels.len()),
        (disagree, _) => format!("DISAGREE in {disagree} of {} channels", pair.channels.len()),
    };
    let by = if pair.by_crank { "crank angle" } else { "time" };
    let count = pair.instants - pair.unshared;
    let several = if count == 1 { "" } else { "s" };
    format!("{verdict} at {count} {by}{several}: {} against {}", name(1), name(0))
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

fn when(at: &Row, by_crank: bool) -> String {
    match by_crank {
        true => format!("{:.2} deg", at.crank.to_degrees()),
        false => format!("{:.6} s", at.time),
    }
}

/// A number with the digits that its bound carries.
fn value(value: f64, bound: f64) -> String {
    let size = value.abs().log10().floor();
    let digits = (size - bound.log10().floor() + 1.0).clamp(3.0, 7.0);
    if value.abs() <= 1e-3 * bound {
        return "0".into();
    }
    if !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.*e}", digits as usize - 1);
    }
    format!("{value:.*}", (digits - 1.0 - size).clamp(0.0, 9.0) as usize)
}

/// What was not compared.
fn notes(pair: &Pair) -> String {
    let mut text = String::new();
    if pair.unshared > 0 {
        let _ = writeln!(text, "left out: {} instants of the second that the first does not have", pair.unshared);
    }
    let missing: usize = pair.channels.iter().map(|own| own.missing).max().unwrap_or(0);
    if missing > pair.unshared {
        let _ = writeln!(text, "left out: up to {} instants of a channel without a number", missing - pair.unshared);
    }
    if let Some((row, [from, to])) = pair.turns_back {
        let [what, from, to] = match pair.by_crank {
            true => {
                ["crank angles".into(), format!("{:.2} deg", from.to_degrees()), format!("{:.2} deg", to.to_degrees())]
            }
            false => ["times".to_string(), format!("{from:.6} s"), format!("{to:.6} s")],
        };
        let _ = writeln!(text, "the {what} jump back in row {}, from {from} to {to}: has it begun anew?", row + 1);
    }
    for (side, which) in ["first", "second"].into_iter().enumerate() {
        if !pair.alone[side].is_empty() {
            let _ = writeln!(text, "only in the {which}: {}", some(&pair.alone[side]));
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

fn cause(explained: &Explained) -> String {
    let Explained { of, diagnosis: found, left } = explained;
    let since = found.since.first().map_or(String::new(), |since| {
        format!("\n  since   t = {:.6} s, crank angle {:.3} deg", since.time, since.crank.to_degrees())
    });
    match &found.cause {
        None => format!("{}:{since}\n  cause   nothing simple", some(of)),
        Some(cause) => {
            let left = match *left {
                0.0 => "nothing beyond the bounds".to_string(),
                left => format!("at most {} % of the difference", 100.0 * left),
            };
            format!("{}:{since}\n  cause   {}\n  left    {left}", some(of), diagnosis::cause(cause))
        }
    }
}

/// The comparison as JSON, schema 1.
#[must_use]
pub fn json(paths: [&Path; 2], comparison: &Comparison, tell: Tell) -> String {
    let instant = |at: &Row| {
        let crank = if at.crank.is_nan() { Value::Null } else { at.crank.to_degrees().into() };
        let time = if at.time.is_nan() { Value::Null } else { at.time.into() };
        json!({
            "t_s": time, "crank_deg": crank, "first": at.values[0], "second": at.values[1],
            "difference": at.difference, "bound": at.bound,
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
    let cause = |own: &Explained| json!({ "channels": own.of, "left_over_share": own.left, "diagnosis": diagnosis::row(&own.diagnosis) });
    let pair = |pair: &Pair| {
        json!({
            "first": pair.names[0],
            "second": pair.names[1],
            "by": if pair.by_crank { "crank angle" } else { "time" },
            "instants": pair.instants,
            "unshared": pair.unshared,
            "jumps_back_in_row": pair.turns_back.map(|(row, _)| row + 1),
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
