//! Remedies in error messages.
//! If a key of a shipped scenario is omitted or misspelt, the error names the correct key.
//! The error never proposes the word that it found in the file.

use std::collections::BTreeMap;
use std::path::Path;

use linkage::Error;
use scenario::{Scenario, files_in};

/// Sections whose keys are names that the author chooses.
const OWN_NAMES: [&str; 4] = ["points", "links", "columns", "parameters"];

/// A key in a text, with its position and the end of its value.
struct Key<'a> {
    section: &'a str,
    name: &'a str,
    start: usize,
    end: usize,
    is_line: bool,
}

/// The keys of a text that belong to the format and have one-line values.
fn keys(text: &str) -> Vec<Key<'_>> {
    let (mut found, mut start, mut section) = (Vec::new(), 0, "");
    for line in text.split_inclusive('\n') {
        let own = line.trim();
        if own.starts_with('[') && own.ends_with(']') {
            section = own.trim_matches(['[', ']']);
        } else if !own.starts_with('#') {
            for (at, _) in line.match_indices(" = ") {
                let from = line[..at].rfind(|c: char| !c.is_alphanumeric() && c != '_').map_or(0, |before| before + 1);
                let is_line = from == 0;
                let quotes = line[..at].matches('"').count();
                if from == at
                    || quotes % 2 == 1
                    || is_line && section.split('.').next_back().is_some_and(|last| OWN_NAMES.contains(&last))
                {
                    continue;
                }
                let end = value_end(line, at + 3);
                found.extend(end.map(|end| Key {
                    section,
                    name: &line[from..at],
                    start: start + from,
                    end: start + end,
                    is_line,
                }));
            }
        }
        start += line.len();
    }
    found
}

/// End of the value that begins at `from` in a line; `None` if the value continues on the next line.
fn value_end(line: &str, from: usize) -> Option<usize> {
    let (mut depth, mut quoted) = (0, false);
    for (at, c) in line[from..].char_indices() {
        match c {
            '"' => quoted = !quoted,
            _ if quoted => {}
            '[' | '{' => depth += 1,
            ']' | '}' if depth == 0 => return Some(from + at),
            ']' | '}' => depth -= 1,
            ',' | '\n' | '#' if depth == 0 => return Some(from + at),
            _ => {}
        }
    }
    None
}

/// Words in backticks that an error proposes in place of the word found.
fn proposed(error: &Error) -> Vec<String> {
    let way_out = error.way_out().unwrap_or_default();
    let (_, after) = way_out.split_once("did you mean ").unwrap_or_default();
    after.split('`').skip(1).step_by(2).map(Into::into).collect()
}

fn says(error: &Error) -> String {
    let key = error.scenario_key().unwrap_or_default();
    format!("{key}: {}; {}", error.message(), error.way_out().unwrap_or_default())
}

/// Whether a text contains the key as a word.
fn names(says: &str, key: &str) -> bool {
    says.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == key)
}

/// Calls `look` with the keys of the shipped scenarios: the file, its text, and the key.
/// If a key occurs often in sections with the same first word, only its first two occurrences are tried.
fn for_each_key(mut look: impl FnMut(&Path, &str, &Key) -> Option<String>) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let all = ["scenarios", "scenarios/formulas"].map(|directory| files_in(root.join(directory)).unwrap());
    let (mut seen, mut tried, mut wrong) = (BTreeMap::new(), 0, Vec::new());
    for path in all.concat() {
        let text = std::fs::read_to_string(&path).unwrap();
        for key in keys(&text) {
            let section = key.section.split('.').next().unwrap_or_default();
            let count = seen.entry((section.to_string(), key.name.to_string(), key.is_line)).or_insert(0);
            *count += 1;
            if *count <= 2 {
                tried += 1;
                wrong.extend(look(&path, &text, &key));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    assert!(tried > 100, "{tried}");
}

#[test]
fn a_misspelt_key_gets_the_right_name_as_remedy() {
    for_each_key(|path, text, key| {
        if key.name.len() < 5 {
            return None;
        }
        // Omits the third letter.
        let misspelt = [&key.name[..2], &key.name[3..]].concat();
        let edited = [&text[..key.start], &misspelt, &text[key.start + key.name.len()..]].concat();
        let error = Scenario::parse(&edited, path).err()?;
        let is_told = names(&says(&error), key.name)
            && error.each().all(|error| !proposed(error).contains(&misspelt))
            && error.place().unwrap().line() == text[..key.start].matches('\n').count() + 1
            && error.each().count() == 1;
        (!is_told).then(|| format!("{}: `{misspelt}` instead of `{}`: {error}", path.display(), key.name))
    });
}

#[test]
fn a_missing_key_is_not_mistaken_for_another() {
    for_each_key(|path, text, key| {
        let rest = &text[key.end..];
        let rest = if key.is_line { rest } else { rest.strip_prefix(", ").unwrap_or(rest) };
        let error = Scenario::parse(&[&text[..key.start], rest].concat(), path).err()?;
        // Nothing in the file is misspelt, so the error must not propose another word.
        let is_told = error.each().all(|error| {
            let is_named = !error.message().ends_with("is missing") || names(&says(error), key.name);
            proposed(error).is_empty() && error.way_out().is_some() && is_named
        });
        (!is_told).then(|| format!("{}: without `{}`: {error}", path.display(), key.name))
    });
}
