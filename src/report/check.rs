//! Results of judged formulas, as text and as JSON.

use crate::sentences;
use std::cmp::Reverse;
use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::pretty::{list, pretty};
use crate::plain::Tell;
use crate::plain::cells::{counted, flush, trimmed};
use crate::plain::formula_blocks::{Line, blocks, grade, is_consequence, is_expected, lines, of, values, wrong_values};
use crate::plain::judged::Grade;
use crate::plain::style::{self, wrapped};
use prover::bounds::Verdict;
use prover::check::{FormulaAtInstant, FormulaCause, JudgedFormula, Missing, Term};
use prover::numbers::{error, fixed};
use prover::run::Reference;
use prover::run::solved::Claimed;
use scenario::{Formula, Scenario};

/// Number of claims that the short report shows with their values.
const WORST: usize = 3;
/// The verdict in one line.
#[must_use]
pub fn verdict_line(scenario: &Scenario, claimed: &Claimed) -> String {
    let told = sentence(&lines(&scenario.formulas, &claimed.judgement), claimed);
    format!("{}: {}: {told}", scenario.name, style::verdict(&claimed.verdict))
}

/// The short report, in lines of at most `width` columns.
/// The report has the verdict, the formulas with the largest errors relative to their bounds, and the faults.
#[must_use]
pub fn brief(scenario: &Scenario, claimed: &Claimed, tell: Tell, width: usize) -> String {
    let lines = lines(&scenario.formulas, &claimed.judgement);
    let wrong = wrong_values(&lines);
    let is_told =
        |line: &&Line| line.judged.worst.is_some() && !is_consequence(&wrong, line) && !is_expected(line.judged);
    let mut worst: Vec<(&Line, FormulaAtInstant)> =
        lines.iter().filter(is_told).filter_map(|line| Some((line, line.judged.worst?))).collect();
    worst.sort_by(|(_, a), (_, b)| b.used().total_cmp(&a.used()));
    worst.sort_by_key(|(line, _)| Reverse(line.grade));
    let rows = worst.into_iter().take(WORST).map(|(line, at)| {
        let [found, right] = values(at);
        let name = format!("{}{}", of(line.judged.order), line.judged.name);
        let [off, bound] = [at.difference.abs(), at.bound].map(error);
        [name, fixed(at.input.shown(at.crank), 1), found, right, off, bound, line.judged.unit.to_string()]
    });
    let at_unit = scenario.case.crank().input.shown_in().0;
    let header = format!("worst formula | at {at_unit}> | formula> | mechanism> | error> | bound> | unit");
    let table = trimmed(flush(&header, Some(width)).add_rows(rows));
    let mut text = format!("{}\n\n{table}\n", verdict_line(scenario, claimed));
    reasons(&lines, scenario, claimed, tell, width, &mut text);
    text
}

/// The whole report: the verdict, a line for each claim and derivative, and the faults.
#[must_use]
pub fn text(scenario: &Scenario, claimed: &Claimed, tell: Tell, width: usize) -> String {
    let lines = lines(&scenario.formulas, &claimed.judgement);
    let at_unit = scenario.case.crank().input.shown_in().0;
    let mut table = flush(&format!("formula | claim | at {at_unit}> | error> | bound> | verdict"), Some(width));
    if let Some(claims) = table.column_mut(1) {
        claims.remove_constraint();
    }
    table.add_rows(lines.iter().map(|line| {
        let numbers =
            |at: FormulaAtInstant| [fixed(at.input.shown(at.crank), 1), error(at.difference.abs()), error(at.bound)];
        let [at, off, bound] = line.judged.worst.map(numbers).unwrap_or_default();
        let claim = if line.judged.order == 0 { line.judged.claim.clone() } else { String::new() };
        let right = if is_expected(line.judged) { "wrong as expected" } else { "right" };
        let word = line.grade.of([right, "undecided", "WRONG"]);
        [line.name(), claim, at, off, bound, word.into()]
    }));
    let mut text = format!("{}\n\n{}\n", verdict_line(scenario, claimed), trimmed(&table));
    reasons(&lines, scenario, claimed, tell, width, &mut text);
    text
}

/// Faults and open points, with their reasons.
fn reasons(lines: &[Line], scenario: &Scenario, claimed: &Claimed, tell: Tell, width: usize, text: &mut String) {
    for block in blocks(lines, (&scenario.formulas, &claimed.judgement), tell, Some(width), true) {
        say!(text, "\n{block}");
    }
    for check in &claimed.checks {
        if let Some(reason) = check.verdict.reason(tell) {
            say!(text, "\n{}", wrapped(&format!("{}: {reason}", check.name()), Some(width), 2));
        }
    }
}

/// The names of the wrong formulas, each with the simple cause of its error; `None` if no simple cause was found.
fn causes(claimed: &Claimed) -> BTreeMap<&str, Option<&FormulaCause>> {
    claimed.judgement.causes.iter().map(|(name, cause)| (name.as_str(), cause.as_ref())).collect()
}

fn sentence(lines: &[Line], claimed: &Claimed) -> String {
    let claims = lines.iter().filter(|line| line.judged.order == 0).count();
    let instants = lines.iter().map(|line| line.judged.judged).max().unwrap_or(0);
    let [first, second] = Reference::ALL.map(Reference::name);
    let wrong = lines.iter().filter(|line| line.grade == Grade::Disagree);
    let mut names: Vec<&str> = wrong.map(|line| line.judged.name.as_str()).collect();
    names.dedup();
    match &claimed.verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => {
            let expected = lines.iter().filter(|line| is_expected(line.judged)).count();
            let (right, instants) = (counted(claims - expected, "formula"), counted(instants, "instant"));
            let claims = match expected {
                0 => sentences::all_right(&right),
                _ => sentences::and_wrong_as_printed(&right, &expected),
            };
            sentences::at_and(&claims, &instants, &first, &second)
        }
        Verdict::Disagree { .. } if names.is_empty() => sentences::and_contradict_each_other(&first, &second),
        Verdict::Disagree { .. } => sentences::of_wrong(&names.len(), &counted(claims, "formula")),
        Verdict::Inconclusive { .. } => sentences::SOMETHING_IS_OPEN.into(),
    }
}

fn cause_json(cause: &FormulaCause) -> Value {
    let term = |term: &Term| json!({ "coefficient": term.coefficient, "factor": term.factor, "of": term.of });
    let mut value = match cause {
        FormulaCause::Slip(slip) => json!({
            "kind": slip.kind.words(), "in": slip.formula, "written": slip.written, "right": slip.right,
            "everywhere": slip.everywhere,
        }),
        FormulaCause::Offset(offset) => json!({ "kind": "an offset", "offset": offset }),
        FormulaCause::Factor(factor) => json!({ "kind": "a factor", "factor": factor }),
        FormulaCause::Missing(Missing { formula, beside, what, is_factor, .. }) => {
            let kind = if *is_factor { sentences::A_MISSING_FACTOR } else { sentences::A_MISSING_TERM };
            json!({ "kind": kind, "in": formula, "beside": beside, "missing": what })
        }
        FormulaCause::Terms(terms) => json!({ "kind": "missing terms", "terms": list(terms, term) }),
        FormulaCause::Several { causes, more } => {
            json!({ "kind": "several", "causes": list(causes, cause_json), "more": more })
        }
        FormulaCause::Other(channel) => json!({ "kind": "another channel", "channel": channel }),
        FormulaCause::Constant => json!({ "kind": "a constant" }),
        FormulaCause::Near { error, share } => json!({ "kind": "nearly right", "error": error, "share": share }),
        FormulaCause::Mostly { cause, left } => {
            json!({ "kind": sentences::FOR_THE_MOST_PART, "cause": cause_json(cause), "left": left })
        }
        FormulaCause::Leaves { after, before } => {
            let [after_key, before_key] =
                ["after", "before"].map(|side| format!("{side}_{}", after.input.shown_in().0));
            let [after, before] = [after, before].map(|at| at.input.shown(at.value));
            json!({ "kind": "another branch", after_key: after, before_key: before })
        }
    };
    value["words"] = cause.to_string().into();
    value
}

/// The judgement as JSON, schema 1. NaN and infinite numbers are `null`.
#[must_use]
pub fn json(scenario: &Scenario, claimed: &Claimed, tell: Tell) -> String {
    let at = |at: &FormulaAtInstant| {
        json!({
            "time_s": at.time, at.input.shown_in().1: at.input.shown(at.crank), "formula": at.formula,
            "mechanism": at.mechanism, "difference": at.difference, "bound": at.bound,
        })
    };
    let causes = causes(claimed);
    let formulas: BTreeMap<&str, &Formula> =
        scenario.formulas.list.iter().map(|formula| (formula.name.as_str(), formula)).collect();
    let no_value = |judged: &JudgedFormula| {
        claimed.judgement.undefined.get(&judged.name).map(|undefined| {
            json!({
                "in": undefined.formula, "written": undefined.written, "from": undefined.fault.at.start,
                "to": undefined.fault.at.end, undefined.input.shown_in().1: undefined.input.shown(undefined.crank),
                "words": undefined.to_string(),
            })
        })
    };
    let row = |side: Reference, judged: &JudgedFormula| {
        let formula = formulas.get(judged.name.as_str());
        let agree = if is_expected(judged) { "expected" } else { "agree" };
        let verdict = grade(judged).of([agree, "inconclusive", "disagree"]);
        json!({
            "side": side.name(), "formula": judged.name, "expression": formula.map(|formula| formula.text.as_str()),
            "source": formula.and_then(|formula| formula.source.as_deref()), "claim": judged.claim,
            "unit": judged.unit, "derivative": judged.order, "claimed_error": formula.and_then(|own| own.error),
            "verdict": verdict, "finding": judged.finding, "cause": causes.get(judged.name.as_str()).copied().flatten().map(cause_json),
            "search_cut": claimed.judgement.unsought.contains(&judged.name), "no_value": no_value(judged),
            "judged": judged.judged, "lost": judged.lost, "undefined": judged.undefined, "scale": judged.scale,
            "first": judged.since.as_ref().map(at), "worst": judged.worst.as_ref().map(at),
        })
    };
    let sides = claimed.judgement.sides.iter();
    let rows = sides
        .flat_map(|(side, all)| all.iter().flatten().map(move |judged| (side, judged)))
        .map(|(side, judged)| row(side, judged));
    let checks = list(&claimed.checks, |check| {
        json!({
            "check": check.name(), "value": check.value, "bound": check.bound, "verdict": check.verdict.word(),
            "reason": check.verdict.reason(tell),
        })
    });
    pretty(&json!({
        "schema": 1, "scenario": scenario.name, "verdict": claimed.verdict.word(),
        "formulas": rows.collect::<Value>(), "checks": checks,
    }))
}
