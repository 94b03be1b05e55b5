//! Finds the first instant at which a formula has no value, and the undefined operation.

use crate::sentences;
use std::fmt;

use super::KnownTrajectory;
use super::trial::Trial;
use crate::numbers::input_told;
use formula::FormulaFault;
use linkage::error::Result;
use linkage::input::Input;
use scenario::Formulas;

/// An operation outside its domain, at the first instant at which a formula has no value.
#[derive(Clone, Debug, PartialEq)]
pub struct Undefined {
    /// Name of the formula that contains the operation: the requested formula, or a formula that it uses.
    pub formula: String,
    /// The operation with its arguments, its position in the formula's text (bytes), and the required domain.
    pub fault: FormulaFault,
    /// The operation as it is written.
    pub written: String,
    /// Value of the input (SI).
    pub crank: f64,
    /// What `crank` measures.
    pub input: Input,
    /// Whether the undefined operation is the only fault: the formula has a value at some instants and is right at all
    /// of these.
    pub is_all: bool,
}

impl fmt::Display for Undefined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Undefined { formula, fault: FormulaFault { message, at, help }, written, crank, input, .. } = self;
        let place = sentences::in_from_its_letter(&written, &formula, &(at.start + 1));
        write!(f, "{}", sentences::at_whatever(&message, &input_told(input.at(*crank), 3), &place, &help))
    }
}

/// Finds the first instant of a course at which the formula called `name` has no value. Also returns the number of
/// operations used.
/// `None` if the formula has a value at every instant, does not exist or claims nothing, or if no undefined operation
/// is found.
///
/// # Errors
/// If the course lacks a channel of the claim.
pub fn undefined(formulas: &Formulas, name: &str, course: &KnownTrajectory) -> Result<(Option<Undefined>, u64)> {
    let Some(index) = formulas.list.iter().position(|own| own.name == name) else { return Ok((None, 0)) };
    let Some(claim) = &formulas.list[index].claim else { return Ok((None, 0)) };
    let trial = Trial::of(formulas, index, claim, course, 0)?;
    let pairs = trial.pairs.iter().enumerate();
    let (without, with): (Vec<_>, Vec<_>) = pairs.partition(|(_, pair)| pair.formula.is_undefined());
    let first = without.into_iter().min_by(|one, other| one.1.place[0].total_cmp(&other.1.place[0]));
    let work = trial.sheet.operations;
    let Some((place, pair)) = first else { return Ok((None, work)) };
    let [phi, t, ..] = trial.inputs(place);
    let Some((of, fault)) = formulas.undefined(index, [phi, t]) else { return Ok((None, work)) };
    let is_right = |place: usize| trial.difference(trial.pairs[place].formula.value, place).abs() <= trial.bound(place);
    let is_all = !with.is_empty() && with.iter().all(|&(place, _)| is_right(place));
    let own = &formulas.list[of];
    let written = own.text.get(fault.at.clone()).unwrap_or_default().to_string();
    let (formula, crank) = (own.name.clone(), pair.place[1]);
    Ok((Some(Undefined { formula, fault, written, crank, input: pair.input, is_all }), work))
}
