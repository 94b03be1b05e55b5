//! Quantities: numbers whose key ends in the unit of the number.

use crate::sentences;
use toml::Spanned;
use toml::de::DeValue;

use super::{Entry, Needed, Sign, TomlTable, found};
use crate::keys::key::FileKey;
use crate::unit::{NamedUnit, UnitFamily, unsupported};
use crate::words::choice;
use linkage::error::{Error, ErrorKind, Result};

/// Family of a quantity, index of the quantity's entry, and unit of the quantity.
type Spelled = (&'static UnitFamily, usize, &'static NamedUnit);

/// Lower limit of the magnitude of a quantity in SI.
/// If all quantities exceed this limit, their squares and products do not underflow.
pub(crate) const SMALLEST: f64 = 1e-100;

impl<'a> TomlTable<'a> {
    /// The row of a quantity in the table of keys. This row states the allowed units and signs.
    fn row(&self, key: &str) -> &'static FileKey {
        let is_own = |row: &&FileKey| row.name == key && !row.kind.families().is_empty();
        self.rows.iter().find(is_own).unwrap_or_else(|| panic!("section `{}` has no quantity `{key}`", self.section))
    }

    /// Whether a quantity is present under one of its spellings.
    pub fn has_si(&self, key: &str) -> bool {
        self.row(key).all_spellings().iter().any(|spelling| self.has(spelling))
    }

    /// Value of a quantity in SI; `None` if the quantity is missing. The row of `key` states the allowed units and
    /// signs.
    pub fn optional_si(&mut self, key: &str) -> Result<Option<f64>> {
        Ok(self.optional_si_of(key)?.map(|(_, value)| value))
    }

    /// A quantity in SI and the family of its unit. The row of the quantity in the table of keys states the units and
    /// the sign. `None` if the quantity is missing.
    pub fn optional_si_of(&mut self, key: &str) -> Result<Option<(&'static UnitFamily, f64)>> {
        let row = self.row(key);
        self.quantity_in(key, row.kind.families(), row.kind.sign())
    }

    /// A list of quantities in SI and the family of their unit. The row of the list in the table of keys states the
    /// units. `None` if the list is missing.
    pub fn optional_si_list(&mut self, key: &str) -> Result<Option<(&'static UnitFamily, Vec<f64>)>> {
        let family = self.row(key).kind.families()[0];
        Ok(self.optional_quantities(key, family)?.map(|values| (family, values)))
    }

    /// Value of a quantity in SI. The row of `key` states the allowed units and signs.
    pub fn si(&mut self, key: &str) -> Result<f64> {
        let row = self.row(key);
        self.quantity(key, row.kind.families()[0], row.kind.sign())
    }

    /// Quantity in SI, under one of the spellings of `base` in `family`; `None` if all spellings are missing.
    pub fn optional_quantity(&mut self, base: &str, family: &'static UnitFamily, sign: Sign) -> Result<Option<f64>> {
        Ok(self.quantity_in(base, &[family], sign)?.map(|(_, value)| value))
    }

    /// Quantity under one of the spellings of `base` in `family`, in SI.
    pub fn quantity(&mut self, base: &str, family: &'static UnitFamily, sign: Sign) -> Result<f64> {
        if let Some(value) = self.optional_quantity(base, family, sign)? {
            return Ok(value);
        }
        let error = self.missing(family.keys(base));
        if self.goes_on { Ok(sign.stand_in()) } else { Err(error) }
    }

    /// Quantity whose unit belongs to one of several families. Returns the family found and the value in SI.
    fn quantity_in(
        &mut self,
        base: &str,
        families: &[&'static UnitFamily],
        sign: Sign,
    ) -> Result<Option<(&'static UnitFamily, f64)>> {
        let (family, at, unit) = match self.spelled(base, families) {
            Ok(None) => return Ok(None),
            Ok(Some(found)) => found,
            // With several families, the intended family is unknown. Therefore no value can replace the wrong value,
            // and the reading ends.
            Err(error) if families.len() > 1 => return Err(self.noted(error)),
            Err(error) => return self.instead(Some((families[0], sign.stand_in())), error),
        };
        self.used.insert(self.entries[at].key);
        let value = self.allowed(at, unit, family, sign).or_else(|error| self.instead(sign.stand_in(), error))?;
        Ok(Some((family, value)))
    }

    /// The number of an entry in SI. Returns an error if the sign or the magnitude of the number is not allowed.
    fn allowed(&self, at: usize, unit: &NamedUnit, family: &UnitFamily, sign: Sign) -> Result<f64> {
        let entry = &self.entries[at];
        let number = self.finite(entry.key, entry.value)?;
        if let Some((rule, way_out)) = sign.broken_by(number) {
            let message = sentences::found_but_here(&found(self.source, entry.value), &family.noun, &rule);
            return self.refuse(entry.key, message, way_out);
        }
        self.in_range(entry.key, entry.value, unit.to_si(number), family)
    }

    /// Array of quantities in SI, under one of the spellings of `base` in `family`; `None` if all spellings are
    /// missing.
    fn optional_quantities(&mut self, base: &str, family: &'static UnitFamily) -> Result<Option<Vec<f64>>> {
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
            // Values that replace wrong values must differ from each other, so the index of the value is used.
            number.or_else(|error| self.instead(index as f64, error))
        };
        array.iter().enumerate().map(si).collect::<Result<_>>().map(Some)
    }

    /// A number in SI that is plausible for a mechanism: zero, or a magnitude within the limits of its family.
    fn in_range(&self, key: &str, value: &Spanned<DeValue>, si: f64, family: &UnitFamily) -> Result<f64> {
        if si == 0.0 || (SMALLEST..=family.most).contains(&si.abs()) {
            return Ok(si);
        }
        let UnitFamily { noun, units, most, .. } = family;
        let (found, unit) = (found(self.source, value), units[0].suffix);
        let message = sentences::found_but_is_zero_or_of_a_size(
            &found,
            &noun,
            &format_args!("{:e}", SMALLEST),
            &format_args!("{most:e}"),
            &unit,
        );
        Err(self.wrong_at(key, value.span(), message).help(sentences::CHECK_THE_UNIT_AND_THE_EXPONENT))
    }

    /// Finds the entry whose key is `base` with a unit of one of the families; returns the family, the entry's index
    /// and the unit. Two such entries are an error.
    /// All spellings are recorded as requested.
    fn spelled(&mut self, base: &str, families: &[&'static UnitFamily]) -> Result<Option<Spelled>> {
        let spellings: Vec<String> = families.iter().flat_map(|family| family.keys(base)).collect();
        let all: Vec<String> = families.iter().flat_map(|family| family.all_keys(base)).collect();
        let mut present: Vec<usize> =
            all.iter().filter_map(|spelling| self.places.get(spelling.as_str()).copied()).collect();
        present.sort_unstable();
        let Some(&at) = present.first() else {
            let wrong = self.misspelt_unit(base, families[0], &spellings);
            self.asked.extend_from_slice(&spellings);
            let Some((key, error)) = wrong else { return Ok(None) };
            self.settled.extend_from_slice(&spellings);
            self.used.insert(key);
            return Err(error);
        };
        let key = self.entries[at].key;
        if let Some(second) = present.get(1).map(|&second| &self.entries[second]) {
            self.asked.extend(spellings);
            let message = sentences::and_are_both_given(&key, &second.key);
            return self.refuse(second.key, message, sentences::KEEP_ONE_OF_THE_TWO);
        }
        let unit = |&family: &&'static UnitFamily| Some((family, at, family.unit_of(base, key)?));
        let found = families.iter().find_map(unit).expect("the key is one of the spellings");
        self.settled.extend_from_slice(&spellings);
        self.asked.extend(spellings);
        Ok(Some(found))
    }

    /// A key that consists of `base` without a unit or with an unknown unit, and the error for this key.
    fn misspelt_unit(&self, base: &str, family: &UnitFamily, spellings: &[String]) -> Option<(&'a str, Error)> {
        let help = format!("write {}", choice(spellings.iter().map(String::as_str), "`"));
        let is_number =
            |entry: &&Entry| !matches!(entry.value.get_ref(), DeValue::Table(_)) && !self.used.contains(&entry.key);
        if let Some(entry) = self.entry(base).filter(is_number) {
            return Some((entry.key, self.wrong(ErrorKind::Input, base, sentences::carries_no_unit(&base)).help(help)));
        }
        let prefixed = |entry: &&Entry| entry.key.strip_prefix(base).is_some_and(|rest| rest.starts_with('_'));
        let entry = self.entries.iter().filter(is_number).find(prefixed)?;
        let (message, help) = match unsupported(entry.key[base.len()..].trim_start_matches('_')) {
            Some((name, size)) => (sentences::is_in_an_unsupported_unit(&entry.key, &name), format!("{help}; {size}")),
            None => (sentences::does_not_end_in_a_unit_that_has_here(&entry.key, &family.noun), help),
        };
        Some((entry.key, self.wrong(ErrorKind::Input, entry.key, message).help(help)))
    }
}
