//! Terms that a wrong formula lacks as a whole, by least squares over what the mechanism has: sines and cosines of its
//! links' angles, the squares of their speeds, their accelerations.

mod squares;

use super::Course;
use super::dimension::Dimensions;
use super::missing::Monomials;
use super::trial::Trial;
use squares::{Basis, Explanation, Part, bases, explanations};

pub use squares::Wrong;

/// A term with its coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Its coefficient, in the unit of the claim.
    pub coefficient: f64,
    /// The coefficient as a product of parameters, if it is one whose unit fits.
    pub factor: Option<String>,
    /// What it is a multiple of; empty for a constant.
    pub of: String,
}

/// Terms that are missing, and the share of the largest difference that they leave; zero if the formula is right with
/// them.
pub(super) struct Found {
    pub(super) terms: Vec<Term>,
    pub(super) left: f64,
}

/// Relative accuracy to which a coefficient is recognised as a product of parameters.
const ACCURACY: f64 = 1e-8;
/// Complexity of a coefficient that is no product of parameters.
const UNKNOWN_NUMBER: usize = 20;

/// What one or two terms explain best of the difference, all of it if they can.
pub(super) fn of(trial: &Trial, course: &Course, dimensions: &Dimensions) -> Option<Found> {
    let rows = course.rows(trial.formula);
    let place = |place: usize| -trial.difference(trial.pairs[place].formula.value, place);
    let wrong = Wrong {
        rows: &rows,
        differences: (0..rows.len()).map(place).collect(),
        bounds: (0..rows.len()).map(|place| trial.bound(place)).collect(),
        right: trial.pairs.iter().map(|pair| pair.mechanism.value).collect(),
        few: &trial.few,
    };
    let bases = bases(course, &wrong);
    let monomials = Monomials::of(&trial.formulas, trial.index, &[]);
    // What explains all of it, with its complexity.
    let mut whole: Option<(usize, Vec<Term>)> = None;
    let most = explanations(&wrong, &bases, |parts| {
        let written = parts.iter().map(|part| written_as(part.basis, part.coefficient, &monomials, dimensions));
        let (terms, weights): (Vec<Term>, Vec<usize>) = written.unzip();
        let weight: usize = weights.iter().sum();
        if whole.as_ref().is_none_or(|(least, _)| weight < *least) {
            whole = Some((weight, terms));
        }
    });
    if let Some((_, terms)) = whole {
        return Some(Found { terms, left: 0.0 });
    }
    most.map(|Explanation { parts, left }| Found { terms: parts.iter().map(Term::plain).collect(), left })
}

impl Term {
    /// A term whose coefficient is a number.
    pub(super) fn plain(part: &Part) -> Term {
        Term { coefficient: part.coefficient, factor: None, of: part.basis.text.clone() }
    }
}

/// What a single term explains of numbers that no formula stands behind, or two if nothing is left over: the terms, and
/// the share of the largest difference that stays over.
#[must_use]
pub fn missing_in_numbers(course: &Course, wrong: &Wrong) -> Option<(Vec<Term>, f64)> {
    let terms = |parts: Vec<Part>| parts.iter().map(Term::plain).collect::<Vec<_>>();
    let bases = bases(course, wrong);
    let mut whole = None;
    let most = explanations(wrong, &bases, |parts| {
        whole.get_or_insert_with(|| terms(parts));
    });
    let whole = whole.map(|terms| (terms, 0.0));
    whole.or_else(|| most.filter(|most| most.parts.len() == 1).map(|most| (terms(most.parts), most.left)))
}

/// A term as it may be written, and how complicated it is.
fn written_as(basis: &Basis, coefficient: f64, monomials: &Monomials, dimensions: &Dimensions) -> (Term, usize) {
    let mut products = monomials.with_value(coefficient, ACCURACY).into_iter();
    let product = products.find(|(tree, _)| dimensions.is_sound_term(tree, basis.unit));
    let weight = product.as_ref().map_or(UNKNOWN_NUMBER, |(_, weight)| *weight);
    (Term { coefficient, factor: product.map(|(tree, _)| tree.to_string()), of: basis.text.clone() }, weight)
}
