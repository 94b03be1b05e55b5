//! The file of a scenario: places in it, its spanned tree, and the place of a key that an error of the `linkage` crate
//! names.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys::key::Key;
use super::parameters::Parameters;
use super::{hostile, malformed};
use linkage::error::{Error, ErrorKind, Place, Result};

/// The text of the scenario file at `path`.
pub fn text_of(path: &Path) -> Result<String> {
    files::read_text(path).map_err(|error| {
        Error::new(ErrorKind::Io, format!("the scenario {} cannot be read: {error}", path.display()))
            .help(files::way_out(&error, "give the path of a scenario file, such as four_bar.toml"))
    })
}

/// Text of a file and the path that messages use for it.
pub struct Source<'a> {
    /// Path as the user gave it.
    pub path: &'a Path,
    /// Whole text.
    pub text: &'a str,
    /// Parameters that its numbers may use.
    pub parameters: Parameters,
    /// The rows of the table of keys for a section, by its path; none of files that are no scenarios.
    pub rows: fn(&str) -> &'static [Key],
    /// The text once more, for places.
    shared: Arc<str>,
}

impl<'a> Source<'a> {
    /// A file without parameters.
    pub fn new(path: &'a Path, text: &'a str) -> Self {
        Source { path, text, parameters: Parameters::default(), rows: |_| &[], shared: text.into() }
    }

    /// The same file with parameters, whose sections have these rows.
    pub fn with(self, parameters: Parameters, rows: fn(&str) -> &'static [Key]) -> Self {
        Source { parameters, rows, ..self }
    }

    /// Place of a byte range.
    pub fn place(&self, span: Range<usize>) -> Place {
        Place { file: self.path.to_path_buf(), text: self.shared.clone(), span }
    }

    /// The spanned tree of the file.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] with the place, for what is no TOML, and for what no text of a file may hold.
    pub fn tree(&self) -> Result<Spanned<DeTable<'a>>> {
        hostile::check_size(&|span| self.place(span), self.text)?;
        let tree = DeTable::parse(self.text)
            .map_err(|error| malformed::no_toml(self.text, &|span| self.place(span), &error))?;
        hostile::check(&|span| self.place(span), tree.get_ref())?;
        Ok(tree)
    }

    /// `error`, and those that were found with it: each with the place of its key, if it has a key and no place yet.
    pub fn located(&self, tree: &DeTable, error: Error) -> Error {
        error.each_in_order(|error| {
            if error.place().is_some() {
                return error;
            }
            let span = error.scenario_key().map_or(0..0, |key| locate(tree, key));
            error.at(self.place(span))
        })
    }
}

/// Place of the dotted `key`, or else of the nearest existing parent. Elements of an array are found by their name
/// (`joints.A`), Assur groups by their links (`start.groups (coupler, rocker)`).
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the TOML parser")]
pub fn locate(tree: &DeTable, key: &str) -> Range<usize> {
    let (path, links) = match key.split_once(" (") {
        Some((path, rest)) => (path, Some(rest.trim_end_matches(')').split(", ").collect::<Vec<_>>())),
        None => (key, None),
    };
    let mut segments = path.split('.');
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
    let group = links.and_then(|links| found.get_ref().as_array()?.iter().find(|element| has_links(element, &links)));
    group.unwrap_or(found).span()
}

fn named(element: &Spanned<DeValue>, name: &str) -> bool {
    element.get_ref().get("name").and_then(|found| found.get_ref().as_str()) == Some(name)
}

fn has_links(element: &Spanned<DeValue>, links: &[&str]) -> bool {
    let Some(found) = element.get_ref().get("links").and_then(|found| found.get_ref().as_array()) else {
        return false;
    };
    let found: Vec<&str> = found.iter().filter_map(|name| name.get_ref().as_str()).collect();
    found.len() == links.len() && links.iter().all(|link| found.contains(link))
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
        let line = |key: &str| source.place(locate(tree.get_ref(), key)).line();
        assert_eq!(line("links.rocker.points.B"), 2);
        assert_eq!(line("joints"), 3);
        assert_eq!(line("joints.B"), 5);
        assert_eq!(line("start.groups (d, c)"), 10);
        assert_eq!(line("start.groups (a, d)"), 8);
        assert_eq!(line("links.rocker.mass"), 1);
        assert_eq!(line("nothing.here"), 1);
    }
}
