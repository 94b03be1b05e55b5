//! Finds terms that are missing from wrong numbers, by least squares over quantities of the mechanism.
//! The quantities are velocities and accelerations of points, and functions of the time, the crank angle, and the
//! angles and rates of links.

use crate::check::KnownTrajectory;
use linkage::math::{ColumnVector, KeepNan, Matrix};

/// Wrong numbers, with the corrections that are to be explained.
pub struct Wrong<'a> {
    /// Rows of the trajectory with the wrong numbers.
    pub rows: &'a [usize],
    /// The right numbers minus the wrong numbers.
    pub differences: Vec<f64>,
    /// Bounds on the differences.
    pub bounds: Vec<f64>,
    /// The right numbers.
    pub right: Vec<f64>,
    /// Indices of the instants at which every explanation is tried first.
    pub few: &'a [usize],
}

/// A quantity of the mechanism, instant by instant.
pub struct TermBasis {
    /// Name of the quantity; empty for a constant.
    pub text: String,
    /// Unit of the quantity.
    pub unit: &'static str,
    values: Vec<f64>,
}

impl TermBasis {
    /// Largest value of the quantity over the instants.
    pub fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |largest: f64, value| largest.larger(value.abs()))
    }
}

/// A quantity with its coefficient.
pub struct WeightedTerm<'a> {
    /// The quantity.
    pub basis: &'a TermBasis,
    /// Coefficient of the quantity, in the unit of the wrong numbers.
    pub coefficient: f64,
}

/// An explanation of the differences between wrong and right numbers.
pub struct Explanation<'a> {
    /// One or two quantities of the mechanism, each with its coefficient.
    pub parts: Vec<WeightedTerm<'a>>,
    /// Fraction of the largest difference that remains; zero if nothing remains.
    pub left: f64,
}

/// Smallest number of instants from which terms are sought.
const FEWEST: usize = 8;
/// The values of a quantity are assumed to have an error of this fraction of their largest value.
const KNOWN: f64 = 1e-10;
/// An explanation is tried at all instants if it leaves less than this fraction of the difference at the instants of
/// `few`.
const PROMISING: f64 = 1e-6;

/// Calls `whole` for every explanation that consists of one or two quantities and leaves no difference.
/// The search ends at the first explanation by a single quantity.
/// Returns the fit with the smallest remainder. For this comparison, the remainder of a fit by two quantities is
/// doubled.
pub fn explanations<'a>(
    wrong: &Wrong,
    bases: &'a [TermBasis],
    mut whole: impl FnMut(Vec<WeightedTerm<'a>>),
) -> Option<Explanation<'a>> {
    let Wrong { differences, few, .. } = wrong;
    if differences.len() < FEWEST || differences.iter().any(|own| !own.is_finite()) {
        return None;
    }
    let parts = |chosen: &[usize], coefficients: &[f64]| {
        let part = |(&one, &coefficient): (&usize, &f64)| WeightedTerm { basis: &bases[one], coefficient };
        chosen.iter().zip(coefficients).map(part).collect::<Vec<_>>()
    };
    let singles = (0..bases.len()).map(|one| vec![one]);
    let pairs = (0..bases.len()).flat_map(|one| (one + 1..bases.len()).map(move |other| vec![one, other]));
    let mut most: Option<(f64, Vec<usize>)> = None;
    for chosen in singles.chain(pairs) {
        let Some((coefficients, left)) = fitted(bases, &chosen, differences, few) else { continue };
        if left < PROMISING && explains(wrong, bases, &chosen, &coefficients) {
            whole(parts(&chosen, &coefficients));
            // If a single quantity leaves no difference, pairs of quantities are not tried.
            if chosen.len() == 1 {
                break;
            }
        }
        let penalty = if chosen.len() == 1 { left } else { 2.0 * left };
        if most.as_ref().is_none_or(|(least, _)| penalty < *least) {
            most = Some((penalty, chosen));
        }
    }
    let (_, chosen) = most?;
    let all: Vec<usize> = (0..differences.len()).collect();
    let (coefficients, _) = fitted(bases, &chosen, differences, &all)?;
    let over = |place: usize| differences[place] - explained(bases, &chosen, &coefficients, place);
    let largest = |of: &dyn Fn(usize) -> f64| all.iter().fold(0.0, |most: f64, &place| most.larger(of(place).abs()));
    let left = largest(&over) / largest(&|place| differences[place]);
    Some(Explanation { parts: parts(&chosen, &coefficients), left })
}

/// The sum of the chosen quantities times their coefficients, at an instant.
fn explained(bases: &[TermBasis], chosen: &[usize], coefficients: &[f64], place: usize) -> f64 {
    chosen.iter().zip(coefficients).map(|(&one, own)| own * bases[one].values[place]).sum()
}

/// Coefficients of the chosen quantities, fitted at some instants, and the fraction of the difference that remains.
fn fitted(bases: &[TermBasis], chosen: &[usize], differences: &[f64], places: &[usize]) -> Option<(Vec<f64>, f64)> {
    let matrix = Matrix::from_fn(places.len(), chosen.len(), |row, column| bases[chosen[column]].values[places[row]]);
    let right = ColumnVector::from_iterator(places.len(), places.iter().map(|&place| differences[place]));
    // The columns are normalised, because the square of a speed can exceed a cosine by powers of ten.
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

/// Whether the remaining difference is within the bounds at all instants.
fn explains(wrong: &Wrong, bases: &[TermBasis], chosen: &[usize], coefficients: &[f64]) -> bool {
    let largest = |values: &[f64]| values.iter().fold(0.0, |largest: f64, value| largest.larger(value.abs()));
    let known: f64 =
        chosen.iter().zip(coefficients).map(|(&one, own)| KNOWN * own.abs() * largest(&bases[one].values)).sum();
    wrong.differences.iter().zip(&wrong.bounds).enumerate().all(|(place, (difference, bound))| {
        (difference - explained(bases, chosen, coefficients, place)).abs() <= 4.0 * bound + known
    })
}

/// Quantities of the mechanism, the simplest first.
pub fn bases(course: &KnownTrajectory, wrong: &Wrong) -> Vec<TermBasis> {
    let rows = wrong.rows;
    let mut all = Vec::new();
    let mut put = |text: &str, unit: &'static str, of: &dyn Fn(usize) -> f64| {
        let values: Vec<f64> = rows.iter().map(|&row| of(row)).collect();
        all.push(TermBasis { text: text.into(), unit, values });
    };
    let crank = |row: usize| course.trajectory.inputs()[row];
    put("", "rad", &|_| 1.0);
    for (text, function) in [("cos", f64::cos as fn(f64) -> f64), ("sin", f64::sin)] {
        put(&format!("{text}(phi)"), "rad", &|row| function(crank(row)));
        put(&format!("{text}(2*phi)"), "rad", &|row| function(2.0 * crank(row)));
    }
    put("phi", "rad", &crank);
    put("t", "s", &|row| course.trajectory.times()[row]);
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
    // Constant quantities are dropped, because the list already contains a constant.
    let changes = |own: &TermBasis| {
        let largest = own.values.iter().fold(0.0, |largest: f64, value| largest.larger(value.abs()));
        own.text.is_empty() || own.values.iter().any(|value| (value - own.values[0]).abs() > 1e-6 * largest)
    };
    all.retain(changes);
    // The claim itself and its multiples are dropped, because they explain nothing.
    let claimed = ColumnVector::from_column_slice(&wrong.right);
    let is_claim = |own: &TermBasis| {
        let values = ColumnVector::from_column_slice(&own.values);
        values.dot(&claimed).abs() >= (1.0 - 1e-12) * values.norm() * claimed.norm()
    };
    all.retain(|own| own.text.is_empty() || !is_claim(own));
    all
}
