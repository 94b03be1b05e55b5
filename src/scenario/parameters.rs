//! `[parameters]`: numbers with names, for formulas.

use super::reader::Table;
use super::unit::{self, Unit};
use super::words::suggestion;
use formula::{Function, Rounded};
use linkage::error::{Error, ErrorKind, Result};

/// A number with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The key with its unit, such as `a_mm`: as a name it is the plain number.
    pub key: String,
    /// The number as it was given, in the unit of the key.
    pub given: f64,
    unit: Option<&'static Unit>,
}

impl Parameter {
    fn new(key: &str, given: f64) -> Self {
        Parameter { key: key.into(), given, unit: unit::ending(key).map(|(_, unit)| unit) }
    }

    /// The key without its unit, such as `a`: as a name it is the number in SI. `None` for a key without a unit.
    #[must_use]
    pub fn short(&self) -> Option<&str> {
        self.unit.map(|unit| &self.key[..self.key.len() - unit.suffix.len() - 1])
    }

    /// Its names, each with the number that it stands for.
    pub fn names(&self) -> impl Iterator<Item = (&str, Rounded)> {
        let plain = Rounded::decimal(self.given);
        let si = self.unit.map(|unit| match unit.to_si(1.0) {
            1.0 => plain,
            _ => Rounded::nearly(unit.to_si(self.given)),
        });
        [(self.key.as_str(), plain)].into_iter().chain(self.short().zip(si))
    }
}

/// Names that stand for something else in every formula.
pub const INPUTS: [&str; 2] = ["phi", "t"];

/// What is wrong with the name of a parameter or formula, and the way out.
pub(super) fn fault_of_name(name: &str) -> Option<(String, &'static str)> {
    const HELP: &str = "names begin with a letter and have letters, digits and `_` only";
    let mut bytes = name.bytes();
    let sound = bytes.next().is_some_and(|first| first.is_ascii_alphabetic())
        && bytes.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
        && name.len() <= 100;
    let has_meaning = INPUTS.contains(&name) || name == "pi" || Function::named(name).is_some();
    match (sound, has_meaning) {
        (false, _) => Some((format!("\"{name}\" cannot be a name in a formula"), HELP)),
        (true, true) => Some((format!("`{name}` has a meaning in every formula already"), "choose another name")),
        (true, false) => None,
    }
}

/// Reads the section, with the numbers that are `set` instead of the file's own. Keys that the file does not have are
/// added where the caller allows it.
pub(super) fn read(table: Option<Table>, set: &[(String, f64)], may_add: bool) -> Result<Vec<Parameter>> {
    let mut parameters: Vec<Parameter> = Vec::new();
    if let Some(mut table) = table {
        for key in table.keys() {
            let value = table.number(&key)?;
            let fault = |(message, help): (String, &str)| table.wrong(ErrorKind::Input, &key, message).help(help);
            let parameter = Parameter::new(&key, value);
            let faulty = parameter.names().find_map(|(name, _)| fault_of_name(name));
            if let Some(found) = faulty.or_else(|| twice(&parameters, &parameter)) {
                return Err(fault(found));
            }
            parameters.push(parameter);
        }
        table.finish()?;
    }
    for (key, value) in set {
        let wrong = |message: String| Error::new(ErrorKind::Input, message).key("--set");
        let parameter = Parameter::new(key, *value);
        if let Some((message, help)) = parameter.names().find_map(|(name, _)| fault_of_name(name)) {
            return Err(wrong(message).help(help));
        }
        if let Some(own) = parameters.iter_mut().find(|own| own.key == *key) {
            own.given = *value;
        } else if !may_add {
            let keys = parameters.iter().map(|own| own.key.as_str());
            return Err(wrong(format!("the scenario has no parameter `{key}`")).help(suggestion(key, keys, "`")));
        } else if let Some((message, _)) = twice(&parameters, &parameter) {
            return Err(wrong(message).help("set the parameter with the unit that the file gives it"));
        } else {
            parameters.push(parameter);
        }
    }
    Ok(parameters)
}

/// A name of a parameter that another has too.
fn twice(others: &[Parameter], parameter: &Parameter) -> Option<(String, &'static str)> {
    let is_other = |name: &str| others.iter().find(|other| other.names().any(|(own, _)| own == name));
    let (name, other) = parameter.names().find_map(|(name, _)| Some((name, is_other(name)?)))?;
    let message = format!("`{name}` would stand for `{}` and for `{}`", other.key, parameter.key);
    Some((message, "keep one of the two, or call one otherwise"))
}
