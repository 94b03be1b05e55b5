//! Judgements of formulas as text and JSON.

use std::fmt::Write;

use serde_json::{Value, json};

use super::cells::table;
use super::pretty::pretty;
use super::tell::Tell;
use crate::claims::{At, Cause, Judged, Missing, Outcome, Term, WORDS};
use crate::compare::Verdict;
use crate::proof::claimed::Claimed;
use crate::scenario::{Formula, Scenario};

/// One claim, by value or by a derivative: the side that it fits worse.
struct Line<'a> {
    side: &'static str,
    formula: &'a Formula,
    judged: &'a Judged,
}

impl Line<'_> {
    fn rank(&self) -> (u8, f64) {
        let rank = match self.judged.outcome() {
            Outcome::Right => 0,
            Outcome::Open { .. } => 1,
            Outcome::Wrong => 2,
        };
        (rank, self.judged.worst.map_or(0.0, |worst| worst.used()))
    }

    fn word(&self) -> &'static str {
        match self.judged.outcome() {
            Outcome::Right => "right",
            Outcome::Open { .. } => "open",
            Outcome::Wrong => "WRONG",
        }
    }

    fn name(&self) -> String {
        match self.judged.order {
            0 => self.judged.name.clone(),
            order => format!("  its {}", WORDS[order]),
        }
    }
}

fn lines<'a>(scenario: &'a Scenario, claimed: &'a Claimed) -> Vec<Line<'a>> {
    let [first, second] = &claimed.judgement.sides;
    let mut lines = Vec::new();
    for (own, other) in first.1.iter().zip(&second.1) {
        let formula = scenario.formulas.list.iter().find(|formula| formula.name == own[0].name);
        let formula = formula.expect("only the scenario's formulas are judged");
        for (own, other) in own.iter().zip(other) {
            let [own, other] = [(first.0, own), (second.0, other)].map(|(side, judged)| Line { side, formula, judged });
            let worse = other.rank().0 > own.rank().0;
            lines.push(if worse { other } else { own });
        }
    }
    lines
}

/// The report: the verdict, a line for each claim and derivative, and what is wrong.
#[must_use]
pub fn text(scenario: &Scenario, claimed: &Claimed, tell: Tell) -> String {
    let lines = lines(scenario, claimed);
    let mut text = format!("{}\n", sentence(&lines, claimed));
    let mut table = table(["formula", "claim", "crank deg", "difference", "bound", "verdict"], &[2, 3, 4]);
    for line in &lines {
        let worst = line.judged.worst;
        table.add_row([
            line.name(),
            if line.judged.order == 0 { line.judged.claim.clone() } else { String::new() },
            worst.map_or(String::new(), |at| format!("{:.1}", at.crank.to_degrees())),
            worst.map_or(String::new(), |at| format!("{:.1e} {}", at.difference, line.judged.unit)),
            worst.map_or(String::new(), |at| format!("{:.1e}", at.bound)),
            line.word().into(),
        ]);
    }
    let _ = writeln!(text, "\n{table}");
    let has_wrong_value =
        |name: &str| lines.iter().any(|line| line.judged.order == 0 && line.judged.name == name && line.rank().0 == 2);
    // The derivatives of a wrong value say nothing more.
    let told = |line: &&Line| line.rank().0 > 0 && (line.judged.order == 0 || !has_wrong_value(&line.judged.name));
    for line in lines.iter().filter(told) {
        let _ = writeln!(text, "\n{}", reason(line, tell));
        if line.judged.order > 0 {
            continue;
        }
        match cause(claimed, &line.judged.name) {
            Some(Some(found @ (Cause::Leaves { .. } | Cause::Mostly { .. }))) => {
                let _ = writeln!(text, "  cause  {found}.");
            }
            Some(Some(found)) => {
                let _ = writeln!(text, "  cause  {found}.\n         With that, nothing is left over.");
            }
            Some(None) => {
                let _ =
                    writeln!(text, "  cause  none that is simple: no single slip, offset, factor or term explains it.");
            }
            None => {}
        }
    }
    for check in &claimed.checks {
        if let Some(reason) = check.verdict.reason(tell) {
            let _ = writeln!(text, "\n{}: {reason}", check.name());
        }
    }
    text
}

/// The cause of a wrong formula, if it is wrong, and if there is a simple one.
fn cause<'a>(claimed: &'a Claimed, name: &str) -> Option<Option<&'a Cause>> {
    claimed.judgement.causes.iter().find(|(own, _)| own == name).map(|(_, cause)| cause.as_ref())
}

fn sentence(lines: &[Line], claimed: &Claimed) -> String {
    let claims = lines.iter().filter(|line| line.judged.order == 0).count();
    let instants = lines.iter().map(|line| line.judged.judged).max().unwrap_or(0);
    let plural = |count: usize, word: &str| format!("{count} {word}{}", if count == 1 { "" } else { "s" });
    let [first, second] = [0, 1].map(|side| claimed.judgement.sides[side].0);
    let wrong = lines.iter().filter(|line| line.rank().0 == 2);
    let mut names: Vec<&str> = wrong.map(|line| line.judged.name.as_str()).collect();
    names.dedup();
    match &claimed.verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => {
            let (claims, instants) = (plural(claims, "formula"), plural(instants, "instant"));
            format!("AGREE: {claims}, at {instants}, against {first} and {second}.")
        }
        Verdict::Disagree { .. } if names.is_empty() => {
            format!("DISAGREE: {first} and {second} contradict each other; nothing is proven of the formulas.")
        }
        Verdict::Disagree { .. } => {
            format!("DISAGREE: {} of {} wrong: {}.", names.len(), plural(claims, "formula"), names.join(", "))
        }
        Verdict::Inconclusive { .. } => "INCONCLUSIVE: something proves nothing either way.".into(),
    }
}

fn reason(line: &Line, tell: Tell) -> String {
    let Judged { claim, unit, order, .. } = line.judged;
    let of = match order {
        0 => String::new(),
        order => format!("the {} of ", WORDS[*order]),
    };
    match line.judged.outcome() {
        Outcome::Right => String::new(),
        Outcome::Open { reason, advice } => {
            let advice: Vec<String> = advice.iter().map(tell).collect();
            format!("{of}{}: {reason}; {}", line.judged.name, advice.join(", or "))
        }
        Outcome::Wrong => {
            let mut text =
                format!("{of}{} = {}\n  is not {of}{claim} ({})", line.judged.name, line.formula.text, line.side);
            let says = |word: &str, at: At| {
                let place = format!("crank angle {:.3} deg, t = {:.6} s", at.crank.to_degrees(), at.time);
                let found = if at.formula.is_nan() { "no value".into() } else { number(at.formula, unit) };
                format!("\n  {word:6} {place}: formula {found}, mechanism {}", number(at.mechanism, unit))
            };
            if let (Some(since), Some(worst)) = (line.judged.since, line.judged.worst) {
                text += &says("first", since);
                if worst != since {
                    text += &says("worst", worst);
                }
            }
            text
        }
    }
}

fn number(value: f64, unit: &str) -> String {
    let size = value.abs();
    let number =
        if size != 0.0 && !(1e-3..1e6).contains(&size) { format!("{value:.6e}") } else { format!("{value:.6}") };
    format!("{number} {unit}").trim_end().to_string()
}

fn cause_json(cause: &Cause) -> Value {
    let words = cause.to_string();
    match cause {
        Cause::Slip(slip) => json!({
            "kind": slip.kind.words(), "in": slip.formula, "written": slip.written, "right": slip.right,
            "everywhere": slip.everywhere, "words": words,
        }),
        Cause::Offset(offset) => json!({ "kind": "an offset", "offset": offset, "words": words }),
        Cause::Factor(factor) => json!({ "kind": "a factor", "factor": factor, "words": words }),
        Cause::Missing(Missing { formula, beside, what, is_factor }) => json!({
            "kind": if *is_factor { "a missing factor" } else { "a missing term" },
            "in": formula, "beside": beside, "missing": what, "words": words,
        }),
        Cause::Terms(terms) => {
            let term = |term: &Term| json!({ "coefficient": term.coefficient, "factor": term.factor, "of": term.of });
            json!({ "kind": "missing terms", "terms": terms.iter().map(term).collect::<Vec<_>>(), "words": words })
        }
        Cause::Mostly { cause, left } => {
            json!({ "kind": "for the most part", "cause": cause_json(cause), "left": left, "words": words })
        }
        Cause::Leaves { after, before } => json!({
            "kind": "another branch", "after_deg": after.to_degrees(), "before_deg": before.to_degrees(), "words": words,
        }),
    }
}

/// The judgement as JSON, schema 1. Numbers that are not finite are `null`.
#[must_use]
pub fn json(scenario: &Scenario, claimed: &Claimed, tell: Tell) -> String {
    let at = |at: &At| {
        json!({
            "time_s": at.time, "crank_deg": at.crank.to_degrees(), "formula": at.formula, "mechanism": at.mechanism,
            "difference": at.difference, "bound": at.bound,
        })
    };
    let of = |(side, all): &(&'static str, Vec<Vec<Judged>>)| -> Vec<Value> {
        let judged = all.iter().flatten();
        let row = |judged: &Judged| {
            let formula = scenario.formulas.list.iter().find(|formula| formula.name == judged.name);
            json!({
                "side": side, "formula": judged.name, "expression": formula.map(|formula| formula.text.as_str()),
                "source": formula.and_then(|formula| formula.source.as_deref()), "claim": judged.claim,
                "unit": judged.unit, "derivative": judged.order, "claimed_error": formula.and_then(|own| own.error),
                "verdict": match judged.outcome() {
                    Outcome::Right => "agree",
                    Outcome::Open { .. } => "inconclusive",
                    Outcome::Wrong => "disagree",
                },
                "cause": cause(claimed, &judged.name).flatten().map(cause_json),
                "judged": judged.judged, "lost": judged.lost, "undefined": judged.undefined,
                "scale": judged.scale,
                "first": judged.since.as_ref().map(at), "worst": judged.worst.as_ref().map(at),
            })
        };
        judged.map(row).collect()
    };
    let checks = claimed.checks.iter();
    let checks: Vec<Value> = checks
        .map(|check| {
            json!({
                "check": check.name(), "value": check.value, "bound": check.bound, "verdict": check.verdict.word(),
                "reason": check.verdict.reason(tell),
            })
        })
        .collect();
    let rows: Vec<Value> = claimed.judgement.sides.iter().flat_map(of).collect();
    pretty(&json!({
        "schema": 1, "scenario": scenario.name, "verdict": claimed.verdict.word(), "formulas": rows, "checks": checks,
    }))
}
