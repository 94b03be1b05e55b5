//! What is told of a section and of a key.

use crate::unit::{
    ACCELERATION, ANGLE, ANGULAR_SPEED, DAMPING, FORCE, Family, INERTIA, INPUTS, INPUTS_OR_TIMES, LENGTH, MASS, MOMENT,
    MOMENT_PER_SPEED, STIFFNESS, TIME, TORSIONAL_STIFFNESS,
};

/// A table of a scenario file.
#[derive(Debug)]
pub struct Section {
    /// Keys that lead to it from the top of the file, with dots; `*` stands for any name.
    pub path: &'static str,
    /// Its keys.
    pub keys: &'static [Key],
}

/// A key.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Its name, without the unit of a quantity.
    pub name: &'static str,
    /// What stands there.
    pub kind: Kind,
    /// Whether it must be there.
    pub is_needed: bool,
    /// What it means, in one sentence of Markdown.
    pub meaning: &'static str,
    /// What holds without it; empty of a key that must be there.
    pub default: &'static str,
}

/// What stands at a key.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// Text.
    Text,
    /// One of these words.
    Choice(fn() -> Vec<&'static str>),
    /// A list of texts.
    Texts,
    /// A number, or an arithmetic of parameters.
    Number,
    /// A list of numbers.
    Numbers,
    /// A whole number.
    Integer,
    /// A whole number, `true` or `false`.
    IntegerOrBoolean,
    /// A number whose key ends in a unit of one of these families.
    Quantity(&'static [&'static Family]),
    /// A list of such numbers.
    Quantities(&'static Family),
    /// A table: the section with the path of the key.
    Table,
    /// An array of tables.
    Tables,
    /// A table, or an array of tables.
    TableOrTables,
}

/// A key that must be there.
pub const fn needed(name: &'static str, kind: Kind, meaning: &'static str) -> Key {
    Key { name, kind, is_needed: true, meaning, default: "" }
}

/// A key that may be left out, and what holds then.
pub const fn optional(name: &'static str, kind: Kind, meaning: &'static str, default: &'static str) -> Key {
    Key { name, kind, is_needed: false, meaning, default }
}

/// Kinds of quantities.
impl Kind {
    pub(crate) const ACCELERATIONS: Kind = Kind::Quantity(&[&ACCELERATION]);
    pub(crate) const ANGLES: Kind = Kind::Quantity(&[&ANGLE]);
    /// Values of an input: see [`unit::of_input`](crate::unit::of_input).
    pub(crate) const INPUTS: Kind = Kind::Quantity(&INPUTS);
    pub(crate) const INPUTS_OR_TIMES: Kind = Kind::Quantity(&INPUTS_OR_TIMES);
    pub(crate) const DAMPINGS_OR_SLOPES: Kind = Kind::Quantity(&[&DAMPING, &MOMENT_PER_SPEED]);
    pub(crate) const FORCES: Kind = Kind::Quantity(&[&FORCE]);
    pub(crate) const INERTIAS: Kind = Kind::Quantity(&[&INERTIA]);
    pub(crate) const LENGTHS: Kind = Kind::Quantity(&[&LENGTH]);
    pub(crate) const LENGTHS_OR_ANGLES: Kind = Kind::Quantity(&[&LENGTH, &ANGLE]);
    pub(crate) const MASSES: Kind = Kind::Quantity(&[&MASS]);
    pub(crate) const MOMENTS: Kind = Kind::Quantity(&[&MOMENT]);
    pub(crate) const SLOPES: Kind = Kind::Quantity(&[&MOMENT_PER_SPEED]);
    pub(crate) const SPEEDS: Kind = Kind::Quantity(&[&ANGULAR_SPEED]);
    pub(crate) const STIFFNESSES_OR_TORSIONAL: Kind = Kind::Quantity(&[&STIFFNESS, &TORSIONAL_STIFFNESS]);
    pub(crate) const TIMES: Kind = Kind::Quantity(&[&TIME]);
    pub(crate) const LIST_OF_ANGLES: Kind = Kind::Quantities(&ANGLE);
    pub(crate) const LIST_OF_TIMES: Kind = Kind::Quantities(&TIME);
}

impl Key {
    /// The spellings of the key, units included.
    #[must_use]
    pub fn spellings(&self) -> Vec<String> {
        match self.kind {
            Kind::Quantity(families) => families.iter().flat_map(|family| family.keys(self.name)).collect(),
            Kind::Quantities(family) => family.keys(self.name),
            Kind::Text
            | Kind::Choice(_)
            | Kind::Texts
            | Kind::Number
            | Kind::Numbers
            | Kind::Integer
            | Kind::IntegerOrBoolean
            | Kind::Table
            | Kind::Tables
            | Kind::TableOrTables => vec![self.name.into()],
        }
    }
}
