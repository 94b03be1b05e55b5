//! Typed reading of a spanned TOML table. A reader knows its dotted path and returns typed values.
//! The reader remembers the requested keys. At the end the reader refuses all keys that were not requested.
//!
//! A table that is read by [`TomlTable::read`] reports all mistakes of its keys and values at once.

mod quantity;
mod several;

pub use super::keys::key::Sign;
use crate::sentences;
pub(crate) use quantity::SMALLEST;
pub use several::Faults;
#[cfg(test)]
pub use several::asked;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys::key::FileKey;
use super::numbers::{path_of_entry, plain_number};
use super::parameters::{Parameters, arithmetic};
use super::setting::{EngineSetting, SettingOrigin};
use super::source::Source;
use super::words::suggested;
use formula::FormulaFault;
use linkage::error::{Advice, Error, ErrorKind, Place, Result};

struct Entry<'a> {
    key: &'a str,
    key_span: Range<usize>,
    value: &'a Spanned<DeValue<'a>>,
}

/// A table being read.
pub struct TomlTable<'a> {
    source: &'a Source<'a>,
    name: String,
    path: String,
    span: Range<usize>,
    entries: Vec<Entry<'a>>,
    /// Index of each key in `entries`.
    places: BTreeMap<&'a str, usize>,
    used: BTreeSet<&'a str>,
    asked: Vec<String>,
    /// Whether the reading continues after a mistake.
    goes_on: bool,
    faults: Vec<Error>,
    /// Errors about names that no table of the file defines.
    unknown_names: Vec<Error>,
    /// If one spelling of a key is present, this list contains all spellings of that key.
    settled: Vec<String>,
    /// Spellings of each missing key, and the help for this key.
    missing: Vec<(Vec<String>, Option<&'static str>)>,
    /// Path of this table's section in the table of keys: the keys that lead to the table, with `*` for names.
    section: String,
    /// Rows of this table's section in the table of keys.
    rows: &'static [FileKey],
}

impl<'a> TomlTable<'a> {
    /// Reader of the whole file.
    pub fn root(source: &'a Source<'a>, tree: &'a Spanned<DeTable<'a>>) -> Self {
        TomlTable::new(source, String::new(), 0..0, tree.get_ref())
    }

    fn new(source: &'a Source<'a>, section: String, span: Range<usize>, table: &'a DeTable<'a>) -> Self {
        let mut entries: Vec<Entry> = table
            .iter()
            .map(|(key, value)| Entry { key: key.get_ref().as_ref(), key_span: key.span(), value })
            .collect();
        // If the header of a table comes after the header of one of its child tables, the parser's order differs from
        // the order of the file.
        // The entries are therefore sorted by their position in the file.
        entries.sort_by_key(|entry| entry.key_span.start);
        let places = entries.iter().enumerate().map(|(place, entry)| (entry.key, place)).collect();
        TomlTable {
            source,
            name: String::new(),
            path: String::new(),
            span,
            entries,
            places,
            used: BTreeSet::new(),
            asked: Vec::new(),
            goes_on: false,
            faults: Vec::new(),
            unknown_names: Vec::new(),
            settled: Vec::new(),
            missing: Vec::new(),
            rows: (source.rows)(&section),
            section,
        }
    }

    /// Key of this table, if it is an entry of a table of tables.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The file being read.
    pub fn source(&self) -> &'a Source<'a> {
        self.source
    }

    /// Whether `key` is present, with exactly this spelling.
    pub fn has(&self, key: &str) -> bool {
        self.places.contains_key(key)
    }

    /// The text under `key`, without recording the key as requested; `None` if the key is missing or its value is not a
    /// text.
    pub fn peek(&self, key: &str) -> Option<&'a str> {
        self.entry(key)?.value.get_ref().as_str()
    }

    /// The keys, in the order of the file.
    pub fn keys(&self) -> Vec<String> {
        self.entries.iter().map(|entry| entry.key.to_string()).collect()
    }

    /// Whether the table is empty.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Dotted path of this table.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Dotted path of a key of this table.
    pub fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_string() } else { format!("{}.{key}", self.path) }
    }

    /// An input error about the table as a whole.
    pub fn fault(&self, message: impl Into<String>) -> Error {
        let error = Error::new(ErrorKind::Input, message).at(self.source.place(self.span.clone()));
        if self.path.is_empty() { error } else { error.key(self.path.clone()) }
    }

    /// An error of the given kind about the value of `key`.
    /// `key` is the exact spelling, or the name of a quantity without the unit.
    pub fn wrong(&self, kind: ErrorKind, key: &str, message: impl Into<String>) -> Error {
        let (key, place) = self.spot(key);
        Error::new(kind, message).key(key).at(place)
    }

    /// Refuses the value of `key`: returns the error of [`TomlTable::wrong`] with a help text.
    pub fn refuse<T>(&self, key: &str, message: impl Into<String>, help: impl Into<Advice>) -> Result<T> {
        Err(self.wrong(ErrorKind::Input, key, message).help(help))
    }

    /// Refuses a value that this version does not support.
    pub fn unsupported<T>(&self, key: &str, message: impl Into<String>, help: impl Into<Advice>) -> Result<T> {
        Err(self.wrong(ErrorKind::Unsupported, key, message).help(help))
    }

    /// A setting with the value that was read from `key`. If there is no value, the setting is free.
    pub fn given<T>(&self, key: &str, value: Option<T>) -> EngineSetting<T> {
        value.map_or(EngineSetting::Free, |value| {
            let (key, place) = self.spot(key);
            EngineSetting::Given(value, SettingOrigin::Key(key, place))
        })
    }

    /// Dotted path and position of the value of `key`. If the key is missing, the position of the table is returned.
    fn spot(&self, key: &str) -> (String, Place) {
        let with_unit = |entry: &&Entry| {
            self.used.contains(&entry.key) && entry.key.strip_prefix(key).is_some_and(|rest| rest.starts_with('_'))
        };
        let entry = self.entry(key).or_else(|| self.entries.iter().find(with_unit));
        let (key, span) = entry.map_or((key, self.span.clone()), |entry| (entry.key, entry.value.span()));
        (self.path_of(key), self.source.place(span))
    }

    /// An error about a part of the text of `key`.
    pub fn fault_in(&self, key: &str, fault: &FormulaFault) -> Error {
        match self.entry(key) {
            Some(entry) => self.fault_at(key, entry.value, fault),
            None => self.wrong(ErrorKind::Input, key, fault.message.clone()).help(fault.help.clone()),
        }
    }

    fn fault_at(&self, key: &str, value: &Spanned<DeValue>, fault: &FormulaFault) -> Error {
        let (mut span, text) = (value.span(), value.get_ref().as_str().unwrap_or_default());
        // If the value contains no escapes, its text occurs literally in the file. The error is then placed at the
        // mistake within the text.
        if let Some(offset) = self.source.text[span.clone()].find(text) {
            let start = span.start + offset;
            // A fault beyond the end of the text is located at the last character of the text.
            let (from, to) = (fault.at.start.min(text.len().saturating_sub(1)), fault.at.end);
            span = start + from..start + to.max(from);
        }
        self.wrong_at(key, span, fault.message.clone()).help(fault.help.clone())
    }

    fn wrong_at(&self, key: &str, span: Range<usize>, message: impl Into<String>) -> Error {
        Error::new(ErrorKind::Input, message).key(self.path_of(key)).at(self.source.place(span))
    }

    fn mistyped(&self, key: &str, value: &Spanned<DeValue>, needed: Needed) -> Error {
        let message = sentences::found_but_is_needed(&found(self.source, value), &needed.words());
        self.wrong_at(key, value.span(), message).help(needed.help(&self.path_of(key), value.get_ref()))
    }

    fn entry(&self, key: &str) -> Option<&Entry<'a>> {
        self.places.get(key).map(|&place| &self.entries[place])
    }

    /// Value of `key`. The key is recorded as requested.
    fn take(&mut self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        if !self.asked.iter().any(|own| own == key) {
            self.asked.push(key.to_string());
        }
        let &place = self.places.get(key)?;
        self.used.insert(self.entries[place].key);
        Some(self.entries[place].value)
    }

    fn required<T>(&mut self, key: &str, value: Option<T>) -> Result<T> {
        value.ok_or_else(|| self.missing(vec![key.to_string()]))
    }

    /// The result of `read` for the value of `key`, if the key is present.
    /// If `read` refuses the value, `stand_in` replaces the result. Without a `stand_in`, an error is returned.
    fn scalar<T>(
        &mut self,
        key: &str,
        needed: Needed,
        stand_in: Option<Option<T>>,
        read: impl Fn(&'a DeValue<'a>) -> Option<T>,
    ) -> Result<Option<T>> {
        let Some(value) = self.take(key) else { return Ok(None) };
        match (read(value.get_ref()), stand_in) {
            (Some(found), _) => Ok(Some(found)),
            (None, Some(stand_in)) => self.instead(stand_in, self.mistyped(key, value, needed)),
            (None, None) => Err(self.noted(self.mistyped(key, value, needed))),
        }
    }

    /// Text, if the key is present.
    pub fn optional_string(&mut self, key: &str) -> Result<Option<String>> {
        self.scalar(key, Needed::Text, None, |value| value.as_str().map(ToString::to_string))
    }

    /// The value that `words` assigns to the word under a key, if the key is present. The message for an unknown word
    /// consists of this word and `wrong`, such as "is not an engine".
    pub fn optional_choice<T: Copy>(&mut self, key: &str, wrong: &str, words: &[(&str, T)]) -> Result<Option<T>> {
        let Some(word) = self.optional_string(key)? else { return Ok(None) };
        let found = words.iter().find(|(own, _)| *own == word).map(|(_, meant)| *meant);
        if found.is_none() {
            let known: Vec<&str> = words.iter().map(|(own, _)| *own).collect();
            let error = self.wrong(ErrorKind::Input, key, format!("\"{word}\" {wrong}"));
            return self.instead(None, error.help(suggested(&word, &known)));
        }
        Ok(found)
    }

    /// The value that `words` assigns to the word under a key.
    pub fn choice<T: Copy>(&mut self, key: &str, wrong: &str, words: &[(&str, T)]) -> Result<T> {
        let found = self.optional_choice(key, wrong, words)?;
        match self.faults.last() {
            Some(error) if found.is_none() && self.has(key) => Err(error.clone()),
            _ => self.required(key, found),
        }
    }

    /// Text.
    pub fn string(&mut self, key: &str) -> Result<String> {
        let value = self.optional_string(key)?;
        self.required(key, value)
    }

    /// Whole number, if the key is present.
    pub fn optional_integer(&mut self, key: &str) -> Result<Option<i64>> {
        self.scalar(key, Needed::WholeNumber, Some(Some(1)), |value| {
            value.as_integer().and_then(|number| i64::from_str_radix(number.as_str(), number.radix()).ok())
        })
    }

    /// Whole number.
    pub fn integer(&mut self, key: &str) -> Result<i64> {
        let value = self.optional_integer(key)?;
        self.required(key, value)
    }

    /// Whether a key is present with `true` or `false`.
    pub fn is_boolean(&self, key: &str) -> bool {
        self.entry(key).is_some_and(|entry| entry.value.get_ref().as_bool().is_some())
    }

    /// `true` or `false`, if the key is present.
    pub fn optional_boolean(&mut self, key: &str) -> Result<Option<bool>> {
        self.scalar(key, Needed::Boolean, Some(None), DeValue::as_bool)
    }

    /// Finite number without a unit, if the key is present.
    pub fn optional_number(&mut self, key: &str) -> Result<Option<f64>> {
        let Some(value) = self.take(key) else { return Ok(None) };
        self.finite(key, value).map(Some).or_else(|error| self.instead(None, error))
    }

    /// Finite number, or an arithmetic expression of `parameters`.
    pub fn number_with(&mut self, key: &str, parameters: &Parameters) -> Result<f64> {
        let value = self.take(key);
        let value = self.required(key, value)?;
        self.finite_with(key, value, parameters).or_else(|error| self.instead(1.0, error))
    }

    /// Finite number without a unit.
    pub fn number(&mut self, key: &str) -> Result<f64> {
        let Some(value) = self.take(key) else {
            let error = self.missing(vec![key.to_string()]);
            return if self.goes_on { Ok(1.0) } else { Err(error) };
        };
        self.finite(key, value).or_else(|error| self.instead(1.0, error))
    }

    /// The results of `read` for the elements of an array.
    fn elements<T>(
        &mut self,
        key: &str,
        needed: Needed,
        mut read: impl FnMut(&mut Self, &'a Spanned<DeValue<'a>>) -> Result<T>,
    ) -> Result<Vec<T>> {
        let value = self.take(key);
        let value = self.required(key, value)?;
        let Some(array) = value.get_ref().as_array() else {
            return Err(self.noted(self.mistyped(key, value, needed)));
        };
        array.iter().map(|element| read(self, element)).collect()
    }

    /// Array of finite numbers without a unit.
    pub fn numbers(&mut self, key: &str) -> Result<Vec<f64>> {
        self.elements(key, Needed::Numbers, |own, element| {
            own.finite(key, element).or_else(|error| own.instead(1.0, error))
        })
    }

    /// Array of text.
    pub fn strings(&mut self, key: &str) -> Result<Vec<String>> {
        self.elements(key, Needed::Texts, |own, element| match element.get_ref().as_str() {
            Some(text) => Ok(text.to_string()),
            None => own.instead(String::new(), own.mistyped(key, element, Needed::Text)),
        })
    }

    /// Table, if the key is present.
    pub fn optional_table(&mut self, key: &str) -> Result<Option<TomlTable<'a>>> {
        let Some(value) = self.take(key) else { return Ok(None) };
        self.child(key, self.path_of(key), value).map(Some).or_else(|error| self.instead(None, error))
    }

    /// Table.
    pub fn table(&mut self, key: &str) -> Result<TomlTable<'a>> {
        let value = self.take(key);
        let value = self.required(key, value)?;
        self.child(key, self.path_of(key), value).map_err(|error| self.noted(error))
    }

    /// Elements of an array of tables; empty if the key is missing.
    /// The path of an element contains its name (`joints.A`). The path of an element without a name contains its number
    /// from 1 (`oracle[2]`).
    pub fn tables(&mut self, key: &str) -> Result<Vec<TomlTable<'a>>> {
        let Some(value) = self.take(key) else { return Ok(Vec::new()) };
        let Some(array) = value.get_ref().as_array() else {
            return self.instead(Vec::new(), self.mistyped(key, value, Needed::Tables));
        };
        let child = |(index, element): (usize, &'a Spanned<DeValue<'a>>)| {
            let path = path_of_entry(&self.path_of(key), index, element.get_ref());
            self.child(key, path, element)
        };
        let all: Vec<_> = array.iter().enumerate().map(child).collect();
        self.sound(all)
    }

    /// A table or an array of tables; empty if the key is missing.
    pub fn table_or_tables(&mut self, key: &str) -> Result<Vec<TomlTable<'a>>> {
        match self.entry(key).map(|entry| entry.value.get_ref()) {
            Some(DeValue::Array(_)) => self.tables(key),
            _ => Ok(self.optional_table(key)?.into_iter().collect()),
        }
    }

    /// The same as [`TomlTable::table_or_tables`], but at least one table is required.
    pub fn needed_tables(&mut self, key: &str) -> Result<Vec<TomlTable<'a>>> {
        let tables = self.table_or_tables(key)?;
        if tables.is_empty() { Ok(vec![self.table(key)?]) } else { Ok(tables) }
    }

    /// All entries, in the order of the file. Each entry must be a table.
    pub fn all_tables(&mut self) -> Result<Vec<TomlTable<'a>>> {
        self.used = self.entries.iter().map(|entry| entry.key).collect();
        let child = |entry: &Entry<'a>| self.child(entry.key, self.path_of(entry.key), entry.value);
        let all: Vec<_> = self.entries.iter().map(child).collect();
        self.sound(all)
    }

    #[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
    fn child(&self, key: &str, path: String, value: &'a Spanned<DeValue<'a>>) -> Result<TomlTable<'a>> {
        match value.get_ref() {
            DeValue::Table(table) => {
                // A key that no reader requested literally is a user-defined name, so `*` replaces it in the path.
                let own = if self.asked.iter().any(|own| own == key) { key } else { "*" };
                let section = if self.section.is_empty() { own.into() } else { format!("{}.{own}", self.section) };
                Ok(TomlTable { name: key.into(), path, ..TomlTable::new(self.source, section, value.span(), table) })
            }
            _ => Err(self.mistyped(key, value, Needed::Table)),
        }
    }

    fn finite(&self, key: &str, value: &Spanned<DeValue>) -> Result<f64> {
        self.finite_with(key, value, &self.source.parameters)
    }

    fn finite_with(&self, key: &str, value: &Spanned<DeValue>, parameters: &Parameters) -> Result<f64> {
        if let DeValue::String(text) = value.get_ref() {
            return arithmetic(text, key, parameters).map_err(|fault| self.fault_at(key, value, &fault));
        }
        let number = plain_number(value.get_ref()).ok_or_else(|| self.mistyped(key, value, Needed::Number))?;
        if number.is_finite() { Ok(number) } else { Err(self.mistyped(key, value, Needed::FiniteNumber)) }
    }
}

linkage::words! {
    /// The type of value that a key needs.
    #[derive(Clone, Copy)]
    enum Needed: words {
        Text = "text",
        Texts = sentences::AN_ARRAY_OF_TEXTS,
        Number = "a number",
        FiniteNumber = sentences::A_FINITE_NUMBER,
        Numbers = sentences::AN_ARRAY_OF_NUMBERS,
        WholeNumber = sentences::A_WHOLE_NUMBER,
        Boolean = sentences::TRUE_OR_FALSE,
        Table = "a table",
        Tables = sentences::AN_ARRAY_OF_TABLES,
    }
}

impl Needed {
    /// Help text that says how to correct the value that was found at a dotted path.
    fn help(self, path: &str, found: &DeValue) -> String {
        let help = match (self, found) {
            (Needed::Text, DeValue::Integer(_) | DeValue::Float(_)) => sentences::PUT_THE_TEXT_IN_QUOTES,
            (Needed::Text, _) => sentences::PUT_A_TEXT_IN_QUOTES_THERE,
            (Needed::Texts, _) => sentences::WRITE_TEXTS_IN_BRACKETS_SUCH_AS_GROUND,
            (Needed::Number, _) => sentences::WRITE_A_DECIMAL_NUMBER_SUCH_AS_WITHOUT,
            (Needed::FiniteNumber, _) => sentences::WRITE_A_DECIMAL_NUMBER_NAN,
            (Needed::Numbers, _) => sentences::WRITE_NUMBERS_IN_BRACKETS_SUCH_AS,
            (Needed::WholeNumber, _) => sentences::WRITE_A_WHOLE_NUMBER_SUCH_AS,
            (Needed::Boolean, _) => sentences::WRITE_TRUE_OR_FALSE_WITHOUT,
            (Needed::Table, DeValue::Array(_)) => return format!("write [{path}]"),
            (Needed::Table, _) => sentences::WRITE_KEYS_WITH_THEIR_VALUES,
            (Needed::Tables, DeValue::Table(_)) => return format!("write [[{path}]]"),
            (Needed::Tables, _) => return sentences::write_a_section_for_each(&path),
        };
        help.into()
    }
}

/// A value as written in the file, for messages.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
fn found(source: &Source, value: &Spanned<DeValue>) -> String {
    match value.get_ref() {
        DeValue::Table(_) => "a table".into(),
        DeValue::Array(_) => "an array".into(),
        // A text that does not occur at its position in the file is a number that has replaced the number of the file.
        DeValue::String(text) if !source.text.get(value.span()).is_some_and(|own| own.contains(&**text)) => {
            text.to_string()
        }
        _ => source.text.get(value.span()).unwrap_or("another value").to_string(),
    }
}
