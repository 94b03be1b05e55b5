//! Why a formula is wrong.

use std::fmt;

use super::Course;
use super::dimension::Dimensions;
use super::missing::{Missing, missing};
use super::slips::{Slip, mended};
use super::terms::{self, Term};
use super::trial::Trial;
use crate::numbers::{fixed, significant};
use crate::scenario::Formulas;
use linkage::error::Result;
use linkage::math::KeepNan;

/// The simplest explanation of a wrong formula: with it granted, nothing is left over, unless it says so.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause {
    /// One slip of the pen.
    Slip(Slip),
    /// The same amount too much everywhere, in the unit of the claim.
    Offset(f64),
    /// Too large by the same factor everywhere.
    Factor(f64),
    /// A term or factor of the derivation is missing.
    Missing(Missing),
    /// Terms are missing that the mechanism has.
    Terms(Vec<Term>),
    /// It is right up to a crank angle (rad) and then another branch.
    Leaves {
        /// The last crank angle at which it is right.
        after: f64,
        /// The first at which it is not.
        before: f64,
    },
    /// Nothing simple explains all of it; this explains most.
    Mostly {
        /// What explains most of it.
        cause: Box<Cause>,
        /// Share of the difference that stays over when it is granted.
        left: f64,
    },
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::Slip(Slip { formula, kind, written, right, everywhere }) => {
                let wherever = if *everywhere { " wherever it stands" } else { "" };
                write!(f, "{}, in {formula}: `{right}` instead of `{written}`{wherever}", kind.words())
            }
            Cause::Offset(offset) => write!(f, "{} too much everywhere", significant(*offset, 6)),
            Cause::Factor(factor) => write!(f, "too large by the factor {} everywhere", significant(*factor, 6)),
            Cause::Missing(Missing { formula, beside, what, is_factor }) => {
                let noun = match is_factor {
                    true if what.starts_with('/') => "divisor, or a factor too many",
                    true => "factor",
                    false => "term",
                };
                let beside = beside.as_ref().map_or(String::new(), |part| format!(" beside `{part}`"));
                write!(f, "a missing {noun}, in {formula}: `{what}`{beside}")
            }
            Cause::Terms(terms) => {
                let noun = if terms.len() == 1 { "a missing term" } else { "missing terms" };
                let terms: Vec<String> = terms.iter().map(Term::to_string).collect();
                write!(f, "{noun}, {}", terms.join(" and "))
            }
            Cause::Leaves { after, before } => {
                let [after, before] = [after, before].map(|crank| fixed(crank.to_degrees(), 3));
                write!(
                    f,
                    "another branch: it is right up to crank angle {after} deg, and no longer at {before} deg; \
                     atan2 in place of acos, asin or atan follows it"
                )
            }
            Cause::Mostly { cause, left } => {
                write!(f, "for the most part {cause}; with that, {:.2} % of the difference stays over", 100.0 * left)
            }
        }
    }
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let factor = self.factor.clone().unwrap_or_else(|| significant(self.coefficient, 6));
        let (sign, factor) = factor.strip_prefix('-').map_or(("+", factor.as_str()), |size| ("-", size));
        match self.of.as_str() {
            "" => write!(f, "`{sign} {factor}`"),
            of => write!(f, "`{sign} {factor}*{of}`"),
        }
    }
}

impl Cause {
    /// Whether nothing is left over when it is granted.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        !matches!(self, Cause::Mostly { .. })
    }
}

/// Share of the difference that an explanation may leave and still be told.
const MOST_LEFT: f64 = 0.1;

/// Why the formula called `name` is wrong on a course; `None` if it claims nothing, or nothing simple explains it.
///
/// # Errors
/// If the course lacks a channel of the claim.
pub fn cause(formulas: &Formulas, name: &str, course: &Course) -> Result<Option<Cause>> {
    let Some(index) = formulas.list.iter().position(|own| own.name == name) else { return Ok(None) };
    let Some(claim) = &formulas.list[index].claim else { return Ok(None) };
    let mut trial = Trial::of(formulas, index, claim, course)?;
    let rows = trial.rows();
    let number = of_numbers(&rows);
    let dimensions = Dimensions::of(formulas, index, claim);
    let mut nearest: Option<(f64, Slip)> = None;
    let mut has_sought = false;
    for tried in mended(formulas, index, &dimensions) {
        // What is missing comes before slips whose units do not fit together.
        if !tried.is_sound && !has_sought {
            has_sought = true;
            if let Some(found) = missing(&mut trial, &dimensions, number.is_some()) {
                return Ok(Some(Cause::Missing(found)));
            }
        }
        match trial.left(&tried.changed, 0.0) {
            Some(0.0) => return Ok(Some(Cause::Slip(tried.slip))),
            // A simpler one that leaves hardly more is nearer.
            Some(left) if nearest.as_ref().is_none_or(|(least, _)| left < 0.8 * least) => {
                nearest = Some((left, tried.slip));
            }
            Some(_) | None => {}
        }
    }
    if !has_sought && let Some(found) = missing(&mut trial, &dimensions, number.is_some()) {
        return Ok(Some(Cause::Missing(found)));
    }
    if number.is_some() {
        return Ok(number);
    }
    let terms = terms::of(&trial, course, &dimensions);
    if let Some(found) = terms.as_ref().filter(|found| found.left == 0.0) {
        return Ok(Some(Cause::Terms(found.terms.clone())));
    }
    if let Some(found) = leaves(&rows, formulas.list[index].error.is_none()) {
        return Ok(Some(found));
    }
    let by_slip = nearest.map(|(left, slip)| (left, Cause::Slip(slip)));
    let by_terms = terms.map(|found| (found.left, Cause::Terms(found.terms)));
    let most = [by_slip, by_terms].into_iter().flatten().filter(|(left, _)| *left <= MOST_LEFT);
    let most = most.min_by(|one, other| one.0.total_cmp(&other.0));
    Ok(most.map(|(left, cause)| Cause::Mostly { cause: Box::new(cause), left }))
}

/// Formula and mechanism at an instant: time, crank, formula without whole turns, mechanism, bound.
pub(super) type Row = [f64; 5];

impl Trial<'_> {
    fn rows(&self) -> Vec<Row> {
        let of = |(place, pair): (usize, &super::judged::Pair)| {
            let mechanism = pair.mechanism.value;
            let formula = mechanism + self.difference(pair.formula.value, place);
            [pair.place[0], pair.place[1], formula, mechanism, self.bound(place)]
        };
        self.pairs.iter().enumerate().map(of).collect()
    }
}

/// An offset or a factor, if either is all that is wrong.
fn of_numbers(rows: &[Row]) -> Option<Cause> {
    if rows.len() < 3 || rows.iter().any(|row| !row[2].is_finite()) {
        return None;
    }
    let left = |row: &Row| row[2] - row[3];
    let largest = |column: usize| rows.iter().map(|row| row[column].abs()).fold(0.0, f64::larger);
    // A coefficient that is taken from the numbers themselves is as well known as they are.
    let slack = 8.0 * f64::EPSILON * (largest(2) + largest(3));
    let by = |basis: &dyn Fn(&Row) -> f64| {
        let [above, below] = rows.iter().fold([0.0, 0.0], |[above, below], row| {
            let basis = basis(row);
            [above + basis * left(row), below + basis * basis]
        });
        let coefficient = above / below;
        let fits = rows.iter().all(|row| (left(row) - coefficient * basis(row)).abs() <= 4.0 * row[4] + slack);
        (coefficient.is_finite() && fits).then_some(coefficient)
    };
    let offset = by(&|_| 1.0).map(Cause::Offset);
    offset.or_else(|| by(&|row| row[3]).map(|more| Cause::Factor(1.0 + more)))
}

/// Right up to somewhere, and wrong from there on; an approximation is right by chance where it crosses.
fn leaves(rows: &[Row], is_exact: bool) -> Option<Cause> {
    let mut order: Vec<&Row> = rows.iter().collect();
    order.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let is_right = |row: &&Row| (row[2] - row[3]).abs() <= row[4];
    let right = order.iter().copied().take_while(is_right).count();
    (is_exact && right >= 2 && right < order.len())
        .then(|| Cause::Leaves { after: order[right - 1][1], before: order[right][1] })
}
