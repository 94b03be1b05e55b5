//! The cause of a wrong formula.

use crate::sentences;
use std::collections::BTreeSet;
use std::fmt;
use std::ops::Range;

use super::KnownTrajectory;
use super::dimension::Dimensions;
use super::missing::{Missing, missing};
use super::slips::{self, FormulaMark, FormulaSlip, Mended, SlipKind};
use super::terms::{self, Term};
use super::trial::{MOST_LEFT, Trial};
use crate::numbers::{input_in, input_told, significant, told_apart};
use linkage::error::Result;
use linkage::input::{Input, InputValue};
use linkage::math::KeepNan;
use linkage::math::statistics::distinct;
use scenario::{Claim, Formulas};

/// The simplest explanation of a wrong formula.
/// Unless the description of a variant says otherwise, the whole difference vanishes if this cause is corrected.
#[derive(Clone, Debug, PartialEq)]
pub enum FormulaCause {
    /// One slip in writing.
    Slip(FormulaSlip),
    /// Constant error, in the unit of the claim; positive if the formula's value is too large.
    Offset(f64),
    /// Constant ratio of the formula's value to the mechanism's value.
    Factor(f64),
    /// A term or a factor is missing that consists of inputs, parameters and earlier formulas.
    Missing(Missing),
    /// Terms are missing that contain quantities of the mechanism, such as the angular velocity of a link.
    Terms(Vec<Term>),
    /// The formula is right up to a value of the input. Beyond this value the formula follows a wrong branch.
    Leaves {
        /// Last value of the input at which the formula is right.
        after: InputValue,
        /// First value of the input at which the formula is wrong.
        before: InputValue,
    },
    /// Several causes explain the error equally well. Some of these causes may be missing from the list.
    Several {
        /// The simplest causes.
        causes: Vec<FormulaCause>,
        /// Number of further causes that are left out.
        more: usize,
    },
    /// The formula gives another channel of the mechanism. The text names this channel.
    Other(String),
    /// The formula is constant, but the claimed quantity varies.
    Constant,
    /// The formula is nearly right, but no simple cause explains the error.
    Near {
        /// Largest error, in the unit of the claim.
        error: f64,
        /// Largest error divided by the mechanism's largest value.
        share: f64,
    },
    /// This cause explains most of the error. No simple cause explains the whole error.
    Mostly {
        /// Cause of most of the error.
        cause: Box<FormulaCause>,
        /// Fraction of the difference that remains after the cause is corrected.
        left: f64,
    },
}

impl fmt::Display for FormulaCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FormulaCause::Slip(FormulaSlip { formula, kind, written, right, everywhere, .. }) => {
                let wherever = if *everywhere { sentences::WHEREVER_IT_STANDS } else { "" };
                write!(f, "{}", sentences::in_instead_of(&kind.words(), &formula, &right, &written, &wherever))
            }
            FormulaCause::Offset(offset) if *offset < 0.0 => {
                write!(f, "{}", sentences::too_little_everywhere(&significant(-*offset, 6)))
            }
            FormulaCause::Offset(offset) => write!(f, "{}", sentences::too_much_everywhere(&significant(*offset, 6))),
            FormulaCause::Factor(factor) => {
                write!(f, "{}", sentences::too_large_by_the_factor_everywhere(&told_apart(*factor, 1.0)))
            }
            FormulaCause::Missing(Missing { formula, beside, what, is_factor, .. }) => {
                let noun = match is_factor {
                    true if what.starts_with('/') => sentences::DIVISOR_OR_A_FACTOR_TOO_MANY,
                    true => "factor",
                    false => "term",
                };
                let beside = beside.as_ref().map_or(String::new(), |part| format!(" beside `{part}`"));
                write!(f, "{}", sentences::a_missing_in(&noun, &formula, &what, &beside))
            }
            FormulaCause::Terms(terms) => {
                let noun = if terms.len() == 1 { sentences::A_MISSING_TERM } else { "missing terms" };
                let terms: Vec<String> = terms.iter().map(Term::to_string).collect();
                write!(f, "{noun}, {}", terms.join(" and "))
            }
            FormulaCause::Leaves { after, before } => {
                let (after, before) = (input_told(*after, 3), input_in(*before, 3));
                write!(f, "{}", sentences::another_branch_it_is_right(&after, &before))
            }
            FormulaCause::Several { causes, more } => {
                let told: Vec<String> = causes.iter().map(FormulaCause::to_string).collect();
                write!(f, "{}", sentences::one_of_several_that_fit_equally(&(told.join("; or "))))?;
                if *more > 0 { write!(f, "{}", sentences::or_more(&more)) } else { Ok(()) }
            }
            FormulaCause::Other(channel) => write!(f, "{}", sentences::another_quantity_is_claimed_it_is(&channel)),
            FormulaCause::Constant => write!(f, "{}", sentences::IT_IS_A_CONSTANT_AND_WHAT),
            FormulaCause::Near { error, share } => write!(
                f,
                "{}",
                sentences::no_single_slip_or_term_it_is_right(
                    &significant(100.0 * share, 2),
                    &significant(1.06 * error, 2)
                )
            ),
            FormulaCause::Mostly { cause, left } => {
                write!(f, "{}", sentences::for_the_most_part_with_that_of_the_difference(&cause, &(100.0 * left)))
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

impl FormulaCause {
    /// The formula that contains the cause, and the wrong pieces of its text (byte ranges).
    /// `None` if the cause has no place in a formula.
    #[must_use]
    pub fn place(&self) -> Option<(&str, Vec<Range<usize>>)> {
        match self {
            FormulaCause::Slip(slip) if slip.marks.is_empty() => None,
            FormulaCause::Slip(slip) => Some((&slip.formula, slip.marks.iter().map(|mark| mark.at.clone()).collect())),
            FormulaCause::Missing(missing) => {
                missing.beside.as_ref().map(|_| (missing.formula.as_str(), vec![missing.at.clone()]))
            }
            FormulaCause::Mostly { cause, .. } => cause.place(),
            FormulaCause::Offset(_)
            | FormulaCause::Factor(_)
            | FormulaCause::Terms(_)
            | FormulaCause::Leaves { .. }
            | FormulaCause::Several { .. }
            | FormulaCause::Other(_)
            | FormulaCause::Constant
            | FormulaCause::Near { .. } => None,
        }
    }

    /// The cause in words, for display below a formula text in which the cause is marked. The words repeat only the
    /// marked pieces of text.
    /// `text` is the text of the formula that [`FormulaCause::place`] names.
    #[must_use]
    pub fn at_marks(&self, text: &str) -> String {
        match self {
            FormulaCause::Slip(FormulaSlip { kind, marks, .. }) if !marks.is_empty() => {
                let change = |mark: &FormulaMark| match mark.right.as_str() {
                    // The whole formula is marked and displayed above, so its text is not repeated.
                    right if mark.at == (0..text.len()) => sentences::it_should_be(&right),
                    "" => sentences::nothing_in_place_of(&&text[mark.at.clone()]),
                    right => sentences::in_place_of(&right, &&text[mark.at.clone()]),
                };
                let told = distinct(marks.iter().map(change));
                format!("{}: {}", kind.words(), told.join(", "))
            }
            FormulaCause::Mostly { cause, left } => {
                sentences::for_the_most_part_with_that_of_the_difference(&cause.at_marks(text), &(100.0 * left))
            }
            FormulaCause::Slip(_)
            | FormulaCause::Missing(_)
            | FormulaCause::Offset(_)
            | FormulaCause::Factor(_)
            | FormulaCause::Terms(_)
            | FormulaCause::Leaves { .. }
            | FormulaCause::Several { .. }
            | FormulaCause::Other(_)
            | FormulaCause::Constant
            | FormulaCause::Near { .. } => self.to_string(),
        }
    }

    /// Whether the cause explains the whole error.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        !matches!(self, FormulaCause::Mostly { .. } | FormulaCause::Near { .. } | FormulaCause::Constant)
    }
}

/// Result of a search for a cause.
#[derive(Clone, Debug, Default)]
pub struct CauseSearch {
    /// The cause, or `None` if no simple cause was found.
    pub cause: Option<FormulaCause>,
    /// Whether the search reached its work limit without finding a cause of the whole error.
    pub is_cut: bool,
    /// Number of operations used. One operation is the cost of evaluating one subexpression at one instant.
    pub work: u64,
}

/// The reason given if a search reached its limit without finding a cause.
pub const CUT: &str = sentences::THE_SEARCH_ENDED_AT_ITS_LIMIT;

/// Upper limit of the number of operations of the search for the cause of one formula.
pub const MOST_WORK: u64 = 60_000_000;
/// Largest number of equally good explanations that are reported.
const TOLD: usize = 3;
/// A formula counts as an approximation if its error is at most this fraction of the mechanism's largest value.
const NEAR: f64 = 0.02;

/// Finds why the formula called `name` is wrong on a trajectory. The search uses at most `limit` operations.
/// Returns no cause if no formula called `name` makes a claim, if `limit` is 0, or if nothing simple explains the
/// error.
///
/// # Errors
/// If the trajectory lacks a channel of the claim.
pub fn cause(formulas: &Formulas, name: &str, course: &KnownTrajectory, limit: u64) -> Result<CauseSearch> {
    if limit == 0 {
        return Ok(CauseSearch { is_cut: true, ..CauseSearch::default() });
    }
    let Some(index) = formulas.list.iter().position(|own| own.name == name) else { return Ok(CauseSearch::default()) };
    let Some(claim) = &formulas.list[index].claim else { return Ok(CauseSearch::default()) };
    let mut trial = Trial::of(formulas, index, claim, course, limit)?;
    let found = sought(&mut trial, claim, course);
    Ok(CauseSearch {
        is_cut: trial.is_spent() && !found.as_ref().is_some_and(FormulaCause::is_whole),
        cause: found,
        work: trial.sheet.operations,
    })
}

fn sought(trial: &mut Trial, claim: &Claim, course: &KnownTrajectory) -> Option<FormulaCause> {
    let rows = trial.rows();
    let number = of_numbers(&rows);
    trial.is_number = number.is_some();
    let formulas = trial.formulas.clone();
    let dimensions = Dimensions::of(&formulas, trial.index, claim);
    let tried = slips::tried(trial, &dimensions);
    let is_sound = |own: &&Mended| !own.rank.0;
    let is_simple = |own: &&Mended| own.slip.kind != SlipKind::Value || !own.rank.1;
    let mut sound: Vec<&Mended> = tried.right.iter().filter(is_sound).filter(is_simple).collect();
    // If the mechanism's value is constant, or if the formula is wrong by a factor or an offset, a correction has to
    // match only one number. The match is then weak evidence.
    let is_weak = trial.is_constant() || trial.is_number;
    if let Some(first) = sound.first().copied() {
        // The evidence for a slip is stronger if it is a wrong sign or a wrong unit, or if only its correction makes
        // the units consistent.
        let own = formulas.list[trial.index].tree.clone();
        let is_natural = match first.slip.kind {
            SlipKind::Sign | SlipKind::Branch | SlipKind::PerRadian | SlipKind::PerSecond => true,
            SlipKind::Unit => !trial.is_constant(),
            SlipKind::Function
            | SlipKind::Power
            | SlipKind::Name
            | SlipKind::Exchanged
            | SlipKind::Term
            | SlipKind::Reference
            | SlipKind::Factor
            | SlipKind::Operator
            | SlipKind::Parentheses
            | SlipKind::Value => !dimensions.are_sound(&[(trial.index, own)]),
        };
        let mut kinds = BTreeSet::new();
        let (rank, written) = (first.rank, first.slip.written.clone());
        sound.retain(|own| {
            let is_same = own.rank != rank && written.contains(&own.slip.written);
            if is_weak && !is_natural {
                let is_near = own.rank.2 == rank.2 || trial.is_constant();
                return own.rank.1 == rank.1 && is_near && !is_same && kinds.insert((own.slip.kind, own.rank.2));
            }
            // By chance, a wrong factor can have the same effect as a wrong or exchanged name; both explanations are
            // then reported. For example, if a = 2 b, then `a` in place of `b` has the same effect as a factor of 2.
            let is_number = |kind: SlipKind| kind == SlipKind::Factor;
            let is_other = own.rank.1 == rank.1
                && (matches!(rank.3, SlipKind::Name | SlipKind::Exchanged) && is_number(own.slip.kind)
                    || is_number(rank.3) && own.rank.2 && own.rank.3 < rank.3);
            own.rank == rank && own.slip.written == written || is_other && kinds.insert((own.slip.kind, own.rank.2))
        });
        return one_of(sound.into_iter().map(|own| FormulaCause::Slip(own.slip.clone())).collect());
    }
    // A missing term or factor is preferred to a slip that makes the units inconsistent.
    let lacks = if trial.is_spent() { Vec::new() } else { missing(trial, &dimensions) };
    let found: Vec<FormulaCause> = lacks.into_iter().map(FormulaCause::Missing).collect();
    if !found.is_empty() {
        return one_of(found);
    }
    if let Some(first) = tried.right.first() {
        return Some(FormulaCause::Slip(first.slip.clone()));
    }
    if number.is_some() {
        return number;
    }
    if !trial.is_spent()
        && let Some(found) = terms::of(trial, course, &dimensions)
    {
        return Some(FormulaCause::Terms(found));
    }
    if let Some(found) = terms::is_other(trial, claim, course) {
        return Some(FormulaCause::Other(found));
    }
    if trial.gives_one_number() && !trial.is_constant() {
        return Some(FormulaCause::Constant);
    }
    // A formula that states an error is an approximation. It may cross the exact curve, and is right by chance where it
    // does. Approximations are therefore not examined for a change of branch.
    let is_exact = trial.formula.error.is_none();
    if let Some(found) = leaves(&rows, course.trajectory.input()).filter(|_| is_exact) {
        return Some(found);
    }
    // Largest remainder that counts as evidence for a slip.
    // If `among` slips are tried, the probability is at most `CHANCE` that by chance one of these slips leaves a
    // remainder below this limit at two instants.
    let by_chance = |own: &Mended| (CHANCE / own.among as f64).sqrt().smaller(MOST_LEFT);
    let nearest = tried.nearest.filter(|own| !own.rank.0 && !is_weak && own.left <= by_chance(own));
    let mostly = |own: Mended| FormulaCause::Mostly { cause: Box::new(FormulaCause::Slip(own.slip)), left: own.left };
    nearest.map(mostly).or_else(|| near(&rows).filter(|_| is_exact))
}

/// Accepted probability that a slip leaves a small remainder without being the cause.
const CHANCE: f64 = 0.05;

/// Returns one cause, or several that fit equally well.
fn one_of(mut causes: Vec<FormulaCause>) -> Option<FormulaCause> {
    causes.dedup();
    let more = causes.len().saturating_sub(TOLD);
    causes.truncate(TOLD);
    if causes.len() > 1 { Some(FormulaCause::Several { causes, more }) } else { causes.pop() }
}

/// Recognises a formula that is right to within a small fraction of the largest value, such as a series or a
/// small-angle formula.
fn near(rows: &[Row]) -> Option<FormulaCause> {
    let largest = |of: &dyn Fn(&Row) -> f64| rows.iter().map(|row| of(row).abs()).fold(0.0, f64::larger);
    let (error, scale) = (largest(&|row| row[2] - row[3]), largest(&|row| row[3]));
    let is_near = rows.len() >= FEWEST && error <= NEAR * scale;
    is_near.then_some(FormulaCause::Near { error, share: error / scale })
}

/// Smallest number of instants from which an approximation is recognised.
const FEWEST: usize = 8;

/// Values at an instant: time, crank angle, value of the formula, value of the mechanism, bound. If the formula gives
/// an angle, whole revolutions are added so that its value is as near as possible to the mechanism's value.
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

/// Returns an offset or a factor, if either explains the whole error.
fn of_numbers(rows: &[Row]) -> Option<FormulaCause> {
    if rows.len() < 3 || rows.iter().any(|row| !row[2].is_finite()) {
        return None;
    }
    let left = |row: &Row| row[2] - row[3];
    let largest = |column: usize| rows.iter().map(|row| row[column].abs()).fold(0.0, f64::larger);
    // The bound is widened by the rounding error of the values, because this error limits the accuracy of a fitted
    // coefficient.
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
    let offset = by(&|_| 1.0).map(FormulaCause::Offset);
    // A formula that is zero everywhere is a constant, and not a multiple of the right value.
    let factor = || by(&|row| row[3]).map(|more| 1.0 + more).filter(|_| largest(2) > slack);
    offset.or_else(|| factor().map(FormulaCause::Factor))
}

/// Recognises a formula that is right up to a value of the input and wrong beyond this value.
fn leaves(rows: &[Row], input: Input) -> Option<FormulaCause> {
    let mut order: Vec<&Row> = rows.iter().collect();
    order.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let is_right = |row: &&Row| (row[2] - row[3]).abs() <= row[4];
    let right = order.iter().copied().take_while(is_right).count();
    (right >= 2 && right < order.len())
        .then(|| FormulaCause::Leaves { after: input.at(order[right - 1][1]), before: input.at(order[right][1]) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten values with a bound of 1e-12. After an offset or a factor is removed, each remainder must be at most about
    /// 1e-12.
    #[test]
    fn an_offset_or_factor_must_explain_every_row() {
        let found = |of: &dyn Fn(f64) -> f64, off: f64| {
            let mut rows: Vec<Row> = (0..10u32)
                .map(|k| {
                    let mechanism = (0.7 * f64::from(k)).sin() + 0.2;
                    [f64::from(k), f64::from(k), of(mechanism), mechanism, 1e-12]
                })
                .collect();
            rows[3][2] += off;
            of_numbers(&rows)
        };
        let factor = found(&|right| 1.1 * right, 0.0);
        assert!(matches!(factor, Some(FormulaCause::Factor(own)) if (own - 1.1).abs() < 1e-12), "{factor:?}");
        let offset = found(&|right| right + 0.5, 0.0);
        assert!(matches!(offset, Some(FormulaCause::Offset(own)) if (own - 0.5).abs() < 1e-12), "{offset:?}");
        for of in [&(|right| 1.1 * right) as &dyn Fn(f64) -> f64, &|right| right + 0.5] {
            assert!(found(of, 2e-12).is_some());
            let over = found(of, 1e-9);
            assert!(over.is_none(), "{over:?}");
        }
        let square = found(&|right| right * right, 0.0);
        assert!(square.is_none(), "{square:?}");
        let zero = found(&|_| 0.0, 0.0);
        assert!(zero.is_none(), "{zero:?}");
    }
}
