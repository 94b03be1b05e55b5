//! Exact first derivatives of a run's figures, such as the largest reaction, with respect to the numbers in its file,
//! and tolerance stacks from these derivatives.
//!
//! Side 1, the analytic solver, computes each figure.
//! At the instants that determine the figure, the equations of the whole mechanism are solved again in dual numbers
//! ([`precise::Dual`]).
//! Unlike difference quotients, dual numbers have no error of a step width.
//! The derivatives of an extreme are the derivatives of the quantity at the instant of the extreme: a shift of this
//! instant has no first-order effect.
//! A mean needs the derivatives at all instants.

mod answer;
mod instants;
mod quantity;
mod rivals;
mod tolerance;

use crate::sentences;
use std::collections::BTreeMap;

use formula::{Function, NodeShape};
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use scenario::{
    CaseKey, CaseSlopes, Claim, SampledFigure, Scenario, ScenarioFamily, StartRequest, Statistic, TurnFigure,
};

pub use self::answer::{FigureSlopes, Sensitivity, SensitivityQuestion};
use self::instants::{Derived, derived};
pub(crate) use self::quantity::Quantity;
use self::quantity::solved;
use self::rivals::{plateau, rival};
pub use self::tolerance::{APART, KeyTolerance, LinearLimit, ToleranceStack, stacks};

/// The exact derivatives of the figures of a scenario.
///
/// # Errors
/// [`ErrorKind::Input`] for an unknown key or quantity, or a figure without a value.
/// [`ErrorKind::Unsupported`] for a mechanism with friction or transmissions, for a free motion, for a motion through
/// change points, and for a key whose derivative is not known.
/// [`ErrorKind::Numeric`] if side 1 and the solution in dual numbers give different values.
/// [`ErrorKind::Geometry`] if the pose at an instant is singular. The errors of the solver.
pub fn sensitivity(scenario: &Scenario, question: &SensitivityQuestion) -> Result<Sensitivity> {
    sensitivity_by(scenario, &CaseSlopes::of(scenario, &question.asked)?, question)
}

/// Like [`sensitivity`], for a caller that already has the derivatives of the numbers of the case.
///
/// # Errors
/// The errors of [`sensitivity`].
pub fn sensitivity_by(scenario: &Scenario, slopes: &CaseSlopes, question: &SensitivityQuestion) -> Result<Sensitivity> {
    let (chosen, left_out) = chosen(scenario, slopes, question)?;
    let case = &scenario.case;
    let by_input = question.by_input.unwrap_or(slopes.by_input);
    let claims = question.figures.iter().map(|figure| claim(figure, case)).collect::<Result<Vec<_>>>()?;
    let run = solved(case, &claims)?;
    let mut sampled = Vec::with_capacity(claims.len());
    for (figure, claim) in question.figures.iter().zip(&claims) {
        let values = scenario::sampled_values(claim, &run)?;
        let found = figure.of(&run, &values)?;
        let scale = values.iter().fold(0.0, |most: f64, own| most.larger(own.abs()));
        let is_at = matches!(figure.statistic, Statistic::At(_));
        let around = |row: &usize| if is_at { vec![*row] } else { plateau(*row, &values, &run, scale, ROUNDING) };
        let around = found.rows.iter().map(around).collect();
        let is_magnitude = match &claim.tree.shape {
            NodeShape::Name(name) => claim.channels.iter().any(|(own, printed)| own == name && printed.magnitude),
            NodeShape::Call(function, _) => matches!(function, Function::Abs | Function::Sqrt),
            NodeShape::Number(_) | NodeShape::Negative(_) | NodeShape::Pair(..) => false,
        };
        sampled.push(Sampled { found, around, values, scale, is_magnitude });
    }
    let rows = rows(&sampled, case.grid.len());
    let derived = derived(case, slopes, &chosen, &claims, &rows, by_input)?;
    let keys: Vec<CaseKey> = chosen.iter().map(|key| slopes.keys[*key].clone()).collect();
    let mut figures = Vec::with_capacity(sampled.len());
    for (index, own) in sampled.into_iter().enumerate() {
        let figure = &question.figures[index];
        check_agreement(figure, &own, index, &derived)?;
        let by = figure_slopes(figure, &own, index, &derived, &keys);
        let Sampled { found, values, scale, .. } = own;
        let has_kink = by.iter().any(|own| own.is_nan());
        figures.push(FigureSlopes {
            figure: figure.clone(),
            unit: claims[index].unit().into(),
            instants: found.rows.iter().map(|row| run.told(*row).to_string()).collect(),
            rival: rival(figure.statistic, &values, &run, case, scale).map(|row| run.told(row).to_string()),
            sampled: found,
            by,
            has_kink,
        });
    }
    Ok(Sensitivity { keys, figures, left_out, by_input })
}

/// Indices of the chosen keys; and for each omitted key, its name and the part of the file whose derivative by this key
/// is not known.
type Chosen = (Vec<usize>, Vec<(String, String)>);

fn chosen(scenario: &Scenario, slopes: &CaseSlopes, question: &SensitivityQuestion) -> Result<Chosen> {
    let untold: BTreeMap<usize, &String> = slopes.untold.iter().map(|(key, part)| (*key, part)).collect();
    let (mut chosen, mut left_out) = (Vec::new(), Vec::new());
    if question.keys.is_empty() {
        for key in slopes.usual() {
            match untold.get(&key) {
                Some(part) => left_out.push((slopes.keys[key].name.clone(), (*part).clone())),
                None => chosen.push(key),
            }
        }
    }
    for name in question.keys.iter().chain(&question.also) {
        let Some(key) = slopes.key(name) else {
            let asked = StartRequest::default();
            let family = ScenarioFamily::of(&scenario.text, &scenario.path, asked, false)?;
            if family.check_keys(&[name], scenario).is_ok() {
                let error = Error::new(ErrorKind::Input, sentences::is_an_expression(name)).key(name.as_str());
                return Err(error.help(sentences::NAME_THE_PARAMETERS_OF_THE_EXPRESSION));
            }
            let names = slopes.keys.iter().map(|key| key.name.as_str());
            let help = scenario::words::suggestion(name, names, "`");
            return Err(Error::new(ErrorKind::Input, sentences::no_number_of_the_file_is_called(&name)).help(help));
        };
        if let Some(part) = untold.get(&key) {
            let message = sentences::no_derivative_is_known(&name, part);
            return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::COMPARE_WITH_A_SWEEP));
        }
        if !chosen.contains(&key) {
            chosen.push(key);
        }
    }
    if chosen.is_empty() {
        let message = sentences::THE_CASE_DEPENDS_ON_NO_KEY;
        return Err(Error::new(ErrorKind::Input, message).help(sentences::NAME_A_KEY));
    }
    Ok((chosen, left_out))
}

/// The quantity of a figure, if it can be differentiated.
fn claim(figure: &TurnFigure, case: &Case) -> Result<Claim> {
    let claim = figure.claim(case)?;
    if claim.has_masses() {
        let message = sentences::a_reduced_quantity_is_not_differentiated(&claim.text);
        return Err(Error::new(ErrorKind::Unsupported, message).help(sentences::COMPARE_WITH_A_SWEEP));
    }
    Ok(claim)
}

/// A figure with the values of its quantity in all rows.
struct Sampled {
    found: SampledFigure,
    /// For each row of `found`: the successive instants with nearly the same value.
    around: Vec<Vec<usize>>,
    values: Vec<f64>,
    /// The largest absolute value.
    scale: f64,
    /// Whether the quantity is an absolute value, the magnitude of a vector, or another square root.
    is_magnitude: bool,
}

/// The rows that determine the figures, in ascending order. If any figure is a mean or a root mean square, every row
/// is returned.
fn rows(sampled: &[Sampled], count: usize) -> Vec<usize> {
    if sampled.iter().any(|own| own.found.rows.is_empty()) {
        return (0..count).collect();
    }
    let mut rows: Vec<usize> = sampled.iter().flat_map(|own| own.around.iter().flatten().copied()).collect();
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// Largest allowed difference between the values of the two solutions, divided by the largest value.
const AGREEMENT: f64 = 1e-6;

/// Largest difference that counts as rounding, in the unit of the figure. Quantities that are zero in exact arithmetic
/// have such values.
const ROUNDING: f64 = 1e-9;

/// Largest value of a magnitude or square root that counts as zero, divided by the largest value.
const ZERO: f64 = 1e-12;

/// Change of a key, divided by its value, that counts as small. Tolerances are larger.
const SMALL_CHANGE: f64 = 1e-9;

/// Checks that the solution in dual numbers has the values of side 1.
/// If the values differed, the derivatives would belong to another mechanism.
fn check_agreement(figure: &TurnFigure, sampled: &Sampled, index: usize, derived: &Derived) -> Result<()> {
    let Sampled { found, values, scale, .. } = sampled;
    let allowed = (AGREEMENT * scale).larger(ROUNDING);
    for &row in &found.rows {
        let own = derived.at(index, row).value;
        if own.is_finite() && !((own - values[row]).abs() <= allowed) && derived.turn(index).is_none() {
            let message = sentences::the_two_solutions_differ(&figure, &values[row], &own);
            return Err(Error::new(ErrorKind::Numeric, message).help(sentences::TAKE_ANOTHER_INSTANT));
        }
    }
    Ok(())
}

/// Computes the derivatives of a figure from the derivatives of its quantity.
fn figure_slopes(
    figure: &TurnFigure,
    sampled: &Sampled,
    index: usize,
    derived: &Derived,
    keys: &[CaseKey],
) -> Vec<f64> {
    let Sampled { found, around, values, scale, is_magnitude } = sampled;
    let at = |row: usize, key: usize| derived.at(index, row).slopes[key];
    let is_kink = |row: usize| *is_magnitude && values[row] <= ZERO * scale;
    // The size of a key; one unit if its value is zero.
    let size = |key: usize| if keys[key].value == 0.0 { 1.0 } else { keys[key].value.abs() };
    let largest =
        |rows: &[usize], key: usize| rows.iter().fold(0.0, |most: f64, row| most.larger_number(at(*row, key).abs()));
    let effect = (0..keys.len()).map(|key| size(key) * largest(&around.concat(), key)).fold(*scale, f64::larger);
    // The derivative at the extreme number `place`.
    // NaN if a small change of the key shifts the extreme to a neighbouring instant with another derivative.
    let extreme = |place: usize, key: usize| {
        let (best, rows) = (found.rows[place], &around[place]);
        let own = at(best, key);
        let least = (AGREEMENT * largest(rows, key)).larger(ROUNDING * effect / size(key));
        let has_kink = rows.iter().any(|row| {
            let apart = (at(*row, key) - own).abs();
            apart > least && (values[best] - values[*row]).abs() <= SMALL_CHANGE * size(key) * apart
        });
        if has_kink || is_kink(best) { f64::NAN } else { own }
    };
    let one = |key: usize| match (figure.statistic, found.rows.as_slice()) {
        (Statistic::MaxAbs, [row]) if values[*row] == 0.0 => f64::NAN,
        (Statistic::MaxAbs, [row]) => values[*row].signum() * extreme(0, key),
        (Statistic::Range, [_, _]) => extreme(0, key) - extreme(1, key),
        (Statistic::Max | Statistic::Min, [_]) => extreme(0, key),
        (Statistic::At(_), [row]) if is_kink(*row) => f64::NAN,
        (Statistic::At(_), [row]) => at(*row, key),
        (Statistic::Rms, _) => {
            let squares: Vec<f64> = values.iter().map(|own| own * own).collect();
            let slope = |row: usize| 2.0 * values[row] * at(row, key);
            mean_slope(&squares, slope, key, derived) / (2.0 * found.value)
        }
        (Statistic::Mean, _) => mean_slope(values, |row| at(row, key), key, derived),
        (Statistic::Max | Statistic::Min | Statistic::MaxAbs | Statistic::Range | Statistic::At(_), _) => f64::NAN,
    };
    (0..keys.len()).map(one).collect()
}

/// Derivative of the mean over time by the trapezoidal rule.
/// If the instants keep their inputs when a key changes, the times of the instants change and have derivatives too.
fn mean_slope(values: &[f64], slope: impl Fn(usize) -> f64, key: usize, derived: &Derived) -> f64 {
    let order = linkage::math::statistics::ascending(&derived.times);
    let (mut sum, mut change) = (0.0, 0.0);
    for pair in order.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let width = derived.times[b] - derived.times[a];
        let wider = derived.time_slopes[b][key] - derived.time_slopes[a][key];
        sum += width * (values[a] + values[b]) / 2.0;
        change += wider * (values[a] + values[b]) / 2.0 + width * (slope(a) + slope(b)) / 2.0;
    }
    let [first, last] = [order[0], order[order.len() - 1]];
    let whole = derived.times[last] - derived.times[first];
    if !(whole > 0.0) {
        return slope(first);
    }
    let longer = derived.time_slopes[last][key] - derived.time_slopes[first][key];
    change / whole - sum / whole * longer / whole
}

#[cfg(test)]
mod tests;
