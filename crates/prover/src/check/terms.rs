//! Finds terms that a wrong formula lacks, by least squares over quantities of the mechanism.
//! The quantities are velocities and accelerations of points, and functions of the time, the crank angle, and the
//! angles and rates of links.

mod squares;

use super::KnownTrajectory;
use super::dimension::Dimensions;
use super::judged::Pair;
use super::missing::Monomials;
use super::trial::Trial;
use linkage::math::KeepNan;
use linkage::trajectory::Channel;
use scenario::Claim;
use squares::{TermBasis, WeightedTerm, bases, explanations};

pub use squares::Wrong;

/// A term with its coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Coefficient of the term, in the unit of the claim.
    pub coefficient: f64,
    /// The coefficient as a product of parameters, if a product with a suitable unit has this value.
    pub factor: Option<String>,
    /// The quantity that the coefficient multiplies; empty for a constant.
    pub of: String,
}

/// Relative accuracy to which a coefficient is recognised as a product of parameters.
const ACCURACY: f64 = 1e-8;
/// Complexity of a coefficient that is not a product of parameters.
const UNKNOWN_NUMBER: usize = 20;
/// A term that exceeds this multiple of the largest difference is not an explanation.
const LARGER: f64 = 3.0;
/// The values of a channel are assumed to have an error of this fraction of their largest value.
const KNOWN: f64 = 1e-10;

/// One or two terms that explain the whole difference.
/// A coefficient is a product of parameters. Its unit makes the term agree with the unit of the claim.
/// A coefficient may be a mere number only in a constant term, or if it multiplies a sine or cosine of an angle, or the
/// crank angle.
pub(super) fn of(trial: &mut Trial, course: &KnownTrajectory, dimensions: &Dimensions) -> Option<Vec<Term>> {
    let rows = course.rows(trial.formula);
    if rows.len() != trial.pairs.len() {
        return None;
    }
    let place = |place: usize| -trial.difference(trial.pairs[place].formula.value, place);
    let wrong = Wrong {
        rows: &rows,
        differences: (0..rows.len()).map(place).collect(),
        bounds: (0..rows.len()).map(|place| trial.bound(place)).collect(),
        right: trial.pairs.iter().map(|pair| pair.mechanism.value).collect(),
        few: &trial.few,
    };
    let bases = bases(course, &wrong);
    let largest = wrong.differences.iter().fold(0.0, |largest: f64, own| largest.larger(own.abs()));
    // If the formula is constant, an explanation whose constant term cancels the formula is rejected.
    let formula = trial.pairs.first()?.formula.value;
    let is_constant = trial.gives_one_number();
    let monomials = Monomials::of(&trial.formulas, trial.index, &[], dimensions);
    // The simplest complete explanation.
    let mut whole: Option<(usize, Vec<Term>)> = None;
    explanations(&wrong, &bases, |parts| {
        let is_named = |(term, basis): &(Term, &TermBasis)| term.factor.is_some() || basis.unit == "rad";
        // A term much larger than the difference explains nothing, because it is cancelled by another such term or by
        // the formula itself.
        if parts.iter().any(|part| part.coefficient.abs() * part.basis.largest() > LARGER * largest) {
            return;
        }
        let written =
            parts.iter().map(|part| (written_as(part.basis, part.coefficient, &monomials, dimensions), part.basis));
        let (mut terms, mut weight) = (Vec::new(), 0);
        for ((term, own), basis) in written {
            let takes_away = basis.text.is_empty() && (term.coefficient + formula).abs() <= 1e-6 * formula.abs();
            if is_constant && takes_away {
                return;
            }
            let pair = (term, basis);
            if !is_named(&pair) {
                return;
            }
            terms.push(pair.0);
            weight += own;
        }
        if whole.as_ref().is_none_or(|(least, _)| weight < *least) {
            whole = Some((weight, terms));
        }
    });
    trial.sheet.operations += (bases.len() * bases.len() * trial.few.len() + monomials.len()) as u64;
    whole.map(|(_, terms)| terms)
}

/// The channel that the formula gives, if it is not the claimed channel.
pub(super) fn is_other(trial: &Trial, claim: &Claim, course: &KnownTrajectory) -> Option<String> {
    let [(_, claimed)] = claim.channels.as_slice() else { return None };
    let rows = course.rows(trial.formula);
    if rows.len() != trial.pairs.len() || rows.len() < FEWEST || claim.unit().is_empty() {
        return None;
    }
    let turn = claim.turn();
    let is_right = |(channel, values): &(&Channel, &[f64])| {
        let largest = rows.iter().fold(0.0, |largest: f64, &row| largest.larger(values[row].abs()));
        // If channel and claim have units of different kinds, the channel is compared in its SI unit.
        let is_alike = channel.kind.unit == claimed.channel.kind.unit;
        let (unit, turn) = if is_alike { (claimed.to_si(1.0), turn) } else { (1.0, None) };
        let fits = |(&row, pair): (&usize, &Pair)| {
            let gap = pair.formula.value - values[row] / unit;
            let gap = turn.map_or(gap, |turn| gap - turn * (gap / turn).round());
            gap.abs() <= 4.0 * pair.formula.error + KNOWN * largest / unit
        };
        **channel != claimed.channel && largest > 0.0 && rows.iter().zip(&trial.pairs).all(fits)
    };
    course.columns().find(is_right).map(|(channel, _)| channel.to_string())
}

/// Smallest number of instants from which a channel is recognised.
const FEWEST: usize = 8;

impl Term {
    /// A term whose coefficient is a number.
    pub(super) fn plain(part: &WeightedTerm) -> Term {
        Term { coefficient: part.coefficient, factor: None, of: part.basis.text.clone() }
    }
}

/// Explains the differences between right and wrong numbers that do not come from a formula. The explanation is one
/// term, or two terms that leave no difference.
/// Returns the terms, and the remaining difference as a fraction of the largest difference.
#[must_use]
pub fn missing_in_numbers(course: &KnownTrajectory, wrong: &Wrong) -> Option<(Vec<Term>, f64)> {
    let terms = |parts: Vec<WeightedTerm>| parts.iter().map(Term::plain).collect::<Vec<_>>();
    let bases = bases(course, wrong);
    let mut whole = None;
    let most = explanations(wrong, &bases, |parts| {
        whole.get_or_insert_with(|| terms(parts));
    });
    let whole = whole.map(|terms| (terms, 0.0));
    whole.or_else(|| most.filter(|most| most.parts.len() == 1).map(|most| (terms(most.parts), most.left)))
}

/// A term in written form, and its complexity.
fn written_as(basis: &TermBasis, coefficient: f64, monomials: &Monomials, dimensions: &Dimensions) -> (Term, usize) {
    let mut products = monomials.with_value(coefficient, ACCURACY).into_iter();
    let product = products.find(|(tree, _)| dimensions.is_sound_term(tree, basis.unit));
    let weight = product.as_ref().map_or(UNKNOWN_NUMBER, |(_, weight)| *weight);
    (Term { coefficient, factor: product.map(|(tree, _)| tree.to_string()), of: basis.text.clone() }, weight)
}
