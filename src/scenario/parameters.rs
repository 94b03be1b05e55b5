//! Parameters: numbers with names, for other numbers and for formulas.

use super::unit::{self, Unit};
use super::words::suggestion;
use formula::{Fault, Function, Graph, Program, Rounded, Tree};

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
    pub(super) fn new(key: &str, given: f64) -> Self {
        Parameter { key: key.into(), given, unit: unit::ending(key).map(|(_, unit)| unit) }
    }

    /// The key without its unit, such as `a`: as a name it is the number in SI. `None` for a key without a unit.
    #[must_use]
    pub fn short(&self) -> Option<&str> {
        self.unit.map(|unit| &self.key[..self.key.len() - unit.suffix.len() - 1])
    }

    /// Its unit, as its key ends.
    #[must_use]
    pub fn unit(&self) -> Option<&'static str> {
        self.unit.map(|unit| unit.suffix)
    }

    /// Whether it is an angle, by its unit.
    #[must_use]
    pub fn is_angle(&self) -> bool {
        self.unit.is_some_and(|unit| unit::ANGLE.units.contains(unit))
    }

    /// The name that stands for it in SI: the short one, or its key if that has no unit.
    #[must_use]
    pub fn quantity(&self) -> &str {
        self.short().unwrap_or(&self.key)
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

/// The number that `text` gives for a key: an arithmetic of numbers and parameters. Short names of parameters count in
/// the key's unit where they measure the same quantity (`length_mm = "2 * a"`), else in SI.
///
/// # Errors
/// What is wrong with the text, with its place.
pub(super) fn arithmetic(text: &str, key: &str, parameters: &[Parameter]) -> std::result::Result<f64, Fault> {
    let tree = Tree::parse(text)?;
    let mut graph = Graph::new(&[], 0);
    let wanted = unit::ending(key).map(|(_, unit)| unit);
    for own in parameters {
        for (name, number) in own.names() {
            let is_short = own.short() == Some(name);
            let of_key = wanted.filter(|wanted| is_short && own.unit.is_some_and(|unit| unit::alike(unit, wanted)));
            // The number itself, where it is given in the key's unit.
            let value = match of_key {
                Some(unit) if Some(unit) == own.unit => own.given,
                Some(unit) => number.value / unit.to_si(1.0),
                None => number.value,
            };
            let id = graph.constant(Rounded::exact(value));
            graph.name(name, id);
        }
    }
    let id = graph.add(&tree).map_err(|fault| {
        let name = &text[fault.at.clone()];
        let help = match parameters.is_empty() {
            true => "write a number, or give it a name in a section [parameters]".into(),
            false => suggestion(name, graph.names(), "`"),
        };
        Fault { help, ..fault }
    })?;
    let value = Program::of(&graph, &[id]).run(&[])[0].value;
    if value.is_finite() {
        return Ok(value);
    }
    let help = "check the arguments of sqrt, ln, asin and acos, and what is divided by".to_string();
    Err(Fault { message: format!("it gives {value}, which is no finite number"), at: 0..text.len(), help })
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
