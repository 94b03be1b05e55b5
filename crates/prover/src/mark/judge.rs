//! Judges the answers of a student, and seeks the cause of every wrong answer.

use super::answers::{StudentAnswers, StudentCell};
use super::cause::{CellPlace, MarkCause};
use super::criterion::MarkCriterion;
use super::hypothesis::Hypothesis;
use super::sheet::AnswerSheet;
use super::{digits, forgotten, parts, rules, worlds};
use linkage::math::KeepNan;

/// The verdict on a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellVerdict {
    /// The answer differs from the right value by at most the allowed difference.
    Right,
    /// The answer differs from the right value by more than the allowed difference.
    Wrong,
    /// The cell has no answer.
    Unanswered,
}

/// A judged cell.
#[derive(Clone, Debug)]
pub struct MarkedCell {
    /// The verdict.
    pub verdict: CellVerdict,
    /// The answer; `None` if the cell has no answer.
    pub answer: Option<StudentCell>,
    /// The right value, in the printed unit.
    pub right: f64,
    /// Largest allowed difference, in the printed unit; zero for a cell without an answer.
    pub allowed: f64,
    /// The likely cause of a wrong answer; `None` if no cause is recognised.
    pub cause: Option<MarkCause>,
}

/// The judged answers of a student, position by position, quantity by quantity.
#[derive(Clone, Debug)]
pub struct MarkedSheet {
    /// The cells.
    pub cells: Vec<Vec<MarkedCell>>,
}

impl MarkedSheet {
    /// Number of cells with this verdict.
    #[must_use]
    pub fn count(&self, verdict: CellVerdict) -> usize {
        self.cells.iter().flatten().filter(|cell| cell.verdict == verdict).count()
    }
}

/// Judges answers. `others` are the sheets of other students, by name. The student may have copied answers of these
/// students.
///
/// # Panics
/// If the answers have other rows or columns than the sheet.
#[must_use]
pub fn marked(
    sheet: &AnswerSheet,
    answers: &StudentAnswers,
    criterion: MarkCriterion,
    others: &[(&str, &AnswerSheet)],
) -> MarkedSheet {
    let cell = |row: usize, column: usize| {
        let right = sheet.right[row][column];
        let Some(answer) = answers[row][column].clone() else {
            let verdict = CellVerdict::Unanswered;
            return MarkedCell { verdict, answer: None, right, allowed: 0.0, cause: None };
        };
        let allowed = criterion.allowed(sheet, row, column, &answer);
        // An answer counts as wrong if it is NaN.
        let is_right = sheet.columns[column].gap(answer.value, right).abs() <= allowed;
        let verdict = if is_right { CellVerdict::Right } else { CellVerdict::Wrong };
        MarkedCell { verdict, answer: Some(answer), right, allowed, cause: None }
    };
    let columns = 0..sheet.columns.len();
    let cells = (0..sheet.right.len()).map(|row| columns.clone().map(|column| cell(row, column)).collect()).collect();
    let mut found = MarkedSheet { cells };
    let wrong: Vec<CellPlace> = places(sheet).filter(|at| found.at(*at).verdict == CellVerdict::Wrong).collect();
    if wrong.is_empty() {
        return found;
    }
    let hypotheses: Vec<Hypothesis> =
        [rules::all(sheet), worlds::all(sheet), forgotten::all(sheet), parts::all(sheet), copied(sheet, others)]
            .into_iter()
            .flatten()
            .collect();
    let search = Search { sheet, criterion, found: &found };
    let matches: Vec<Vec<Vec<Match>>> = hypotheses.iter().map(|own| search.matches(own)).collect();
    let causes: Vec<Option<MarkCause>> =
        wrong.iter().map(|at| search.cause(*at, &hypotheses, &matches, wrong.len())).collect();
    for (at, cause) in wrong.into_iter().zip(causes) {
        found.cells[at.row][at.column].cause = cause;
    }
    found
}

impl MarkedSheet {
    fn at(&self, at: CellPlace) -> &MarkedCell {
        &self.cells[at.row][at.column]
    }
}

fn places(sheet: &AnswerSheet) -> impl Iterator<Item = CellPlace> + use<> {
    let (rows, columns) = (sheet.right.len(), sheet.columns.len());
    (0..rows).flat_map(move |row| (0..columns).map(move |column| CellPlace { row, column }))
}

/// Logarithm of the frequency of copied answers. The value is low, because a number of one of many other sheets may fit
/// by chance.
const COPIED: f64 = -4.0;

fn copied(sheet: &AnswerSheet, others: &[(&str, &AnswerSheet)]) -> Vec<Hypothesis> {
    let is_alike = |other: &&(&str, &AnswerSheet)| {
        let names = |sheet: &AnswerSheet| sheet.columns.iter().map(|own| own.name.clone()).collect::<Vec<_>>();
        names(other.1) == names(sheet) && other.1.right.len() == sheet.right.len()
    };
    let table = |(name, other): &(&str, &AnswerSheet)| {
        let rows = other.right.iter().map(|row| Some(vec![row.clone()])).collect();
        Hypothesis::of_table(MarkCause::OfStudent((*name).into()), COPIED, rows)
    };
    others.iter().filter(is_alike).map(table).collect()
}

/// How a hypothesis fits a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Match {
    /// The cell says nothing about the hypothesis: the cell has no answer, or the hypothesis predicts the right value
    /// or no value.
    Silent,
    /// The answer differs from the predicted number.
    Against,
    /// The answer is the predicted number up to the error of a hand calculation.
    Near,
    /// The answer differs from the predicted number only by rounding.
    Exact,
}

struct Search<'a> {
    sheet: &'a AnswerSheet,
    criterion: MarkCriterion,
    found: &'a MarkedSheet,
}

/// Error of a number that is due to rounded intermediate results, as a fraction of the number.
const ROUNDED: f64 = 1e-3;
/// A cause may leave at most this fraction of the difference between answer and right value unexplained.
const LEFT: f64 = 0.3;
/// A cause is named only if its score is above this value.
const LEAST: f64 = -5.0;
/// Penalty on a cause that gives the number only up to the error of a hand calculation.
const NEARLY: f64 = -2.0;
/// Penalty on a cause if the number has so few digits that many causes lead to this number.
const COARSE: f64 = -1.0;
/// Largest penalty on a cause that other cells contradict. The penalty is doubled for a mistake that changes whole
/// positions.
const ALONE: f64 = -1.5;
/// Score for each further cell with the same cause, and the largest number of further cells that are counted.
const SUPPORT: (f64, usize) = (1.0, 6);

impl Search<'_> {
    fn matches(&self, hypothesis: &Hypothesis) -> Vec<Vec<Match>> {
        let of = |row: usize, column: usize| self.matched(hypothesis, CellPlace { row, column });
        let columns = 0..self.sheet.columns.len();
        (0..self.sheet.right.len()).map(|row| columns.clone().map(|column| of(row, column)).collect()).collect()
    }

    fn matched(&self, hypothesis: &Hypothesis, at: CellPlace) -> Match {
        let (cell, column) = (self.found.at(at), &self.sheet.columns[at.column]);
        let (Some(answer), Some(value)) = (&cell.answer, hypothesis.value(at)) else { return Match::Silent };
        if column.gap(value, cell.right).abs() <= cell.allowed {
            return Match::Silent;
        }
        let gap = column.gap(answer.value, value).abs();
        let explains = gap <= LEFT * column.gap(answer.value, cell.right).abs();
        let share = match self.criterion {
            MarkCriterion::Within(share) => 0.5 * share,
            MarkCriterion::Digits | MarkCriterion::Written => 5.0 * ROUNDED,
        };
        match cell.verdict == CellVerdict::Wrong && explains {
            true if gap <= self.resolution(hypothesis, at, answer, value) => Match::Exact,
            true if gap <= share * value.abs() => Match::Near,
            true | false => Match::Against,
        }
    }

    /// An answer that differs from the predicted value by at most this amount counts as the predicted value.
    fn resolution(&self, hypothesis: &Hypothesis, at: CellPlace, answer: &StudentCell, value: f64) -> f64 {
        let asked = self.sheet.half_unit(at.column) * hypothesis.factor.abs();
        asked.larger(answer.half_unit().smaller(0.02 * value.abs())) + ROUNDED * value.abs()
    }

    /// Of all causes of the wrong cell `at`, the cause with the highest score.
    fn cause(
        &self,
        at: CellPlace,
        hypotheses: &[Hypothesis],
        matches: &[Vec<Vec<Match>>],
        wrong: usize,
    ) -> Option<MarkCause> {
        let cell = self.found.at(at);
        let answer = cell.answer.as_ref()?;
        let mut best: (f64, Option<MarkCause>) = (LEAST, None);
        let mut consider = |score: f64, cause: MarkCause| {
            if score > best.0 {
                best = (score, Some(cause));
            }
        };
        for (hypothesis, matches) in hypotheses.iter().zip(matches) {
            let fit = match matches[at.row][at.column] {
                Match::Exact => 0.0,
                Match::Near => NEARLY,
                Match::Silent | Match::Against => continue,
            };
            let value = hypothesis.value(at).unwrap_or_default();
            let is_coarse = self.resolution(hypothesis, at, answer, value) > 0.03 * value.abs();
            let score = hypothesis.prior
                + fit
                + if is_coarse { COARSE } else { 0.0 }
                + support(at, hypothesis.is_whole, matches);
            let mut cause = hypothesis.cause(at);
            if let MarkCause::OfStudent(_) = cause {
                let fitting = matches.iter().flatten().filter(|own| matches!(own, Match::Exact | Match::Near)).count();
                if fitting < 4 || 2 * fitting < wrong {
                    continue;
                }
            }
            match hypothesis.other_cell(at).filter(|other| self.has_value_of(*other, at)) {
                Some(other) => {
                    cause = MarkCause::Exchanged(other);
                    consider(score.larger(-0.3), cause);
                }
                None => consider(score, cause),
            }
        }
        if let Some((cause, score)) = digits::slip(answer, cell.right, self.sheet.decimals[at.column]) {
            consider(score, cause);
        }
        best.1
    }

    /// Whether the wrong answer in `cell` is the right value of the cell `of`.
    fn has_value_of(&self, cell: CellPlace, of: CellPlace) -> bool {
        let (other, own) = (self.found.at(cell), self.found.at(of));
        let Some(answer) = other.answer.as_ref().filter(|_| other.verdict == CellVerdict::Wrong) else { return false };
        let gap = self.sheet.columns[cell.column].gap(answer.value, own.right).abs();
        gap <= self.sheet.half_unit(cell.column).larger(self.sheet.half_unit(of.column)) + ROUNDED * own.right.abs()
    }
}

/// The part of a cause's score that comes from other cells: the largest of the scores from its row, its column and the
/// whole sheet.
/// The column does not count for a mistake that changes whole positions.
/// The score has a lower limit, because a student may make a mistake in a single cell only.
fn support(at: CellPlace, is_whole: bool, matches: &[Vec<Match>]) -> f64 {
    let score = |cells: &mut dyn Iterator<Item = Match>| {
        let (mut fits, mut against) = (0usize, 0usize);
        for own in cells {
            match own {
                Match::Exact | Match::Near => fits += 1,
                Match::Against => against += 1,
                Match::Silent => {}
            }
        }
        SUPPORT.0 * (fits - 1).min(SUPPORT.1) as f64 - against as f64
    };
    let row = score(&mut matches[at.row].iter().copied());
    let all = score(&mut matches.iter().flatten().copied());
    match is_whole {
        true => row.larger(all).larger(2.0 * ALONE),
        false => score(&mut matches.iter().map(|row| row[at.column])).larger(row).larger(all).larger(ALONE),
    }
}
