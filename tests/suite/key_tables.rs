//! The tables of keys in docs/scenario.md and the schema are made from one table of keys.

use scenario::keys::{FileKey, Section, ValueKind, section, sections};

use crate::common::expected::agrees_with;

const DOCUMENT: &str = include_str!("../../docs/scenario.md");
const BEGIN: &str = "<!-- keys of ";
const END: &str = "<!-- end of keys -->\n";

/// The values that a key accepts, for the second column.
fn kind(key: &FileKey) -> String {
    let word = |word: &&str| format!("`\"{word}\"`");
    match key.kind {
        ValueKind::Text => "text".into(),
        ValueKind::Choice(words) => words().iter().map(word).collect::<Vec<_>>().join(", "),
        ValueKind::Texts => "list of texts".into(),
        ValueKind::Number | ValueKind::Quantity(..) => "number".into(),
        ValueKind::Numbers | ValueKind::Quantities(_) => "list of numbers".into(),
        ValueKind::Integer => "whole number".into(),
        ValueKind::IntegerOrBoolean => "whole number, or `true`, `false`".into(),
        ValueKind::Table => "table".into(),
        ValueKind::Tables => "list of tables".into(),
        ValueKind::TableOrTables => "table, or list of tables".into(),
    }
}

fn row(key: &FileKey) -> String {
    let spellings: Vec<String> = key.spellings().iter().map(|spelling| format!("`{spelling}`")).collect();
    let default = if key.is_needed { "required" } else { key.default };
    let cells = [spellings.join(", "), kind(key), key.meaning.into(), default.into()];
    assert!(cells.iter().all(|cell| !cell.is_empty() && !cell.contains('|')), "{key:?}");
    format!("| {} |\n", cells.join(" | "))
}

fn table(section: &Section) -> String {
    let rows: String = section.keys.iter().map(row).collect();
    format!("\n| key | value | meaning | default |\n|---|---|---|---|\n{rows}\n")
}

/// Path of the section that a marker names.
fn path(marker: &str) -> &str {
    let named = marker.strip_suffix(" -->").unwrap_or_else(|| panic!("{marker}"));
    if named == "the file" { "" } else { named.trim_matches('`') }
}

/// The document with renewed tables, and the sections that it documents.
fn renewed(document: &str) -> (String, Vec<&str>) {
    let mut parts = document.split(BEGIN);
    let (mut text, mut paths) = (parts.next().unwrap().to_string(), Vec::new());
    for part in parts {
        let (marker, _) = part.split_once('\n').unwrap();
        let (_, after) = part.split_once(END).unwrap_or_else(|| panic!("no end of the keys of {marker}"));
        let section = section(path(marker)).unwrap_or_else(|| panic!("there is no section {marker}"));
        text.push_str(&format!("{BEGIN}{marker}\n{}{END}{after}", table(section)));
        paths.push(section.path);
    }
    (text, paths)
}

#[test]
fn the_tables_of_keys_in_the_document_are_current() {
    agrees_with("docs/scenario.md", &renewed(DOCUMENT).0, "key_tables");
}

/// If several sections have equal keys, such as the sections of positions, one table may document all of them.
#[test]
fn every_section_has_a_table_in_the_document() {
    let (_, paths) = renewed(DOCUMENT);
    let names = |section: &Section| section.keys.iter().map(|key| key.name).collect::<Vec<_>>();
    for own in sections().filter(|own| own.path != "ground") {
        let is_shown = paths.iter().any(|path| section(path).is_some_and(|shown| names(shown) == names(own)));
        assert!(is_shown, "docs/scenario.md has no `{BEGIN}`{}` -->`", own.path);
    }
}

/// Text outside the tables mentions every permitted value; the tables only list values.
#[test]
fn every_word_is_explained() {
    let outside: String = DOCUMENT
        .split(BEGIN)
        .map(|part| part.split_once(END).map_or(part, |(_, after)| after))
        .flat_map(|part| part.split("```").step_by(2))
        .collect();
    for own in sections() {
        for key in own.keys {
            let ValueKind::Choice(words) = key.kind else { continue };
            for word in words() {
                assert!(outside.contains(word), "{}.{}: \"{word}\"", own.path, key.name);
            }
        }
    }
}
