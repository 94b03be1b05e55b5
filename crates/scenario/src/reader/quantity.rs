//! Quantities: numbers whose key ends in their unit.

use toml::Spanned;
use toml::de::DeValue;

use super::{Entry, Needed, Table, found};
use crate::unit::{Family, Unit};
use crate::words::choice;
use linkage::error::{Error, ErrorKind, Result};

/// Smallest size of a quantity in SI whose products with others, and their squares, are numbers.
const SMALLEST: f64 = 1e-100;

/// The values that a quantity may have.
#[derive(Clone, Copy, PartialEq, Eq)]
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
    /// The rule that a value breaks, and how to correct it.
    fn broken_by(self, value: f64) -> Option<(&'static str, &'static str)> {
        match self {
            Sign::NotNegative if value < 0.0 => Some(("must not be negative", "give zero or a positive number")),
            Sign::Positive if value <= 0.0 => Some(("must be positive", "give a number greater than zero")),
            Sign::Negative if value >= 0.0 => Some(("must be negative", "give a number less than zero")),
            Sign::NotZero if value == 0.0 => Some(("must not be zero", "give a positive or a negative number")),
            Sign::Any | Sign::NotNegative | Sign::Positive | Sign::Negative | Sign::NotZero => None,
        }
    }

    /// A number that is allowed.
    fn stand_in(self) -> f64 {
        if self == Sign::Negative { -1.0 } else { 1.0 }
    }
}

impl<'a> Table<'a> {
    /// Quantity under one of the spellings of `base` in `family`, in SI; `None` if there is none.
    pub fn optional_quantity(&mut self, base: &str, family: &'static Family, sign: Sign) -> Result<Option<f64>> {
        Ok(self.quantity_in(base, &[family], sign)?.map(|(_, value)| value))
    }

    /// Quantity under one of the spellings of `base` in `family`, in SI.
    pub fn quantity(&mut self, base: &str, family: &'static Family, sign: Sign) -> Result<f64> {
        if let Some(value) = self.optional_quantity(base, family, sign)? {
            return Ok(value);
        }
        let error = self.missing(&family.keys(base));
        if self.goes_on { Ok(sign.stand_in()) } else { Err(error) }
    }

    /// Quantity of one of several families: the index of its family, and its value in SI.
    pub fn quantity_in(
        &mut self,
        base: &str,
        families: &[&'static Family],
        sign: Sign,
    ) -> Result<Option<(usize, f64)>> {
        let (index, at, unit) = match self.spelled(base, families) {
            Ok(None) => return Ok(None),
            Ok(Some(found)) => found,
            // Of several families nobody knows which one is meant.
            Err(error) if families.len() > 1 => return Err(self.noted(error)),
            Err(error) => return self.instead(Some((0, sign.stand_in())), error),
        };
        self.used.insert(self.entries[at].key);
        match self.allowed(at, unit, families[index], sign) {
            Ok(value) => Ok(Some((index, value))),
            Err(error) => self.instead(Some((index, sign.stand_in())), error),
        }
    }

    /// The number of an entry in SI, if it is one of those that are allowed.
    fn allowed(&self, at: usize, unit: &Unit, family: &Family, sign: Sign) -> Result<f64> {
        let entry = &self.entries[at];
        let number = self.finite(entry.key, entry.value)?;
        if let Some((rule, way_out)) = sign.broken_by(number) {
            let found = found(self.source, entry.value);
            let message = format!("found {found}, but {} {rule} here", family.noun);
            return Err(self.wrong_entry(entry, message).help(way_out));
        }
        self.in_range(entry.key, entry.value, unit.to_si(number), family)
    }

    /// Array of quantities under one of the spellings of `base` in `family`, in SI; `None` if there is none.
    pub fn optional_quantities(&mut self, base: &str, family: &'static Family) -> Result<Option<Vec<f64>>> {
        let (at, unit) = match self.spelled(base, &[family]) {
            Ok(None) => return Ok(None),
            Ok(Some((_, at, unit))) => (at, unit),
            Err(error) => return self.instead(Some(vec![0.0]), error),
        };
        let (key, value) = (self.entries[at].key, self.entries[at].value);
        self.used.insert(key);
        let Some(array) = value.get_ref().as_array() else {
            return self.instead(Some(vec![0.0]), self.mistyped(key, value, Needed::Numbers));
        };
        let si = |(index, element): (usize, &Spanned<DeValue>)| {
            let number =
                self.finite(key, element).and_then(|number| self.in_range(key, element, unit.to_si(number), family));
            // No two stand-ins are the same.
            number.or_else(|error| self.instead(index as f64, error))
        };
        array.iter().enumerate().map(si).collect::<Result<_>>().map(Some)
    }

    /// A number in SI that a mechanism may have: zero, or of a size between those of its family.
    fn in_range(&self, key: &str, value: &Spanned<DeValue>, si: f64, family: &Family) -> Result<f64> {
        if si == 0.0 || (SMALLEST..=family.most).contains(&si.abs()) {
            return Ok(si);
        }
        let Family { noun, units, most } = family;
        let message = format!(
            "found {}, but {noun} is zero or of a size from {SMALLEST:e} to {most:e} {}",
            found(self.source, value),
            units[0].suffix
        );
        let error = Error::new(ErrorKind::Input, message).key(self.path_of(key)).at(self.source.place(value.span()));
        Err(error.help("check the unit and the exponent"))
    }

    /// The one entry that spells `base` in a unit of the families: index of its family, its own index, and the unit.
    /// All spellings are recorded as asked for.
    fn spelled(&mut self, base: &str, families: &[&'static Family]) -> Result<Option<(usize, usize, &'static Unit)>> {
        let spellings: Vec<String> = families.iter().flat_map(|family| family.keys(base)).collect();
        let mut present: Vec<usize> =
            spellings.iter().filter_map(|spelling| self.places.get(spelling.as_str()).copied()).collect();
        present.sort_unstable();
        let (first, second) = (present.first().copied(), present.get(1).copied());
        let Some(at) = first else {
            let wrong = self.misspelt_unit(base, families[0], &spellings);
            self.asked.extend_from_slice(&spellings);
            let Some((key, error)) = wrong else { return Ok(None) };
            self.settled.extend_from_slice(&spellings);
            self.used.insert(key);
            return Err(error);
        };
        let key = self.entries[at].key;
        if let Some(second) = second.map(|second| &self.entries[second]) {
            let error = self
                .wrong_entry(second, format!("`{key}` and `{}` are both given", second.key))
                .help("keep one of the two");
            self.asked.extend(spellings);
            return Err(error);
        }
        let unit = |(index, family): (usize, &&'static Family)| Some((index, at, family.unit_of(base, key)?));
        let found = families.iter().enumerate().find_map(unit).expect("the key is one of the spellings");
        self.settled.extend_from_slice(&spellings);
        self.asked.extend(spellings);
        Ok(Some(found))
    }

    /// A key that is `base` without its unit or with an unknown unit, and its error.
    fn misspelt_unit(&self, base: &str, family: &Family, spellings: &[String]) -> Option<(&'a str, Error)> {
        let help = format!("write {}", choice(spellings.iter().map(String::as_str), "`"));
        let is_number =
            |entry: &&Entry| !matches!(entry.value.get_ref(), DeValue::Table(_)) && !self.used.contains(&entry.key);
        if let Some(entry) = self.entry(base).filter(is_number) {
            return Some((entry.key, self.wrong_entry(entry, format!("`{base}` carries no unit")).help(help)));
        }
        let prefixed = |entry: &&Entry| entry.key.strip_prefix(base).is_some_and(|rest| rest.starts_with('_'));
        let entry = self.entries.iter().filter(is_number).find(prefixed)?;
        let message = format!("`{}` does not end in a unit that {} has here", entry.key, family.noun);
        Some((entry.key, self.wrong_entry(entry, message).help(help)))
    }
}
