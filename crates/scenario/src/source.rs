//! The file of a scenario: positions in the file, and its spanned tree.
//! If an error of the `linkage` crate names a key, this module finds the key's position.

use crate::sentences;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys::key;
use super::malformed;
use super::parameters::Parameters;
use linkage::error::{Error, ErrorKind, KeyPath, Place, Result};
use linkage::mechanism::{LONGEST_NAME, is_unseen};

/// Longest text (characters).
const LONGEST_TEXT: usize = 10_000;

/// Upper limit of the number of values in a file.
/// The number of values is estimated by the number of the characters `,` `=` `[` `{` `.`.
/// Every value needs some 200 bytes of memory, even if its text is short.
/// The limit therefore also bounds the memory. It is checked before the text is parsed.
const MOST_VALUES: usize = 2_000_000;

/// Upper limit of the number of parts of a file: tables, such as points, links, joints, loads and formulas.
/// Published numbers are not counted as parts.
/// The time of some computations grows with the square of the number of parts. At the limit, they take some seconds.
const MOST_PARTS: usize = 30_000;
const UNCOUNTED: &str = "oracle";

const UNSEEN_HELP: &str = sentences::TAKE_OUT_LINE_BREAKS_CONTROL;

/// The text of the scenario file at `path`.
pub fn text_of(path: &Path) -> Result<String> {
    files::read_text(path).map_err(|error| {
        Error::new(ErrorKind::Io, sentences::the_scenario_cannot_be_read(&path.display(), &error))
            .help(files::way_out(&error, sentences::GIVE_THE_PATH_OF_A_SCENARIO))
    })
}

/// Text of a file and the path that messages use for it.
#[derive(Clone)]
pub struct Source<'a> {
    /// Path as the user gave it.
    pub path: &'a Path,
    /// Whole text.
    pub text: &'a str,
    /// Parameters that the numbers of the file may use.
    pub parameters: Parameters,
    /// The rows of the table of keys for a section, by the path of the section; empty for files that are not scenarios.
    pub rows: fn(&str) -> &'static [key::FileKey],
    /// A copy of the whole text. The positions in errors share this copy.
    shared: Arc<str>,
}

impl<'a> Source<'a> {
    /// A file without parameters.
    pub fn new(path: &'a Path, text: &'a str) -> Self {
        Source { path, text, parameters: Parameters::default(), rows: |_| &[], shared: text.into() }
    }

    /// The same file with parameters, and with the rows of its sections.
    pub fn with(self, parameters: Parameters, rows: fn(&str) -> &'static [key::FileKey]) -> Self {
        Source { parameters, rows, ..self }
    }

    /// Position of a byte range.
    pub fn place(&self, span: Range<usize>) -> Place {
        Place { file: self.path.to_path_buf(), text: self.shared.clone(), span }
    }

    /// The spanned tree of the file.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] with the position, for invalid TOML and for forbidden characters or lengths.
    pub fn tree(&self) -> Result<Spanned<DeTable<'a>>> {
        self.check_size()?;
        let tree = DeTable::parse(self.text)
            .map_err(|error| malformed::no_toml(self.text, &|span| self.place(span), &error))?;
        self.check_table(tree.get_ref(), "", &mut 0)?;
        Ok(tree)
    }

    /// `error` and the errors that were found with it.
    /// If any of these errors has a key but no position, it gets the position of the key.
    pub fn located(&self, tree: &DeTable, error: Error) -> Error {
        error.each_in_order(|error| {
            if error.place().is_some() {
                return error;
            }
            let span = error.key_at_fault().map_or(0..0, |key| locate(tree, key));
            error.at(self.place(span))
        })
    }

    /// Limits the number of values, so that the memory is sufficient to parse the text.
    fn check_size(&self) -> Result<()> {
        let mut signs = self.text.bytes().enumerate().filter(|(_, byte)| b",=[{.".contains(byte));
        let Some((at, _)) = signs.nth(MOST_VALUES) else { return Ok(()) };
        Err(Error::new(ErrorKind::Input, sentences::the_file_has_more_than_values(&MOST_VALUES))
            .at(self.place(at..at + 1))
            .help(sentences::DIVIDE_IT_OR_TAKE_A_COARSER))
    }

    /// Checks all keys and texts of a table.
    /// Keys and texts must not contain invisible characters or be longer than a limit.
    ///
    /// Titles, sources and names go into reports, tables, drawings and recordings.
    /// A line break in a title could imitate a line of a report, and an escape character could control a terminal.
    /// A change of the writing direction could make a name look like another name.
    fn check_table(&self, table: &DeTable, path: &str, parts: &mut usize) -> Result<()> {
        for (key, value) in table {
            let name: &str = key.get_ref();
            let wrong = if name.contains(is_unseen) {
                Some((sentences::A_KEY_HOLDS_A_LETTER_THAT_IS_NOT_SEEN.to_string(), UNSEEN_HELP))
            } else if name.chars().count() > LONGEST_NAME {
                Some((sentences::a_key_has_more_than_letters(&LONGEST_NAME), sentences::GIVE_IT_A_SHORTER_NAME))
            } else {
                None
            };
            if let Some((message, help)) = wrong {
                let error = Error::new(ErrorKind::Input, message).at(self.place(key.span())).help(help);
                return Err(if path.is_empty() { error } else { error.key(path) });
            }
            let path = if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
            self.check_value(value, &path, parts)?;
        }
        Ok(())
    }

    #[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
    fn check_value(&self, value: &Spanned<DeValue>, path: &str, parts: &mut usize) -> Result<()> {
        let (message, help) = match value.get_ref() {
            DeValue::String(text) if text.contains(is_unseen) => {
                (sentences::THE_TEXT_HOLDS_A_LETTER_THAT_IS_NOT_SEEN.into(), UNSEEN_HELP)
            }
            DeValue::String(text) if text.chars().count() > LONGEST_TEXT => {
                (sentences::the_text_has_more_than_letters(&LONGEST_TEXT), "shorten it")
            }
            DeValue::Table(_) if *parts >= MOST_PARTS => {
                let parts = sentences::POINTS_LINKS_JOINTS_LOADS_FORMULAS;
                (sentences::the_file_has_more_than_parts(&MOST_PARTS, &parts), sentences::DIVIDE_IT_INTO_SEVERAL_FILES)
            }
            DeValue::Table(own) => {
                *parts += usize::from(!path.starts_with(UNCOUNTED));
                return self.check_table(own, path, parts);
            }
            DeValue::Array(array) => {
                return array.iter().try_for_each(|element| self.check_value(element, path, parts));
            }
            _ => return Ok(()),
        };
        Err(Error::new(ErrorKind::Input, message).key(path).at(self.place(value.span())).help(help))
    }
}

/// Position of a key. If the key does not exist, the position is that of the nearest existing parent.
/// Elements of an array are found by their name (`joints.A`), Assur groups by their links.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
fn locate(tree: &DeTable, key: &KeyPath) -> Range<usize> {
    let mut segments = key.path().split('.');
    let Some(mut found) = segments.next().and_then(|first| tree.get(first)) else { return 0..0 };
    for segment in segments {
        let next = match found.get_ref() {
            DeValue::Table(table) => table.get(segment),
            DeValue::Array(array) => array.iter().find(|element| named(element, segment)),
            _ => None,
        };
        match next {
            Some(next) => found = next,
            None => return found.span(),
        }
    }
    let group = found.get_ref().as_array().filter(|_| !key.links().is_empty());
    group.and_then(|groups| groups.iter().find(|element| has_links(element, key.links()))).unwrap_or(found).span()
}

fn named(element: &Spanned<DeValue>, name: &str) -> bool {
    element.get_ref().get("name").and_then(|found| found.get_ref().as_str()) == Some(name)
}

fn has_links(element: &Spanned<DeValue>, links: &[String]) -> bool {
    let Some(found) = element.get_ref().get("links").and_then(|found| found.get_ref().as_array()) else {
        return false;
    };
    let found: Vec<&str> = found.iter().filter_map(|name| name.get_ref().as_str()).collect();
    found.len() == links.len() && links.iter().all(|link| found.contains(&link.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[links.rocker.points]\nB = { x_mm = 1 }\n[[joints]]\nname = \"A\"\n[[joints]]\nname = \"B\"\n\
                        [start]\n[[start.groups]]\nlinks = [\"a\", \"b\"]\n[[start.groups]]\nlinks = [\"c\", \"d\"]\n";

    #[test]
    fn keys_are_found_in_the_file() {
        let source = Source::new(Path::new("x.toml"), TEXT);
        let tree = source.tree().unwrap();
        let line = |key: KeyPath| source.place(locate(tree.get_ref(), &key)).line();
        let group = |links: [&str; 2]| line(KeyPath::of_group("start.groups", links.map(String::from).to_vec()));
        assert_eq!((group(["d", "c"]), group(["a", "d"])), (10, 8));
        let line = |key: &str| line(key.into());
        assert_eq!(line("links.rocker.points.B"), 2);
        assert_eq!(line("joints"), 3);
        assert_eq!(line("joints.B"), 5);
        assert_eq!(line("links.rocker.mass"), 1);
        assert_eq!(line("nothing.here"), 1);
    }
}
