//! Judgements of formulas as text and JSON.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use super::pretty::pretty;
use crate::plain::cells::{flush, trimmed};
use crate::plain::style::{self, wrapped};
use crate::plain::tell::Tell;
use prover::claims::{At, CUT, Cause, Judged, Missing, Outcome, Term, WORDS};
use prover::compare::Verdict;
use prover::numbers::{beside, error, fixed, fixed_in, with_unit};
use prover::proof::Reference;
use prover::proof::solved::Claimed;
use scenario::{Formula, Scenario};

/// Claims that the short report shows with their values.
const WORST: usize = 3;
/// Column at which the text below a formula begins.
const INDENT: usize = 9;

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
            order => format!("  {}", WORDS[order]),
        }
    }
}

fn lines<'a>(scenario: &'a Scenario, claimed: &'a Claimed) -> Vec<Line<'a>> {
    let [first, second] = claimed.judgement.sides.pair();
    let [one, two] = Reference::ALL.map(Reference::name);
    let mut lines = Vec::new();
    let formulas: BTreeMap<&str, &Formula> =
        scenario.formulas.list.iter().map(|formula| (formula.name.as_str(), formula)).collect();
    for (own, other) in first.iter().zip(second) {
        let formula = formulas.get(own[0].name.as_str()).expect("only the scenario's formulas are judged");
        for (own, other) in own.iter().zip(other) {
            let [own, other] = [(one, own), (two, other)].map(|(side, judged)| Line { side, formula, judged });
            let worse = other.rank().0 > own.rank().0;
            lines.push(if worse { other } else { own });
        }
    }
    lines
}

/// The verdict in one line.
#[must_use]
pub fn verdict_line(scenario: &Scenario, claimed: &Claimed) -> String {
    let told = sentence(&lines(scenario, claimed), claimed);
    format!("{}: {}: {told}", scenario.name, style::verdict(&claimed.verdict))
}

/// The short report, in lines of at most `width` columns: the verdict, the formulas that use most of their bounds, and
/// what is wrong.
#[must_use]
pub fn brief(scenario: &Scenario, claimed: &Claimed, tell: Tell, width: usize) -> String {
    let lines = lines(scenario, claimed);
    let wrong = wrong_values(&lines);
    let is_told = |line: &&Line| line.judged.worst.is_some() && !is_consequence(&wrong, line);
    let mut worst: Vec<&Line> = lines.iter().filter(is_told).collect();
    worst.sort_by(|a, b| (b.rank().0, b.rank().1).partial_cmp(&(a.rank().0, a.rank().1)).unwrap_or(Ordering::Equal));
    let header = ["worst formula", "at deg", "formula", "mechanism", "error", "bound", "unit"];
    let mut table = flush(header, &[1, 2, 3, 4, 5], Some(width));
    for line in worst.into_iter().take(WORST) {
        let Some(at) = line.judged.worst else { continue };
        let [found, right] = beside([at.formula, at.mechanism], at.bound);
        let found = if at.formula.is_nan() { "no value".into() } else { found };
        table.add_row([
            format!("{}{}", of(line.judged.order), line.judged.name),
            fixed(at.crank.to_degrees(), 1),
            found,
            right,
            error(at.difference.abs()),
            error(at.bound),
            line.judged.unit.to_string(),
        ]);
    }
    let mut text = format!("{}\n\n{}\n", verdict_line(scenario, claimed), trimmed(&table));
    reasons(&lines, claimed, tell, width, &mut text);
    text
}

/// The whole report: the verdict, a line for each claim and derivative, and what is wrong.
#[must_use]
pub fn text(scenario: &Scenario, claimed: &Claimed, tell: Tell, width: usize) -> String {
    let lines = lines(scenario, claimed);
    let mut table = flush(["formula", "claim", "at deg", "error", "bound", "verdict"], &[2, 3, 4], Some(width));
    if let Some(claims) = table.column_mut(1) {
        claims.remove_constraint();
    }
    for line in &lines {
        let worst = line.judged.worst;
        table.add_row([
            line.name(),
            if line.judged.order == 0 { line.judged.claim.clone() } else { String::new() },
            worst.map_or(String::new(), |at| fixed(at.crank.to_degrees(), 1)),
            worst.map_or(String::new(), |at| error(at.difference.abs())),
            worst.map_or(String::new(), |at| error(at.bound)),
            line.word().into(),
        ]);
    }
    let mut text = format!("{}\n\n{}\n", verdict_line(scenario, claimed), trimmed(&table));
    reasons(&lines, claimed, tell, width, &mut text);
    text
}

/// Names of the formulas that are wrong by value.
fn wrong_values<'a>(lines: &[Line<'a>]) -> BTreeSet<&'a str> {
    let is_wrong_value = |line: &&Line| line.judged.order == 0 && line.rank().0 == 2;
    lines.iter().filter(is_wrong_value).map(|line| line.judged.name.as_str()).collect()
}

/// Whether it is the derivative of a wrong value, which says nothing more.
fn is_consequence(wrong: &BTreeSet<&str>, of: &Line) -> bool {
    of.judged.order > 0 && wrong.contains(of.judged.name.as_str())
}

/// What is wrong or open, and why.
fn reasons(lines: &[Line], claimed: &Claimed, tell: Tell, width: usize, text: &mut String) {
    let wrong = wrong_values(lines);
    let told = |line: &&Line| line.rank().0 > 0 && !is_consequence(&wrong, line);
    let causes = causes(claimed);
    for line in lines.iter().filter(told) {
        say!(text, "\n{}", wrapped(&reason(line, tell), Some(width), INDENT));
        if line.judged.order > 0 {
            continue;
        }
        let undefined = claimed.judgement.undefined(&line.judged.name);
        if let Some(undefined) = undefined {
            say!(text, "{}", wrapped(&format!("  but    {undefined}."), Some(width), INDENT));
        }
        let told = match causes.get(line.judged.name.as_str()) {
            Some(Some(found)) if claimed.judgement.unsought.contains(&line.judged.name) => {
                format!("  cause  {found}.\n         Perhaps another: {CUT}.")
            }
            Some(Some(
                found @ (Cause::Leaves { .. } | Cause::Mostly { .. } | Cause::Near { .. } | Cause::Constant),
            )) => {
                format!("  cause  {found}.")
            }
            Some(Some(found)) => format!("  cause  {found}.\n         With that, nothing is left over."),
            Some(None) if claimed.judgement.unsought.contains(&line.judged.name) => {
                format!("  cause  not found: {CUT}.")
            }
            Some(None) if undefined.is_some() => continue,
            Some(None) => "  cause  none that is simple: no single slip, offset, factor or term explains it.".into(),
            None => continue,
        };
        say!(text, "{}", wrapped(&told, Some(width), INDENT));
    }
    for check in &claimed.checks {
        if let Some(reason) = check.verdict.reason(tell) {
            say!(text, "\n{}", wrapped(&format!("{}: {reason}", check.name()), Some(width), 2));
        }
    }
}

/// The causes of wrong formulas by name, if there are simple ones.
fn causes(claimed: &Claimed) -> BTreeMap<&str, Option<&Cause>> {
    claimed.judgement.causes.iter().map(|(name, cause)| (name.as_str(), cause.as_ref())).collect()
}

fn sentence(lines: &[Line], claimed: &Claimed) -> String {
    let claims = lines.iter().filter(|line| line.judged.order == 0).count();
    let instants = lines.iter().map(|line| line.judged.judged).max().unwrap_or(0);
    let plural = |count: usize, word: &str| format!("{count} {word}{}", if count == 1 { "" } else { "s" });
    let [first, second] = Reference::ALL.map(Reference::name);
    let wrong = lines.iter().filter(|line| line.rank().0 == 2);
    let mut names: Vec<&str> = wrong.map(|line| line.judged.name.as_str()).collect();
    names.dedup();
    match &claimed.verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => {
            let (claims, instants) = (plural(claims, "formula"), plural(instants, "instant"));
            format!("{claims} at {instants}, {first} and {second}")
        }
        Verdict::Disagree { .. } if names.is_empty() => {
            format!("{first} and {second} contradict each other")
        }
        Verdict::Disagree { .. } => {
            format!("{} of {} wrong", names.len(), plural(claims, "formula"))
        }
        Verdict::Inconclusive { .. } => "something is open".into(),
    }
}

fn reason(line: &Line, tell: Tell) -> String {
    let Judged { claim, unit, order, .. } = line.judged;
    let of = of(*order);
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
                let place =
                    format!("crank angle {}, t = {} s", fixed_in(at.crank.to_degrees(), 3, "deg"), fixed(at.time, 6));
                let [found, right] = beside([at.formula, at.mechanism], at.bound).map(|text| with_unit(&text, unit));
                let found = if at.formula.is_nan() { "no value".into() } else { found };
                format!("\n  {word:6} {place}: formula {found}, mechanism {right}")
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

/// Words before the name of what is judged by a derivative.
fn of(order: usize) -> String {
    match order {
        0 => String::new(),
        order => format!("the {} of ", WORDS[order]),
    }
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
        Cause::Several { causes, more } => {
            let all: Vec<Value> = causes.iter().map(cause_json).collect();
            json!({ "kind": "several", "causes": all, "more": more, "words": words })
        }
        Cause::Other(channel) => json!({ "kind": "another channel", "channel": channel, "words": words }),
        Cause::Constant => json!({ "kind": "a constant", "words": words }),
        Cause::Near { error, share } => {
            json!({ "kind": "nearly right", "error": error, "share": share, "words": words })
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
    let causes = causes(claimed);
    let formulas: BTreeMap<&str, &Formula> =
        scenario.formulas.list.iter().map(|formula| (formula.name.as_str(), formula)).collect();
    let of = |(side, all): (Reference, &Vec<Vec<Judged>>)| -> Vec<Value> {
        let judged = all.iter().flatten();
        let row = |judged: &Judged| {
            let formula = formulas.get(judged.name.as_str());
            json!({
                "side": side.name(), "formula": judged.name, "expression": formula.map(|formula| formula.text.as_str()),
                "source": formula.and_then(|formula| formula.source.as_deref()), "claim": judged.claim,
                "unit": judged.unit, "derivative": judged.order, "claimed_error": formula.and_then(|own| own.error),
                "verdict": match judged.outcome() {
                    Outcome::Right => "agree",
                    Outcome::Open { .. } => "inconclusive",
                    Outcome::Wrong => "disagree",
                },
                "cause": causes.get(judged.name.as_str()).copied().flatten().map(cause_json),
                "search_cut": claimed.judgement.unsought.contains(&judged.name),
                "no_value": claimed.judgement.undefined(&judged.name).map(|undefined| json!({
                    "in": undefined.formula, "written": undefined.written, "from": undefined.fault.at.start,
                    "to": undefined.fault.at.end, "crank_deg": undefined.crank.to_degrees(),
                    "words": undefined.to_string(),
                })),
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
