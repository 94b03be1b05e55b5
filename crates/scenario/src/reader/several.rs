//! All mistakes of one table, or of several tables, reported at once.

use crate::sentences;
use toml::de::DeValue;

use super::{Entry, TomlTable};
use crate::words::{choice, nearest};
use linkage::error::{Error, ErrorKind, Result};

/// Upper limit of the number of similar keys that are looked up for unknown keys of one table.
const MOST: usize = 20;

/// The mistakes of a file.
#[derive(Debug)]
pub struct Faults {
    all: Vec<Error>,
    /// Whether all parts on which other parts of the file depend could be read. If not, only errors about the keys and
    /// values of a table are reported.
    pub whole: bool,
    /// Whether all links and their points could be read. Errors about unknown names are reported only if all links and
    /// points could be read.
    pub names: bool,
}

impl Faults {
    /// No mistakes.
    pub fn none() -> Self {
        Faults { all: Vec::new(), whole: true, names: true }
    }

    /// The result of `read` for a table. After a mistake, notes the mistake and returns `None`.
    pub fn read<'a, T>(
        &mut self,
        table: &mut TomlTable<'a>,
        read: impl FnOnce(&mut TomlTable<'a>) -> Result<T>,
    ) -> Option<T> {
        let (found, own) = table.tried(self.names, read);
        self.all.extend(own);
        match found {
            Ok(value) => return Some(value),
            Err(Some(error)) if self.whole => self.all.push(error),
            Err(_) => {}
        }
        None
    }

    /// The value. After an error, notes the error and returns `None`.
    pub fn kept<T>(&mut self, value: Result<T>) -> Option<T> {
        value.map_err(|error| self.all.push(error)).ok()
    }

    /// Whether no mistake has been noted.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Returns the noted mistakes as an error, if there are any.
    pub fn end(self) -> Result<()> {
        Error::all(self.all).map_or(Ok(()), Err)
    }
}

impl<'a> TomlTable<'a> {
    /// The result of `read` for the table. All mistakes of its keys and values are reported together.
    /// If there are such mistakes, errors about the meaning of the values are not reported, because the mistakes might
    /// cause these errors.
    pub fn read<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        match self.tried(true, read) {
            (Ok(value), _) => Ok(value),
            (Err(beyond), own) => Err(own.or(beyond).expect("there is an error")),
        }
    }

    /// Reads the table in spite of mistakes. Returns the result of `read`, and the mistakes that `read` notes.
    ///
    /// # Errors
    /// If the reading ends early: the noted mistakes or, if there are no noted mistakes, the error that ends the
    /// reading.
    pub fn read_on<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T>) -> Result<(T, Option<Error>)> {
        self.goes_on = true;
        let found = read(self);
        self.pair_missing();
        let noted = Error::all(std::mem::take(&mut self.faults));
        match found {
            Ok(value) => Ok((value, noted)),
            Err(error) => Err(noted.unwrap_or(error)),
        }
    }

    /// Calls `read`. If there are mistakes of keys or values, returns only these mistakes, as the second part of the
    /// result. Otherwise, returns the value or the error of `read`. Unknown names are such mistakes too, but they are
    /// returned only if `names` is true.
    fn tried<T>(
        &mut self,
        names: bool,
        read: impl FnOnce(&mut Self) -> Result<T>,
    ) -> (std::result::Result<T, Option<Error>>, Option<Error>) {
        self.goes_on = true;
        let found = read(self);
        // The missing keys are noted here, but unknown keys are not noted.
        // The reason: if the reading has stopped early, a key that was not requested yet may still be correct.
        self.pair_missing();
        let unknown = std::mem::take(&mut self.unknown_names);
        let is_sound = self.faults.is_empty() && unknown.is_empty();
        let own = std::mem::take(&mut self.faults).into_iter().chain(unknown.into_iter().filter(|_| names));
        match found {
            Ok(value) if is_sound => (Ok(value), None),
            Err(error) if is_sound => (Err(Some(error)), None),
            _ => (Err(None), Error::all(own)),
        }
    }

    /// The value that was read. After an error, notes the error and returns the default.
    pub fn part<T: Default>(&mut self, read: Result<T>) -> T {
        read.unwrap_or_else(|error| {
            self.faults.push(error);
            T::default()
        })
    }

    /// Returns the noted mistakes as an error, if there are any.
    pub fn sound_so_far(&self) -> Result<()> {
        Error::all(self.faults.iter().cloned()).map_or(Ok(()), Err)
    }

    /// If the reading continues after mistakes, notes an error and returns `value` in place of the wrong value.
    /// If the reading ends at the first mistake, returns the error.
    pub fn instead<T>(&mut self, value: T, error: Error) -> Result<T> {
        if !self.goes_on {
            return Err(error);
        }
        self.faults.push(error);
        Ok(value)
    }

    /// Like `instead`, but for a name that no table of the file defines.
    pub fn unknown_name<T>(&mut self, value: T, error: Error) -> Result<T> {
        if !self.goes_on {
            return Err(error);
        }
        self.unknown_names.push(error);
        Ok(value)
    }

    /// Notes an error after which the rest of the table cannot be read.
    pub(super) fn noted(&mut self, error: Error) -> Error {
        if self.goes_on {
            self.faults.push(error.clone());
        }
        error
    }

    /// The error for a key that is missing under all its spellings.
    /// If an unknown key is a misspelling of the missing key, the misspelling is found after all keys have been
    /// requested.
    pub(super) fn missing(&mut self, spellings: Vec<String>) -> Error {
        self.lacking(spellings, None)
    }

    fn lacking(&mut self, spellings: Vec<String>, help: Option<&'static str>) -> Error {
        let error = self.missing_by(&spellings, help).0;
        if self.goes_on {
            self.missing.push((spellings, help));
        }
        error
    }

    /// The error for missing keys, one of which is required. `help` describes these keys.
    pub fn lacks(&mut self, spellings: &[&str], help: &'static str) -> Error {
        self.lacking(spellings.iter().map(|&spelling| spelling.into()).collect(), Some(help))
    }

    /// The error for a missing key, and the entry whose key is a misspelling of the missing key.
    fn missing_by(&self, spellings: &[String], help: Option<&'static str>) -> (Error, Option<&'a str>) {
        let wanted = choice(spellings.iter().map(String::as_str), "`");
        // In a table with a path, the error already has this path as its key, and the call of `key` does not change it.
        // The top level has no path, so the error gets the name of the missing key.
        let error = self.fault(sentences::is_missing(&wanted)).key(spellings[0].clone());
        let spelling = |key: &str| nearest(key, spellings.iter().map(String::as_str));
        let unread = self.entries.iter().filter(|entry| self.is_unknown(entry));
        match unread.filter_map(|entry| Some((entry, spelling(entry.key)?))).next() {
            Some((entry, spelling)) => {
                let error = Error::new(ErrorKind::Input, sentences::is_missing(&wanted))
                    .key(self.path_of(spelling))
                    .at(self.source.place(entry.key_span.clone()))
                    .help(sentences::there_is_did_you_mean(&entry.key, &spelling));
                (error, Some(entry.key))
            }
            None if help.is_some() => (help.into_iter().fold(error, Error::help), None),
            None if self.path.is_empty() => (error.help(sentences::add_docs_scenario_md_describes(&wanted)), None),
            None => (error.help(sentences::add_to(&wanted, &self.path)), None),
        }
    }

    /// Notes the missing keys. If an unknown key is a misspelling of a missing key, the error of the missing key names
    /// the unknown key.
    fn pair_missing(&mut self) {
        for (spellings, help) in std::mem::take(&mut self.missing) {
            let (error, misspelt) = self.missing_by(&spellings, help);
            self.used.extend(misspelt);
            self.faults.push(error);
        }
    }

    fn is_unknown(&self, entry: &Entry) -> bool {
        !self.used.contains(&entry.key) && !self.asked.iter().any(|asked| asked == entry.key)
    }

    /// Whether the table contains a table or an array that no reader requested.
    pub fn has_unknown_table(&self) -> bool {
        let is_table = |entry: &&Entry| matches!(entry.value.get_ref(), DeValue::Table(_) | DeValue::Array(_));
        self.entries.iter().filter(is_table).any(|entry| self.is_unknown(entry))
    }

    /// Ends the reading. Every key that was not requested is an error.
    /// The error names the nearest known key. If no known key is near, the error names all known keys.
    pub fn finish(&mut self) -> Result<()> {
        #[cfg(test)]
        asked::put(&self.section, &self.asked);
        self.pair_missing();
        let unknown: Vec<&Entry> = self.entries.iter().filter(|entry| self.is_unknown(entry)).collect();
        let asked = || self.asked.iter().map(String::as_str);
        let error = |(count, entry): (usize, &&Entry)| {
            let is_open = |key: &&str| !self.has(key) && !self.settled.iter().any(|settled| settled == key);
            let near = || nearest(entry.key, asked().filter(is_open));
            let help = match (count < MOST).then(near).flatten() {
                Some(near) => sentences::did_you_mean(&near),
                None => sentences::known_here(&(choice(asked(), "`"))),
            };
            Error::new(ErrorKind::Input, sentences::THIS_KEY_IS_NOT_KNOWN_HERE)
                .key(self.path_of(entry.key))
                .at(self.source.place(entry.key_span.clone()))
                .help(help)
        };
        let errors: Vec<Error> = unknown.iter().enumerate().map(error).collect();
        let keys: Vec<&str> = unknown.iter().map(|entry| entry.key).collect();
        self.used.extend(keys);
        self.faults.extend(errors);
        match self.goes_on {
            true => self.sound_so_far(),
            false => Error::all(std::mem::take(&mut self.faults)).map_or(Ok(()), Err),
        }
    }

    /// The values of all successful results. Each error among the results is noted.
    pub(super) fn sound<T>(&mut self, all: Vec<Result<T>>) -> Result<Vec<T>> {
        let sound = all.into_iter().map(|one| one.map(Some).or_else(|error| self.instead(None, error)));
        sound.filter_map(Result::transpose).collect()
    }
}

/// The keys that readers have requested, by section. A test compares these keys with the table of keys.
#[cfg(test)]
pub mod asked {
    use std::cell::RefCell;
    use std::collections::{BTreeMap, BTreeSet};

    thread_local! {
        static ASKED: RefCell<BTreeMap<String, BTreeSet<String>>> = const { RefCell::new(BTreeMap::new()) };
    }

    /// Adds the requested keys of a section.
    pub fn put(section: &str, asked: &[String]) {
        ASKED.with_borrow_mut(|all| all.entry(section.into()).or_default().extend(asked.iter().cloned()));
    }

    /// Forgets all requested keys.
    pub fn forget() {
        ASKED.with_borrow_mut(BTreeMap::clear);
    }

    /// All keys requested since the last call of [`forget`].
    pub fn all() -> BTreeMap<String, BTreeSet<String>> {
        ASKED.with_borrow(Clone::clone)
    }
}
