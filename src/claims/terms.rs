//! Terms that a wrong formula lacks as a whole, by least squares over what the mechanism has: sines and cosines of its
//! links' angles, the squares of their speeds, their accelerations.

use super::Course;
use super::dimension::Dimensions;
use super::missing::Monomials;
use super::trial::Trial;
use linkage::error::Result;
use linkage::math::{Column, KeepNan, Matrix};

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

/// A quantity of the mechanism by instants.
struct Basis {
    text: String,
    unit: &'static str,
    values: Vec<f64>,
}

/// Relative accuracy to which a coefficient is recognised as a product of parameters.
const ACCURACY: f64 = 1e-8;
/// Complexity of a coefficient that is no product of parameters.
const UNKNOWN_NUMBER: usize = 20;
/// Error of a channel's number over the largest of its column, as a basis.
const KNOWN: f64 = 1e-10;

/// What one or two terms explain best of the difference, all of it if they can.
///
/// # Errors
/// Those of the course's channels.
pub(super) fn of(trial: &Trial, course: &Course, dimensions: &Dimensions) -> Result<Option<Found>> {
    let rows = course.rows(trial.formula);
    let differences: Vec<f64> =
        (0..rows.len()).map(|place| -trial.difference(trial.pairs[place].formula.value, place)).collect();
    if rows.len() < 8 || differences.iter().any(|own| !own.is_finite()) {
        return Ok(None);
    }
    let bases = bases(trial, course, &rows)?;
    let monomials = Monomials::of(&trial.formulas, trial.index, &[]);
    let singles = (0..bases.len()).map(|one| vec![one]);
    let pairs = (0..bases.len()).flat_map(|one| (one + 1..bases.len()).map(move |other| vec![one, other]));
    // What explains all of it with its complexity, and what explains most with the share that it leaves.
    let mut whole: Option<(usize, Vec<Term>)> = None;
    let mut most: Option<(f64, Vec<usize>)> = None;
    for chosen in singles.chain(pairs) {
        let Some((coefficients, left)) = fitted(&bases, &chosen, &differences, &trial.few) else { continue };
        if left < 1e-6 && explains(trial, &bases, &chosen, &coefficients, &differences) {
            let written = chosen.iter().zip(&coefficients);
            let written =
                written.map(|(&one, &coefficient)| written_as(&bases[one], coefficient, &monomials, dimensions));
            let (terms, weights): (Vec<Term>, Vec<usize>) = written.unzip();
            let weight: usize = weights.iter().sum();
            if whole.as_ref().is_none_or(|(least, _)| weight < *least) {
                whole = Some((weight, terms));
            }
            // Two terms are no better than one.
            if chosen.len() == 1 {
                break;
            }
        }
        let penalty = if chosen.len() == 1 { left } else { 2.0 * left };
        if most.as_ref().is_none_or(|(least, _)| penalty < *least) {
            most = Some((penalty, chosen));
        }
    }
    if let Some((_, terms)) = whole {
        return Ok(Some(Found { terms, left: 0.0 }));
    }
    let all: Vec<usize> = (0..rows.len()).collect();
    let fitted = most.and_then(|(_, chosen)| Some((fitted(&bases, &chosen, &differences, &all)?.0, chosen)));
    let Some((coefficients, chosen)) = fitted else { return Ok(None) };
    let over = |place: usize| differences[place] - explained(&bases, &chosen, &coefficients, place);
    let largest = |of: &dyn Fn(usize) -> f64| all.iter().fold(0.0, |most: f64, &place| most.larger(of(place).abs()));
    let left = largest(&over) / largest(&|place| differences[place]);
    let term = |(&one, &coefficient): (&usize, &f64)| Term { coefficient, factor: None, of: bases[one].text.clone() };
    Ok(Some(Found { terms: chosen.iter().zip(&coefficients).map(term).collect(), left }))
}

/// A term as it may be written, and how complicated it is.
fn written_as(basis: &Basis, coefficient: f64, monomials: &Monomials, dimensions: &Dimensions) -> (Term, usize) {
    let mut products = monomials.with_value(coefficient, ACCURACY).into_iter();
    let product = products.find(|(tree, _)| dimensions.is_sound_term(tree, basis.unit));
    let weight = product.as_ref().map_or(UNKNOWN_NUMBER, |(_, weight)| *weight);
    (Term { coefficient, factor: product.map(|(tree, _)| tree.to_string()), of: basis.text.clone() }, weight)
}

/// What the chosen quantities explain at an instant.
fn explained(bases: &[Basis], chosen: &[usize], coefficients: &[f64], place: usize) -> f64 {
    chosen.iter().zip(coefficients).map(|(&one, own)| own * bases[one].values[place]).sum()
}

/// Coefficients of the chosen quantities at some instants, and the share of the difference that they leave.
fn fitted(bases: &[Basis], chosen: &[usize], differences: &[f64], places: &[usize]) -> Option<(Vec<f64>, f64)> {
    let matrix = Matrix::from_fn(places.len(), chosen.len(), |row, column| bases[chosen[column]].values[places[row]]);
    let right = Column::from_iterator(places.len(), places.iter().map(|&place| differences[place]));
    // Normalised columns: speeds squared and cosines differ by powers of ten.
    let sizes: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    if sizes.iter().any(|size| !(*size > 0.0)) {
        return None;
    }
    let scaled = Matrix::from_fn(places.len(), chosen.len(), |row, column| matrix[(row, column)] / sizes[column]);
    let solution = scaled.clone().svd(true, true).solve(&right, 1e-9).ok()?;
    let left = (scaled * &solution - &right).norm() / right.norm();
    let coefficients = solution.iter().zip(&sizes).map(|(own, size)| own / size).collect();
    left.is_finite().then_some((coefficients, left))
}

/// Whether nothing is left over at any instant.
fn explains(trial: &Trial, bases: &[Basis], chosen: &[usize], coefficients: &[f64], differences: &[f64]) -> bool {
    let largest = |values: &[f64]| values.iter().fold(0.0, |largest: f64, value| largest.larger(value.abs()));
    let known: f64 =
        chosen.iter().zip(coefficients).map(|(&one, own)| KNOWN * own.abs() * largest(&bases[one].values)).sum();
    (0..differences.len()).all(|place| {
        let left = differences[place] - explained(bases, chosen, coefficients, place);
        left.abs() <= 4.0 * trial.bound(place) + known
    })
}

/// What the mechanism has, the simplest first.
fn bases(trial: &Trial, course: &Course, rows: &[usize]) -> Result<Vec<Basis>> {
    let mut all = Vec::new();
    let mut put = |text: &str, unit: &'static str, of: &dyn Fn(usize) -> f64| {
        let values: Vec<f64> = rows.iter().map(|&row| of(row)).collect();
        all.push(Basis { text: text.into(), unit, values });
    };
    let crank = |row: usize| course.cranks()[row];
    put("", "rad", &|_| 1.0);
    for (text, function) in [("cos", f64::cos as fn(f64) -> f64), ("sin", f64::sin)] {
        put(&format!("{text}(phi)"), "rad", &|row| function(crank(row)));
        put(&format!("{text}(2*phi)"), "rad", &|row| function(2.0 * crank(row)));
    }
    put("phi", "rad", &crank);
    put("t", "s", &|row| course.times()[row]);
    for (name, [angle, omega, alpha]) in course.links() {
        for (text, function) in [("cos", f64::cos as fn(f64) -> f64), ("sin", f64::sin)] {
            let turned = |row: usize| function(angle[row]);
            put(&format!("{text}({name})"), "rad", &turned);
            put(&format!("omega({name})*{text}({name})"), "rad/s", &|row| omega[row] * turned(row));
            put(&format!("omega({name})^2*{text}({name})"), "rad/s^2", &|row| omega[row].powi(2) * turned(row));
            put(&format!("alpha({name})*{text}({name})"), "rad/s^2", &|row| alpha[row] * turned(row));
        }
        put(&format!("omega({name})"), "rad/s", &|row| omega[row]);
        put(&format!("omega({name})^2"), "rad/s^2", &|row| omega[row].powi(2));
        put(&format!("alpha({name})"), "rad/s^2", &|row| alpha[row]);
    }
    for (channel, values) in course.points() {
        put(&channel.to_string(), channel.kind.unit.symbol(), &|row| values[row]);
    }
    // What does not change says the same as the constant.
    let changes = |own: &Basis| {
        let largest = own.values.iter().fold(0.0, |largest: f64, value| largest.larger(value.abs()));
        own.text.is_empty() || own.values.iter().any(|value| (value - own.values[0]).abs() > 1e-6 * largest)
    };
    all.retain(changes);
    // The claim itself, or what goes with it, explains nothing.
    let claimed = Column::from_iterator(rows.len(), trial.pairs.iter().map(|pair| pair.mechanism.value));
    let is_claim = |own: &Basis| {
        let values = Column::from_column_slice(&own.values);
        values.dot(&claimed).abs() >= (1.0 - 1e-12) * values.norm() * claimed.norm()
    };
    all.retain(|own| own.text.is_empty() || !is_claim(own));
    Ok(all)
}
