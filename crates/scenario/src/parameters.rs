//! Parameters: named numbers that are used in numbers and formulas of the file.

use super::unit::{self, NamedUnit};
use super::words::suggestion;
use crate::sentences;
use formula::{FormulaFault, FormulaGraph, FormulaTree, Function, NodeId, Rounded};
use std::collections::{BTreeMap, BTreeSet};

/// A number with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The key with its unit, such as `a_mm`. In formulas, the key denotes the number without conversion.
    pub key: String,
    /// The number as it was given, in the unit of the key.
    pub given: f64,
    unit: Option<&'static NamedUnit>,
}

/// A conversion of units: multiplication by a factor, which is the result for the number 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Conversion {
    /// Unit of the given number; `None` if the number is not converted.
    from: Option<&'static NamedUnit>,
    /// Size of the wanted unit in SI units.
    to: f64,
}

impl Conversion {
    pub(super) fn of(self, given: f64) -> f64 {
        self.from.map_or(given, |unit| unit.to_si(given) / self.to)
    }
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

    /// The number that the parameter's name `name` stands for in an expression. The expression gives the value of a key
    /// with the unit `wanted`.
    pub(super) fn denoted(&self, name: &str, wanted: Option<&'static NamedUnit>) -> f64 {
        self.conversion(name, wanted).of(self.given)
    }

    /// The conversion from the parameter's number to the number that `name` denotes in an expression for a key with the
    /// unit `wanted`. The short name denotes the value in the key's unit if parameter and key measure the same
    /// quantity. Otherwise, the short name denotes the value in SI.
    pub(super) fn conversion(&self, name: &str, wanted: Option<&'static NamedUnit>) -> Conversion {
        let unit = self.unit.filter(|_| self.short() == Some(name));
        let wanted = wanted.filter(|wanted| unit.is_some_and(|unit| unit::alike(unit, wanted)));
        // If the parameter is given in the key's unit, its number is used without conversion.
        Conversion {
            from: unit.filter(|unit| wanted != Some(*unit)),
            to: wanted.map_or(1.0, |wanted| wanted.to_si(1.0)),
        }
    }

    /// The names of the parameter, each with the number that it denotes in a formula.
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

    /// The index of the parameter that a name denotes.
    pub(super) fn place(&self, name: &str) -> Option<usize> {
        self.places.get(name).copied()
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

/// The graph of an expression of parameters.
pub(super) struct ParameterGraph<'t> {
    /// The names in the expression, in the order of the graph's inputs, each with the index of its parameter.
    pub(super) names: Vec<(usize, &'t str)>,
    pub(super) graph: FormulaGraph,
    pub(super) node: NodeId,
}

impl<'t> ParameterGraph<'t> {
    /// `None` if the tree contains a name that is not the name of a parameter.
    pub(super) fn of(tree: &'t FormulaTree, parameters: &Parameters) -> Option<ParameterGraph<'t>> {
        let words: BTreeSet<&str> =
            tree.names().into_iter().map(|(name, _)| name).filter(|name| *name != "pi").collect();
        let words: Vec<&str> = words.into_iter().collect();
        let named = |word: &&'t str| Some((parameters.place(word)?, *word));
        let names = words.iter().map(named).collect::<Option<_>>()?;
        let mut graph = FormulaGraph::new(&words, 0);
        let node = graph.add(tree).ok()?;
        Some(ParameterGraph { names, graph, node })
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
    let of = |name: &str| Some(Rounded::exact(parameters.called(name)?.denoted(name, wanted)));
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
