//! SECURITY.md: every sentence of a guarantee names a test, and every named test exists.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Files that may contain the function of a path such as `robustness::names::x`.
fn places(path: &[&str]) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut rooms = vec![root.join("tests/suite"), root.join("src")];
    rooms.extend(std::fs::read_dir(root.join("crates")).unwrap().map(|own| own.unwrap().path().join("src")));
    let modules: PathBuf = path.iter().filter(|module| **module != "tests").collect();
    rooms.into_iter().map(|room| room.join(&modules).with_extension("rs")).collect()
}

/// Whether a test of this name exists.
fn is_there(name: &str) -> bool {
    let path: Vec<&str> = name.split("::").collect();
    let (function, modules) = path.split_last().unwrap();
    places(modules).iter().filter_map(|file| std::fs::read_to_string(file).ok()).any(|text| {
        let own = text.find(&format!("fn {function}()"));
        own.is_some_and(|at| text[..at].trim_end().ends_with("#[test]"))
    })
}

/// Sentences of a text, each on one line.
fn sentences(text: &str) -> Vec<String> {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    line.trim_end_matches('.').split(". ").map(str::trim).filter(|own| !own.is_empty()).map(String::from).collect()
}

/// Names of tests in a text: all words in backquotes that contain `::`.
fn tests_in(text: &str) -> Vec<String> {
    text.split('`').skip(1).step_by(2).filter(|word| word.contains("::")).map(String::from).collect()
}

#[test]
fn every_sentence_of_a_guarantee_names_an_existing_test() {
    let page = include_str!("../../SECURITY.md");
    let section = page.split("\n## ").find(|section| section.starts_with("What is guaranteed")).unwrap();
    let guarantees: Vec<&str> = section.split("\n- **").skip(1).collect();
    assert!(guarantees.len() >= 7, "{} guarantees", guarantees.len());
    let mut names = Vec::new();
    for guarantee in guarantees {
        // A title is a sentence or the beginning of a sentence, so the check of sentences starts after the title.
        let (_, rest) = guarantee.split_once("**").unwrap();
        for sentence in sentences(rest) {
            let before = names.len();
            names.extend(tests_in(&sentence));
            assert!(names.len() > before, "no test of: {sentence}");
        }
    }
    let opening = page.split("\n## ").next().unwrap();
    names.extend(tests_in(opening));
    for name in names {
        assert!(is_there(&name), "there is no test {name}");
    }
    assert!(!is_there("robustness::names::no_such_test") && !is_there("robustness::names::files"));
}

/// Checks the statements of SECURITY.md about connections, environment variables and started programs.
#[test]
fn no_connections_no_environment_variables_no_other_programs() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut open = vec![top.join("src")];
    open.extend(std::fs::read_dir(top.join("crates")).unwrap().map(|own| own.unwrap().path().join("src")));
    let mut programs = BTreeSet::new();
    while let Some(directory) = open.pop() {
        for entry in std::fs::read_dir(directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
                continue;
            }
            if path.ends_with("tests.rs") {
                continue;
            }
            let Ok(text) = std::fs::read_to_string(&path) else { continue };
            let code = text.split("#[cfg(test)]").next().unwrap();
            for word in ["::connect(", "UdpSocket", "env::var", "env::set_var", "password"] {
                let is_width = word == "env::var" && path.ends_with("cli/output.rs");
                let count = code.matches(word).count();
                let allowed = if is_width { code.matches("env::var(\"COLUMNS\")").count() } else { 0 };
                assert_eq!(count, allowed, "{}: {word}", path.display());
            }
            let run = code.split("Command::new(\"").skip(1).map(|rest| rest.split('"').next().unwrap());
            programs.extend(run.map(String::from));
            // A program name that is not a literal could be any program.
            // Only the code that starts a peer may use such a name, because the caller names the peer.
            let other = code.matches("Command::new(").count() - code.matches("Command::new(\"").count();
            assert!(other == 0 || path.ends_with("cli/bench.rs"), "{}", path.display());
        }
    }
    assert_eq!(programs, ["kill", "sh"].map(String::from).into());
}
