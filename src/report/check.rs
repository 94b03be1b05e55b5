//! Results of judged formulas, as text and as JSON.

use crate::sentences;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use super::pretty::{list, pretty};
use crate::plain::Tell;
use crate::plain::cells::{counted, flush, trimmed};
use crate::plain::judged::Grade;
use crate::plain::style::{self, wrapped};
use prover::bounds::{Verdict, place_of_finding};
use prover::check::{CUT, FormulaAtInstant, FormulaCause, FormulaOutcome, JudgedFormula, Missing, Term, WORDS};
use prover::numbers::{beside, error, fixed, input_told, with_unit};
use prover::run::Reference;
use prover::run::solved::Claimed;
use scenario::{Formula, Scenario};

/// Number of claims that the short report shows with their values.
const WORST: usize = 3;
/// Column at which the text below a formula begins.
const INDENT: usize = 9;

/// Grade of a claim.
fn grade(judged: &JudgedFormula) -> Grade {
    match judged.outcome() {
        FormulaOutcome::Right | FormulaOutcome::Expected { .. } => Grade::Agree,
        FormulaOutcome::Open { .. } => Grade::Open,
        FormulaOutcome::Wrong => Grade::Disagree,
    }
}

/// Whether a formula is wrong, as a finding says.
fn is_expected(judged: &JudgedFormula) -> bool {
    matches!(judged.outcome(), FormulaOutcome::Expected { .. })
}

/// One claim, judged by value or by a derivative, and the side that the claim fits worse.
struct Line<'a> {
    side: &'static str,
    formula: &'a Formula,
    judged: &'a JudgedFormula,
    grade: Grade,
}

impl Line<'_> {
    fn name(&self) -> String {
        match self.judged.order {
            0 => self.judged.name.clone(),
            order => format!("  {}", WORDS[order]),
        }
    }
}

fn formulas(scenario: &Scenario) -> BTreeMap<&str, &Formula> {
    scenario.formulas.list.iter().map(|formula| (formula.name.as_str(), formula)).collect()
}

fn lines<'a>(scenario: &'a Scenario, claimed: &'a Claimed) -> Vec<Line<'a>> {
    let [first, second] = claimed.judgement.sides.pair();
    let [one, two] = Reference::ALL.map(Reference::name);
    let formulas = formulas(scenario);
    let both = first.iter().zip(second).flat_map(|(own, other)| own.iter().zip(other));
    let line = |(own, other): (&'a JudgedFormula, &'a JudgedFormula)| {
        let formula = formulas.get(own.name.as_str()).expect("only the scenario's formulas are judged");
        let [own, other] = [(one, own), (two, other)];
        let (side, judged) = if grade(other.1) > grade(own.1) { other } else { own };
        Line { side, formula, judged, grade: grade(judged) }
    };
    both.map(line).collect()
}

/// The verdict in one line.
#[must_use]
pub fn verdict_line(scenario: &Scenario, claimed: &Claimed) -> String {
    let told = sentence(&lines(scenario, claimed), claimed);
    format!("{}: {}: {told}", scenario.name, style::verdict(&claimed.verdict))
}

/// The short report, in lines of at most `width` columns.
/// The report has the verdict, the formulas with the largest errors relative to their bounds, and the faults.
#[must_use]
pub fn brief(scenario: &Scenario, claimed: &Claimed, tell: Tell, width: usize) -> String {
    let lines = lines(scenario, claimed);
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
    reasons(&lines, claimed, tell, width, &mut text);
    text
}

/// The whole report: the verdict, a line for each claim and derivative, and the faults.
#[must_use]
pub fn text(scenario: &Scenario, claimed: &Claimed, tell: Tell, width: usize) -> String {
    let lines = lines(scenario, claimed);
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
    reasons(&lines, claimed, tell, width, &mut text);
    text
}

/// Values of the formula and of the mechanism, with enough digits to differ.
fn values(at: FormulaAtInstant) -> [String; 2] {
    let [found, right] = beside([at.formula, at.mechanism], at.bound);
    [if at.formula.is_nan() { "no value".into() } else { found }, right]
}

/// Names of the formulas that are wrong by value.
fn wrong_values<'a>(lines: &[Line<'a>]) -> BTreeSet<&'a str> {
    let is_wrong_value = |line: &&Line| line.judged.order == 0 && line.grade == Grade::Disagree;
    lines.iter().filter(is_wrong_value).map(|line| line.judged.name.as_str()).collect()
}

/// Whether a derivative is wrong only because the value of its formula is wrong; such a derivative is not
/// reported.
fn is_consequence(wrong: &BTreeSet<&str>, of: &Line) -> bool {
    of.judged.order > 0 && wrong.contains(of.judged.name.as_str())
}

/// Faults and open points, with their reasons.
fn reasons(lines: &[Line], claimed: &Claimed, tell: Tell, width: usize, text: &mut String) {
    let wrong = wrong_values(lines);
    let told = |line: &&Line| (line.grade != Grade::Agree || is_expected(line.judged)) && !is_consequence(&wrong, line);
    let causes = causes(claimed);
    for line in lines.iter().filter(told) {
        say!(text, "\n{}", wrapped(&reason(line, tell), Some(width), INDENT));
        let name = &line.judged.name;
        if line.judged.order > 0 || line.judged.finding.is_some() {
            continue;
        }
        let mut below = |told: &str| say!(text, "{}", wrapped(told, Some(width), INDENT));
        let (undefined, is_cut) = (claimed.judgement.undefined.get(name), claimed.judgement.unsought.contains(name));
        if let Some(undefined) = undefined {
            below(&format!("  but    {undefined}."));
        }
        let Some(cause) = causes.get(name.as_str()) else { continue };
        below(&match cause {
            Some(found) if is_cut => sentences::cause_perhaps_another(&found, &CUT),
            Some(
                found @ (FormulaCause::Leaves { .. }
                | FormulaCause::Mostly { .. }
                | FormulaCause::Near { .. }
                | FormulaCause::Constant),
            ) => {
                format!("  cause  {found}.")
            }
            Some(found) => sentences::cause_with_that_nothing_is_left(&found),
            None if is_cut => sentences::cause_not_found(&CUT),
            None if undefined.is_some() => continue,
            None => sentences::CAUSE_NONE_THAT_IS_SIMPLE.into(),
        });
    }
    for check in &claimed.checks {
        if let Some(reason) = check.verdict.reason(tell) {
            say!(text, "\n{}", wrapped(&format!("{}: {reason}", check.name()), Some(width), 2));
        }
    }
}

/// The simple causes of wrong formulas, by name; `None` if no simple cause was found.
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

fn reason(line: &Line, tell: Tell) -> String {
    let JudgedFormula { claim, unit, order, .. } = line.judged;
    let of = of(*order);
    match line.judged.outcome() {
        FormulaOutcome::Right => String::new(),
        FormulaOutcome::Expected { finding } => {
            sentences::is_wrong_as_the_finding_says(&line.judged.name, &tell(&place_of_finding(&finding)))
        }
        FormulaOutcome::Wrong if line.judged.since.is_none() => {
            let finding = line.judged.finding.as_deref().unwrap_or_default();
            sentences::agrees_although_the_finding(&line.judged.name, &tell(&place_of_finding(finding)))
        }
        FormulaOutcome::Open { reason, advice } => {
            let advice: Vec<String> = advice.iter().map(tell).collect();
            format!("{of}{}: {reason}; {}", line.judged.name, advice.join(", or "))
        }
        FormulaOutcome::Wrong => {
            let mut text = sentences::is_not(&of, &line.judged.name, &line.formula.text, &claim, &line.side);
            let says = |word: &str, at: FormulaAtInstant| {
                let place = sentences::at_instant(&input_told(at.input.at(at.crank), 3), &fixed(at.time, 6));
                let [found, right] = values(at);
                let found = if at.formula.is_nan() { found } else { with_unit(&found, unit) };
                let right = with_unit(&right, unit);
                sentences::formula_mechanism(&word, &place, &found, &right)
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

/// The words before a name that say which derivative is judged.
fn of(order: usize) -> String {
    match order {
        0 => String::new(),
        order => sentences::the_of(&WORDS[order]),
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
        FormulaCause::Missing(Missing { formula, beside, what, is_factor }) => {
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
    let (causes, formulas) = (causes(claimed), formulas(scenario));
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
