//! Parameters: named numbers that are used in numbers and formulas of the file.

use super::unit::{self, NamedUnit};
use super::words::suggestion;
use crate::sentences;
use formula::{FormulaFault, FormulaTree, Function, Rounded};
use std::collections::BTreeMap;

/// A number with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The key with its unit, such as `a_mm`. In formulas, the key denotes the number without conversion.
    pub key: String,
    /// The number as it was given, in the unit of the key.
    pub given: f64,
    unit: Option<&'static NamedUnit>,
}

impl Parameter {
    pub(super) fn new(key: &str, given: f64) -> Self {
        Parameter { key: key.into(), given, unit: unit::ending(key).map(|(_, unit)| unit) }
    }

    /// The key without its unit, such as `a`. In formulas, the short name denotes the number in SI. `None` for a key
    /// without a unit.
    #[must_use]
    pub fn short(&self) -> Option<&str> {
        self.unit.map(|unit| &self.key[..self.key.len() - unit.suffix.len() - 1])
    }

    /// Unit of the parameter, from the ending of its key.
    #[must_use]
    pub fn unit(&self) -> Option<&'static str> {
        self.unit.map(|unit| unit.suffix)
    }

    /// Whether the parameter is an angle, by its unit.
    #[must_use]
    pub fn is_angle(&self) -> bool {
        self.unit.is_some_and(|unit| unit::ANGLE.units.contains(unit))
    }

    /// The name of the parameter's value in SI: the short name, or the key if the key has no unit.
    #[must_use]
    pub fn quantity(&self) -> &str {
        self.short().unwrap_or(&self.key)
    }

    /// The names of the parameter, each with the number that it denotes.
    pub fn names(&self) -> impl Iterator<Item = (&str, Rounded)> {
        let plain = Rounded::decimal(self.given);
        let si = self.unit.map(|unit| match unit.to_si(1.0) {
            1.0 => plain,
            _ => Rounded::nearly(unit.to_si(self.given)),
        });
        [(self.key.as_str(), plain)].into_iter().chain(self.short().zip(si))
    }
}

/// Parameters, found by any of their names.
#[derive(Clone, Debug, Default)]
pub struct Parameters {
    list: Vec<Parameter>,
    places: BTreeMap<String, usize>,
}

impl Parameters {
    /// All parameters, in the order of the file.
    #[must_use]
    pub fn list(&self) -> &[Parameter] {
        &self.list
    }

    /// The parameter that a name denotes.
    #[must_use]
    pub fn called(&self, name: &str) -> Option<&Parameter> {
        self.places.get(name).map(|&place| &self.list[place])
    }

    /// Adds a parameter. The names of the parameter must not be in use.
    pub(super) fn push(&mut self, parameter: Parameter) {
        for (name, _) in parameter.names() {
            self.places.insert(name.into(), self.list.len());
        }
        self.list.push(parameter);
    }

    /// Replaces the number of the parameter whose key is `key`; `false` if there is no such parameter.
    pub(super) fn set(&mut self, key: &str, given: f64) -> bool {
        let place = self.places.get(key).copied().filter(|&place| self.list[place].key == key);
        place.map(|place| self.list[place].given = given).is_some()
    }
}

/// The number that `text` gives for a key. The text is an arithmetic expression of numbers and parameters.
/// A parameter's short name denotes its value in the key's unit, if parameter and key measure the same quantity
/// (`length_mm = "2 * a"`).
/// If the quantities differ, the short name denotes the value in SI.
///
/// # Errors
/// The mistake in the text, with its position.
pub(super) fn arithmetic(text: &str, key: &str, parameters: &Parameters) -> std::result::Result<f64, FormulaFault> {
    let tree = FormulaTree::parse(text)?;
    let wanted = unit::ending(key).map(|(_, unit)| unit);
    let of = |name: &str| {
        let own = parameters.called(name)?;
        let (_, number) = own.names().find(|(own, _)| *own == name)?;
        let is_short = own.short() == Some(name);
        let of_key = wanted.filter(|wanted| is_short && own.unit.is_some_and(|unit| unit::alike(unit, wanted)));
        // If the parameter is given in the key's unit, its number is used without conversion.
        Some(Rounded::exact(match of_key {
            Some(unit) if Some(unit) == own.unit => own.given,
            Some(unit) => number.value / unit.to_si(1.0),
            None => number.value,
        }))
    };
    let of = |name: &str| if name == "pi" { Some(Rounded::nearly(std::f64::consts::PI)) } else { of(name) };
    if let Some((name, at)) = tree.names().into_iter().find(|(name, _)| of(name).is_none()) {
        let help = match parameters.list.is_empty() {
            true => sentences::WRITE_A_NUMBER_OR_GIVE_IT_A_NAME.into(),
            false => suggestion(name, parameters.places.keys().map(String::as_str).chain(["pi"]), "`"),
        };
        return Err(FormulaFault { message: sentences::there_is_no(&name), at, help });
    }
    let found = tree.evaluated(&|name| of(name).unwrap_or(Rounded::UNDEFINED))?;
    if found.error.is_finite() {
        return Ok(found.value);
    }
    let help = sentences::CHECK_ITS_UNITS_AND_WHETHER.to_string();
    Err(FormulaFault { message: sentences::NOTHING_IS_KNOWN_OF_ITS_VALUE.into(), at: 0..text.len(), help })
}

/// Names that have a fixed meaning in every formula.
pub const INPUTS: [&str; 2] = ["phi", "t"];

/// Message and help, if `name` cannot be the name of a parameter or formula.
pub(super) fn fault_of_name(name: &str) -> Option<(String, &'static str)> {
    const HELP: &str = sentences::NAMES_BEGIN_WITH_A_LETTER;
    let mut bytes = name.bytes();
    let sound = bytes.next().is_some_and(|first| first.is_ascii_alphabetic())
        && bytes.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
        && name.len() <= 100;
    let has_meaning = INPUTS.contains(&name) || name == "pi" || Function::named(name).is_some();
    match (sound, has_meaning) {
        (false, _) => Some((sentences::cannot_be_a_name_in_a_formula(&name), HELP)),
        (true, true) => Some((sentences::has_a_meaning_in_every_formula(&name), sentences::CHOOSE_ANOTHER_NAME)),
        (true, false) => None,
    }
}
