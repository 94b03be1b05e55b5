//! The description of a section and of a key.

use crate::unit::{
    ACCELERATION, ANGLE, ANGULAR_SPEED, DAMPING, FORCE, INERTIA, INPUT_RATES, INPUTS, INPUTS_OR_TIMES, LENGTH, MASS,
    MOMENT, MOMENT_PER_SPEED, PRESSURE, STIFFNESS, TIME, TORSIONAL_STIFFNESS, UnitFamily,
};

/// A table of a scenario file.
#[derive(Debug)]
pub struct Section {
    /// Keys that lead to this table from the top of the file, separated by dots. `*` means any name.
    pub path: &'static str,
    /// Keys of the table.
    pub keys: &'static [FileKey],
}

/// A key.
#[derive(Clone, Copy, Debug)]
pub struct FileKey {
    /// Name of the key, without the unit of a quantity.
    pub name: &'static str,
    /// Kind of the value.
    pub kind: ValueKind,
    /// Whether the key is required.
    pub is_needed: bool,
    /// Meaning of the key, in one sentence of Markdown.
    pub meaning: &'static str,
    /// The default, in words; empty for a required key.
    pub default: &'static str,
}

/// The kind of value of a key.
#[derive(Clone, Copy, Debug)]
pub enum ValueKind {
    /// Text.
    Text,
    /// One word of a list of words.
    Choice(fn() -> Vec<&'static str>),
    /// A list of texts.
    Texts,
    /// A number, or an arithmetic expression of parameters.
    Number,
    /// A list of numbers.
    Numbers,
    /// A whole number.
    Integer,
    /// A whole number, `true` or `false`.
    IntegerOrBoolean,
    /// A number whose key ends in a unit of one of these families. The sign states which values are allowed.
    Quantity(&'static [&'static UnitFamily], Sign),
    /// A list of numbers whose key ends in a unit of one of these families.
    Quantities(&'static [&'static UnitFamily]),
    /// A table. The section that describes the table has the path of this key.
    Table,
    /// An array of tables.
    Tables,
    /// A table, or an array of tables.
    TableOrTables,
}

impl Section {
    pub(crate) const fn at(path: &'static str) -> Section {
        Section { path, keys: &[] }
    }

    pub(crate) const fn with(self, keys: &'static [FileKey]) -> Section {
        Section { keys, ..self }
    }
}

/// A required key.
pub(crate) const fn needed(name: &'static str, kind: ValueKind) -> FileKey {
    FileKey { name, kind, is_needed: true, meaning: "", default: "" }
}

/// An optional key, and its default in words.
pub(crate) const fn optional(name: &'static str, kind: ValueKind, default: &'static str) -> FileKey {
    FileKey { is_needed: false, default, ..needed(name, kind) }
}

impl FileKey {
    pub(crate) const fn means(self, meaning: &'static str) -> FileKey {
        FileKey { meaning, ..self }
    }

    /// The usual spellings of the key, units included.
    #[must_use]
    pub fn spellings(&self) -> Vec<String> {
        self.spelled(UnitFamily::keys)
    }

    /// All spellings of the key, units included.
    #[must_use]
    pub fn all_spellings(&self) -> Vec<String> {
        self.spelled(UnitFamily::all_keys)
    }

    fn spelled(&self, keys: fn(&UnitFamily, &str) -> Vec<String>) -> Vec<String> {
        match self.kind.families() {
            [] => vec![self.name.into()],
            families => families.iter().flat_map(|family| keys(family, self.name)).collect(),
        }
    }
}

/// Kinds of quantities.
impl ValueKind {
    pub(crate) const ACCELERATIONS: ValueKind = ValueKind::Quantity(&[&ACCELERATION], Sign::Any);
    pub(crate) const ANGLES: ValueKind = ValueKind::Quantity(&[&ANGLE], Sign::Any);
    /// Values of an input, for every kind of input.
    pub(crate) const INPUTS: ValueKind = ValueKind::Quantity(&INPUTS, Sign::Any);
    /// Rates of an input, for every kind of input.
    pub(crate) const INPUT_RATES: ValueKind = ValueKind::Quantity(&INPUT_RATES, Sign::Any);
    pub(crate) const INPUTS_OR_TIMES: ValueKind = ValueKind::Quantity(&INPUTS_OR_TIMES, Sign::Any);
    pub(crate) const DAMPINGS_OR_SLOPES: ValueKind = ValueKind::Quantity(&[&DAMPING, &MOMENT_PER_SPEED], Sign::Any);
    pub(crate) const FORCES: ValueKind = ValueKind::Quantity(&[&FORCE], Sign::Any);
    pub(crate) const PRESSURES: ValueKind = ValueKind::Quantity(&[&PRESSURE], Sign::Any);
    pub(crate) const INERTIAS: ValueKind = ValueKind::Quantity(&[&INERTIA], Sign::Any);
    pub(crate) const LENGTHS: ValueKind = ValueKind::Quantity(&[&LENGTH], Sign::Any);
    pub(crate) const LENGTHS_OR_ANGLES: ValueKind = ValueKind::Quantity(&[&LENGTH, &ANGLE], Sign::Any);
    pub(crate) const MASSES: ValueKind = ValueKind::Quantity(&[&MASS], Sign::Any);
    pub(crate) const MOMENTS: ValueKind = ValueKind::Quantity(&[&MOMENT], Sign::Any);
    pub(crate) const SLOPES: ValueKind = ValueKind::Quantity(&[&MOMENT_PER_SPEED], Sign::Any);
    pub(crate) const SPEEDS: ValueKind = ValueKind::Quantity(&[&ANGULAR_SPEED], Sign::Any);
    pub(crate) const STIFFNESSES_OR_TORSIONAL: ValueKind =
        ValueKind::Quantity(&[&STIFFNESS, &TORSIONAL_STIFFNESS], Sign::Any);
    pub(crate) const TIMES: ValueKind = ValueKind::Quantity(&[&TIME], Sign::Any);
    pub(crate) const LIST_OF_ANGLES: ValueKind = ValueKind::Quantities(&[&ANGLE]);
    pub(crate) const LIST_OF_LENGTHS: ValueKind = ValueKind::Quantities(&[&LENGTH]);
    pub(crate) const LIST_OF_TIMES: ValueKind = ValueKind::Quantities(&[&TIME]);

    /// This kind of value, restricted to quantities with values of the given sign.
    pub(crate) const fn of(self, sign: Sign) -> ValueKind {
        if let ValueKind::Quantity(families, _) = self { ValueKind::Quantity(families, sign) } else { self }
    }

    /// The families of a quantity. The list is empty for any other kind of value.
    pub(crate) const fn families(self) -> &'static [&'static UnitFamily] {
        if let ValueKind::Quantity(families, _) | ValueKind::Quantities(families) = self { families } else { &[] }
    }

    /// The values that a quantity may have.
    pub(crate) const fn sign(self) -> Sign {
        if let ValueKind::Quantity(_, sign) = self { sign } else { Sign::Any }
    }
}

/// The values that a quantity may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Any finite number.
    Any,
    /// Zero or positive.
    NotNegative,
    /// Greater than zero.
    Positive,
    /// Less than zero.
    Negative,
    /// Anything but zero.
    NotZero,
}

impl Sign {
    /// The rule that a value violates, and how to correct the value.
    pub(crate) fn broken_by(self, value: f64) -> Option<(&'static str, &'static str)> {
        match self {
            Sign::NotNegative if value < 0.0 => Some(("must not be negative", "give zero or a positive number")),
            Sign::Positive if value <= 0.0 => Some(("must be positive", "give a number greater than zero")),
            Sign::Negative if value >= 0.0 => Some(("must be negative", "give a number less than zero")),
            Sign::NotZero if value == 0.0 => Some(("must not be zero", "give a positive or a negative number")),
            Sign::Any | Sign::NotNegative | Sign::Positive | Sign::Negative | Sign::NotZero => None,
        }
    }

    /// A number that is allowed.
    pub(crate) fn stand_in(self) -> f64 {
        if self == Sign::Negative { -1.0 } else { 1.0 }
    }
}
