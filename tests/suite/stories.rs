//! docs/stories.md lists every numbered story of the tests, and nothing else.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Location of a story's test: file relative to `tests/`, and the function.
type Place = (String, String);

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files with the given extension below `directory` (relative to the package), with their texts.
fn texts(directory: &str, extension: &str) -> Vec<(PathBuf, String)> {
    let (mut found, mut open) = (Vec::new(), vec![root().join(directory)]);
    while let Some(directory) = open.pop() {
        for entry in std::fs::read_dir(&directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|own| own == extension) {
                let text = std::fs::read_to_string(&path).unwrap();
                found.push((path, text));
            }
        }
    }
    found
}

/// Adds a story, which must not be present yet.
fn add(stories: &mut BTreeMap<u32, Place>, number: u32, place: Place) {
    let other = stories.insert(number, place.clone());
    assert_eq!(other, None, "story {number} has two tests, the second in {place:?}");
}

/// Stories of a test file: a doc comment that starts with `Story NN.` and the function that follows it.
fn told(text: &str) -> Vec<(u32, String)> {
    let (mut found, mut number) = (Vec::new(), None);
    for line in text.lines().map(str::trim_start) {
        let story = line.strip_prefix("/// Story ").and_then(|rest| rest.split_once('.'));
        if let Some(story) = story.and_then(|(digits, _)| digits.parse().ok()) {
            assert_eq!(number.replace(story), None, "a story without a test: {line}");
        } else if let Some(name) = line.strip_prefix("fn ").and_then(|rest| rest.split_once('(')) {
            found.extend(number.take().map(|number| (number, name.0.to_string())));
        }
    }
    assert_eq!(number, None, "a story without a test");
    found
}

/// Stories of the index: rows `| number | symptom | cause | file | test |`.
fn listed(page: &str) -> BTreeMap<u32, Place> {
    let mut stories = BTreeMap::new();
    for line in page.lines() {
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(|cell| cell.trim().trim_matches('`')).collect();
        let Some(number) = cells[0].parse().ok().filter(|_| line.starts_with('|')) else { continue };
        let [_, symptom, cause, file, test] = cells[..] else { panic!("not five cells: {line}") };
        assert!(!symptom.is_empty() && !cause.is_empty(), "an empty cell: {line}");
        add(&mut stories, number, (file.to_string(), test.to_string()));
    }
    stories
}

/// Numbers that a text cites: `story 14`, `stories 12, 51`, `stories 65 to 67`.
fn cited(text: &str) -> Vec<u32> {
    let text = format!(" {}", text.to_lowercase().replace(['(', '\n'], " "));
    let mentions = text.match_indices(" story ").chain(text.match_indices(" stories "));
    let numbers = mentions.flat_map(|(at, word)| {
        let list = text[at + word.len()..].split(|c: char| !(c.is_ascii_digit() || ", to".contains(c))).next();
        let digits = list.unwrap_or("").split(|c: char| !c.is_ascii_digit());
        digits.filter_map(|digits| digits.parse().ok()).collect::<Vec<u32>>()
    });
    numbers.collect()
}

fn index() -> BTreeMap<u32, Place> {
    listed(&std::fs::read_to_string(root().join("docs/stories.md")).unwrap())
}

#[test]
fn the_index_lists_exactly_the_stories_of_the_tests() {
    let mut stories = BTreeMap::new();
    for (path, text) in texts("tests", "rs") {
        let file = path.strip_prefix(root().join("tests")).unwrap().to_string_lossy().replace('\\', "/");
        for (number, test) in told(&text) {
            add(&mut stories, number, (file.clone(), test));
        }
    }
    let index = index();
    for (number, (file, test)) in &stories {
        let Some((listed, name)) = index.get(number) else { panic!("docs/stories.md lacks story {number}, {test}") };
        assert_eq!(name, test, "docs/stories.md: wrong test of story {number}");
        // A path in the index may leave out leading directories.
        assert!(Path::new(file).ends_with(listed), "docs/stories.md: story {number} is in {file}, not in {listed}");
    }
    for number in index.keys() {
        assert!(stories.contains_key(number), "docs/stories.md lists story {number}, which no test has");
    }
}

#[test]
fn every_number_in_the_name_of_a_test_is_listed() {
    let index = index();
    for (path, text) in texts("tests", "rs") {
        for line in text.lines().filter_map(|line| line.trim_start().strip_prefix("fn regress_")) {
            let digits: String = line.chars().take_while(char::is_ascii_digit).collect();
            let Ok(number) = digits.parse() else { continue };
            assert!(index.contains_key(&number), "{}: regress_{line} has no story", path.display());
        }
    }
}

#[test]
fn every_story_that_is_cited_is_listed() {
    let index = index();
    let places =
        [("docs", "md"), ("src", "rs"), ("crates", "rs"), ("tests", "rs"), ("benches", "rs"), ("examples", "rs")];
    let mut count = 0;
    for (path, text) in places.iter().flat_map(|(directory, extension)| texts(directory, extension)) {
        // This file cites numbers of stories that do not exist, as examples, so the check skips this file.
        if path.ends_with("stories.rs") {
            continue;
        }
        for number in cited(&text) {
            assert!(index.contains_key(&number), "{} cites story {number}, which is not listed", path.display());
            count += 1;
        }
    }
    assert!(count > index.len(), "citations are not found");
}

#[test]
fn stories_are_parsed_from_comments_and_tables() {
    let text = "/// Story 99. Symptom: none.\n/// Story line.\n#[test]\nfn regress_99_x() {\n}\nfn other() {}\n";
    assert_eq!(told(text), [(99, "regress_99_x".to_string())]);
    assert_eq!(cited("as in story 7, see stories 12, 51 and (stories 65 to 67). History 8"), [7, 12, 51, 65, 67]);
    let page = "| story | a | b | file | test |\n|---|---|---|---|---|\n| 7 | x | y | `a.rs` | `b` |\n";
    assert_eq!(listed(page), BTreeMap::from([(7, ("a.rs".to_string(), "b".to_string()))]));
}
