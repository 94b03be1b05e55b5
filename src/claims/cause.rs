//! Why a formula is wrong.

use std::fmt;

use super::judged::Pair;
use super::slips::{Slip, mended};
use super::{Course, Judge, Judged, Outcome};
use crate::numbers::{fixed, significant};
use crate::scenario::{Claim, Formula, Formulas};
use formula::Program;
use linkage::error::Result;
use linkage::math::KeepNan;

/// The simplest explanation of a wrong formula: with it granted, nothing is left over.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause {
    /// One slip of the pen.
    Slip(Slip),
    /// The same amount too much everywhere, in the unit of the claim.
    Offset(f64),
    /// Too large by the same factor everywhere.
    Factor(f64),
    /// A term is missing: its coefficient, in the unit of the claim, and its text.
    Term {
        /// Its coefficient.
        coefficient: f64,
        /// Its text.
        term: &'static str,
    },
    /// It is right up to a crank angle (rad) and then another branch.
    Leaves {
        /// The last crank angle at which it is right.
        after: f64,
        /// The first at which it is not.
        before: f64,
    },
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::Slip(Slip { formula, kind, written, right }) => {
                write!(f, "{}, in {formula}: `{right}` instead of `{written}`", kind.words())
            }
            Cause::Offset(offset) => write!(f, "{} too much everywhere", significant(*offset, 6)),
            Cause::Factor(factor) => write!(f, "too large by the factor {} everywhere", significant(*factor, 6)),
            Cause::Term { coefficient, term } => write!(f, "a missing term, {}*{term}", significant(*coefficient, 6)),
            Cause::Leaves { after, before } => {
                let [after, before] = [after, before].map(|crank| fixed(crank.to_degrees(), 3));
                write!(
                    f,
                    "another branch: it is right up to crank angle {after} deg, and no longer at {before} deg; \
                     atan2 in place of acos, asin or atan follows it"
                )
            }
        }
    }
}

/// Instants at which every slip is tried first.
const FIRST: usize = 7;

/// Why the formula called `name` is wrong on a course; `None` if it claims nothing, or nothing simple explains it.
///
/// # Errors
/// If the course lacks a channel of the claim.
pub fn cause(formulas: &Formulas, name: &str, course: &Course) -> Result<Option<Cause>> {
    match formulas.claims().find(|(formula, _)| formula.name == name) {
        Some((formula, claim)) => find(formulas, formula, claim, course),
        None => Ok(None),
    }
}

/// The cause of a formula that a course contradicts; `None` if nothing simple explains it.
///
/// # Errors
/// If the course lacks a channel of the claim.
fn find(formulas: &Formulas, formula: &Formula, claim: &Claim, course: &Course) -> Result<Option<Cause>> {
    let Some(index) = formulas.list.iter().position(|own| own.name == formula.name) else { return Ok(None) };
    let all = course.rows(formula);
    let mut judge = Judge::of_values(formulas, formula, claim);
    let pairs = judge.pairs(course, &all)?;
    let step = all.len().div_ceil(FIRST).max(1);
    // Neither the first instant nor the last alone: much is zero there.
    let few: Vec<usize> = (0..all.len()).skip(step / 2).step_by(step).collect();
    let (mut changed, every): (Formulas, Vec<usize>) = (formulas.clone(), (0..all.len()).collect());
    for tried in mended(formulas, index) {
        let fits = changed.with_tree((tried.index, &tried.tree), index, |graph, id| {
            let mut program = Program::of(graph, &[id]);
            let mut fits = |places: &[usize]| {
                let pairs: Vec<Pair> = places
                    .iter()
                    .map(|&place| Pair { formula: program.run(&course.inputs(all[place]))[0], ..pairs[place] })
                    .collect();
                let judged = Judged::of((formula, claim), 0, claim.turn(), pairs.iter().copied());
                judged.outcome() == Outcome::Right && judged.lost == 0
            };
            fits(&few) && fits(&every)
        });
        if fits == Some(true) {
            return Ok(Some(Cause::Slip(tried.slip)));
        }
    }
    Ok(left_over(formula, claim, &pairs))
}

/// A term's text, and its value at a crank angle (rad) and time (s).
type Term = (&'static str, fn(f64, f64) -> f64);

/// Terms that a derivation loses.
const TERMS: [Term; 6] = [
    ("cos(phi)", |phi, _| phi.cos()),
    ("sin(phi)", |phi, _| phi.sin()),
    ("cos(2*phi)", |phi, _| (2.0 * phi).cos()),
    ("sin(2*phi)", |phi, _| (2.0 * phi).sin()),
    ("phi", |phi, _| phi),
    ("t", |_, t| t),
];

/// What the numbers of a wrong formula say where no slip explains them.
fn left_over(formula: &Formula, claim: &Claim, pairs: &[Pair]) -> Option<Cause> {
    let of = |pair: &Pair| {
        let difference = pair.formula.value - pair.mechanism.value;
        let turns = claim.turn().map_or(0.0, |turn| turn * (difference / turn).round());
        let bound = pair.formula.error + pair.mechanism.error + formula.error.unwrap_or(0.0);
        [pair.place[0], pair.place[1], pair.formula.value - turns, pair.mechanism.value, bound]
    };
    let rows: Vec<[f64; 5]> = pairs.iter().map(of).collect();
    of_numbers(&rows, formula.error.is_none())
}

/// What may be said of a course of formula and mechanism with their bounds, by instants: time, crank, formula,
/// mechanism, bound.
fn of_numbers(rows: &[[f64; 5]], may_leave: bool) -> Option<Cause> {
    if rows.len() < 3 || rows.iter().any(|row| !row[2].is_finite()) {
        return None;
    }
    let left = |row: &[f64; 5]| row[2] - row[3];
    let largest = |column: usize| rows.iter().map(|row| row[column].abs()).fold(0.0, f64::larger);
    // A coefficient that is taken from the numbers themselves is as well known as they are.
    let slack = 8.0 * f64::EPSILON * (largest(2) + largest(3));
    let fits = |explained: &dyn Fn(&[f64; 5]) -> f64| {
        rows.iter().all(|row| (left(row) - explained(row)).abs() <= 4.0 * row[4] + slack)
    };
    let by = |basis: &dyn Fn(&[f64; 5]) -> f64| {
        let [above, below] = rows.iter().fold([0.0, 0.0], |[above, below], row| {
            let basis = basis(row);
            [above + basis * left(row), below + basis * basis]
        });
        let coefficient = above / below;
        (coefficient.is_finite() && fits(&|row| coefficient * basis(row))).then_some(coefficient)
    };
    if let Some(offset) = by(&|_| 1.0) {
        return Some(Cause::Offset(offset));
    }
    if let Some(more) = by(&|row| row[3]) {
        return Some(Cause::Factor(1.0 + more));
    }
    for (term, of) in TERMS {
        if let Some(coefficient) = by(&|row| of(row[1], row[0])) {
            return Some(Cause::Term { coefficient: -coefficient, term });
        }
    }
    // Right up to somewhere, and wrong from there on.
    let mut order: Vec<&[f64; 5]> = rows.iter().collect();
    order.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let is_right = |row: &&[f64; 5]| left(row).abs() <= row[4];
    let right = order.iter().copied().take_while(is_right).count();
    (may_leave && right >= 2 && right < order.len())
        .then(|| Cause::Leaves { after: order[right - 1][1], before: order[right][1] })
}
