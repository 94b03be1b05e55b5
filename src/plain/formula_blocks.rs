//! Wrong and open formulas in words: a block for each formula, with its wrong part, the largest difference and the
//! cause.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::Tell;
use super::judged::Grade;
use super::style::wrapped;
use crate::sentences;
use prover::bounds::place_of_finding;
use prover::check::{CUT, FormulaAtInstant, FormulaCause, FormulaOutcome, JudgedFormula, WORDS};
use prover::numbers::{beside, fixed, input_told, with_unit};
use prover::run::{Judgement, Reference};
use scenario::{Formula, Formulas};

/// Column at which the text below a formula begins.
const INDENT: usize = 9;
/// Largest column at which continuation lines of a formula begin.
const DEEPEST: usize = 24;

/// Grade of a claim.
pub(crate) fn grade(judged: &JudgedFormula) -> Grade {
    match judged.outcome() {
        FormulaOutcome::Right | FormulaOutcome::Expected { .. } => Grade::Agree,
        FormulaOutcome::Open { .. } => Grade::Open,
        FormulaOutcome::Wrong => Grade::Disagree,
    }
}

/// Whether a formula is wrong as expected: a finding says that it is wrong.
pub(crate) fn is_expected(judged: &JudgedFormula) -> bool {
    matches!(judged.outcome(), FormulaOutcome::Expected { .. })
}

/// One claim, judged by value or by a derivative, and the side that the claim fits worse.
pub(crate) struct Line<'a> {
    pub(crate) side: &'static str,
    pub(crate) formula: &'a Formula,
    pub(crate) judged: &'a JudgedFormula,
    pub(crate) grade: Grade,
}

#[cfg(feature = "command")]
impl Line<'_> {
    pub(crate) fn name(&self) -> String {
        match self.judged.order {
            0 => self.judged.name.clone(),
            order => format!("  {}", WORDS[order]),
        }
    }
}

/// Every claim and derivative of a judgement, in the order of the file.
pub(crate) fn lines<'a>(formulas: &'a Formulas, judgement: &'a Judgement) -> Vec<Line<'a>> {
    let [first, second] = judgement.sides.pair();
    let [one, two] = Reference::ALL.map(Reference::name);
    let named: BTreeMap<&str, &Formula> = formulas.list.iter().map(|own| (own.name.as_str(), own)).collect();
    let both = first.iter().zip(second).flat_map(|(own, other)| own.iter().zip(other));
    let line = |(own, other): (&'a JudgedFormula, &'a JudgedFormula)| {
        let formula = named.get(own.name.as_str()).expect("only the scenario's formulas are judged");
        let [own, other] = [(one, own), (two, other)];
        let (side, judged) = if grade(other.1) > grade(own.1) { other } else { own };
        Line { side, formula, judged, grade: grade(judged) }
    };
    both.map(line).collect()
}

/// Values of the formula and of the mechanism, with enough digits to differ.
pub(crate) fn values(at: FormulaAtInstant) -> [String; 2] {
    let [found, right] = beside([at.formula, at.mechanism], at.bound);
    [if at.formula.is_nan() { "no value".into() } else { found }, right]
}

/// Names of the formulas that are wrong by value.
pub(crate) fn wrong_values<'a>(lines: &[Line<'a>]) -> BTreeSet<&'a str> {
    let is_wrong_value = |line: &&Line| line.judged.order == 0 && line.grade == Grade::Disagree;
    lines.iter().filter(is_wrong_value).map(|line| line.judged.name.as_str()).collect()
}

/// Whether a derivative is wrong only because the value of its formula is wrong; such a derivative is not
/// reported.
pub(crate) fn is_consequence(wrong: &BTreeSet<&str>, of: &Line) -> bool {
    of.judged.order > 0 && wrong.contains(of.judged.name.as_str())
}

/// A block for each wrong or open formula among `lines`; a wrong derivative of a wrong formula has no block.
/// `with_findings`: whether formulas that a finding calls wrong have a block too.
pub(crate) fn blocks(
    lines: &[Line],
    (formulas, judgement): (&Formulas, &Judgement),
    tell: Tell,
    width: Option<usize>,
    with_findings: bool,
) -> Vec<String> {
    let wrong = wrong_values(lines);
    let is_told = |line: &&Line| {
        (line.grade != Grade::Agree || with_findings && is_expected(line.judged)) && !is_consequence(&wrong, line)
    };
    lines.iter().filter(is_told).map(|line| block(line, (formulas, judgement), tell, width)).collect()
}

/// Text of one formula: the quantity from which it differs, the instant and the amount of the difference, and the
/// cause.
fn block(line: &Line, (formulas, judgement): (&Formulas, &Judgement), tell: Tell, width: Option<usize>) -> String {
    let name = &line.judged.name;
    let is_value = line.judged.order == 0 && line.judged.finding.is_none() && line.grade == Grade::Disagree;
    let cause = judgement.causes.iter().find(|(own, _)| own == name && is_value).map(|(_, cause)| cause.as_ref());
    let place = cause.flatten().and_then(FormulaCause::place);
    let marks = place.as_ref().filter(|(own, _)| own == name).map_or(&[][..], |(_, marks)| marks);
    let mut text = reason(line, marks, tell, width);
    if !is_value {
        return text;
    }
    let mut below = |told: &str| put!(text, "\n{}", wrapped(told, width, INDENT));
    let (undefined, is_cut) = (judgement.undefined.get(name), judgement.unsought.contains(name));
    if let Some(undefined) = undefined {
        below(&format!("  but    {undefined}."));
    }
    let Some(cause) = cause else { return text };
    let step = place.as_ref().and_then(|(own, _)| formulas.list.iter().find(|step| step.name == *own));
    let told = |cause: &FormulaCause| match step {
        Some(step) if step.name == *name => cause.at_marks(&step.text),
        Some(step) => sentences::in_the_step(&cause.at_marks(&step.text), &step.name),
        None => cause.to_string(),
    };
    below(&match cause {
        Some(found) if is_cut => sentences::cause_perhaps_another(&told(found), &CUT),
        Some(
            found @ (FormulaCause::Leaves { .. }
            | FormulaCause::Mostly { .. }
            | FormulaCause::Near { .. }
            | FormulaCause::Constant),
        ) => {
            format!("  cause  {}.", told(found))
        }
        Some(found) => sentences::cause_with_that_nothing_is_left(&told(found)),
        None if is_cut => sentences::cause_not_found(&CUT),
        None if undefined.is_some() => return text,
        None => sentences::CAUSE_NONE_THAT_IS_SIMPLE.into(),
    });
    if let (Some(step), Some((_, marks))) = (step.filter(|step| step.name != *name), &place) {
        let head = format!("{}{} = ", " ".repeat(INDENT), step.name);
        put!(text, "\n{}", marked(&head, &step.text, marks, width));
    }
    text
}

fn reason(line: &Line, marks: &[Range<usize>], tell: Tell, width: Option<usize>) -> String {
    let JudgedFormula { claim, unit, order, .. } = line.judged;
    let of = of(*order);
    let fit = |told: String| wrapped(&told, width, INDENT);
    match line.judged.outcome() {
        FormulaOutcome::Right => String::new(),
        FormulaOutcome::Expected { finding } => {
            fit(sentences::is_wrong_as_the_finding_says(&line.judged.name, &tell(&place_of_finding(&finding))))
        }
        FormulaOutcome::Wrong if line.judged.since.is_none() => {
            let finding = line.judged.finding.as_deref().unwrap_or_default();
            fit(sentences::agrees_although_the_finding(&line.judged.name, &tell(&place_of_finding(finding))))
        }
        FormulaOutcome::Open { reason, advice } => {
            let advice: Vec<String> = advice.iter().map(tell).collect();
            fit(format!("{of}{}: {reason}; {}", line.judged.name, advice.join(", or ")))
        }
        FormulaOutcome::Wrong => {
            let mut text = marked(&format!("{of}{} = ", line.judged.name), &line.formula.text, marks, width);
            put!(text, "\n{}", fit(sentences::is_not(&of, &claim, &line.side)));
            let mut says = |word: &str, at: FormulaAtInstant| {
                let place = sentences::at_instant(&input_told(at.input.at(at.crank), 3), &fixed(at.time, 6));
                let [found, right] = values(at);
                let found = if at.formula.is_nan() { found } else { with_unit(&found, unit) };
                let right = with_unit(&right, unit);
                put!(text, "\n{}", fit(sentences::formula_mechanism(&word, &place, &found, &right)));
            };
            if let (Some(since), Some(worst)) = (line.judged.since, line.judged.worst) {
                says("first", since);
                if worst != since {
                    says("worst", worst);
                }
            }
            text
        }
    }
}

/// The text `head` and then a formula, in lines of at most `width` columns, with carets below the parts `marks` (byte
/// ranges).
/// Lines are broken at blanks only.
fn marked(head: &str, formula: &str, marks: &[Range<usize>], width: Option<usize>) -> String {
    let indent = head.chars().count().min(DEEPEST);
    let columns = |text: &str| text.chars().count();
    let mut lines: Vec<(String, usize)> = vec![(head.into(), columns(head))];
    let (mut carets, mut at) = (vec![String::new()], 0);
    for word in formula.split_inclusive(char::is_whitespace) {
        let bare = word.trim_end();
        let (line, column) = lines.last_mut().expect("there is a first line");
        if width.is_some_and(|width| *column + columns(bare) > width) && *column > indent {
            *line = line.trim_end().into();
            lines.push((" ".repeat(indent), indent));
            carets.push(String::new());
        }
        let (line, column) = lines.last_mut().expect("there is a first line");
        for (offset, sign) in word.char_indices() {
            if marks.iter().any(|mark| mark.contains(&(at + offset))) {
                let below = carets.last_mut().expect("each line has one");
                *below = format!("{below:<0$}^", *column);
            }
            line.push(if sign.is_whitespace() { ' ' } else { sign });
            *column += 1;
        }
        at += word.len();
    }
    let both = lines.into_iter().zip(carets).flat_map(|((line, _), carets)| [line.trim_end().to_string(), carets]);
    both.filter(|line| !line.is_empty()).collect::<Vec<_>>().join("\n")
}

/// Words for the judged derivative, to be put before the name of the formula.
pub(crate) fn of(order: usize) -> String {
    match order {
        0 => String::new(),
        order => sentences::the_of(&WORDS[order]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::slice::from_ref;

    #[test]
    fn carets_stand_below_the_marked_parts_of_each_line() {
        assert_eq!(marked("x = ", "a + b*c", from_ref(&(2..3)), None), "x = a + b*c\n      ^");
        assert_eq!(marked("x = ", "a + b*c", &[0..1, 6..7], None), "x = a + b*c\n    ^     ^");
        assert_eq!(
            marked("x = ", "aaa + bbb + ccc", from_ref(&(6..9)), Some(9)),
            "x = aaa +\n    bbb +\n    ^^^\n    ccc"
        );
        assert_eq!(marked("x = ", "a +\n b", &[], None), "x = a +  b");
    }
}
