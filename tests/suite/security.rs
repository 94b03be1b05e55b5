//! SECURITY.md: every guarantee names a test, and every test that is named is there.

use std::path::{Path, PathBuf};

/// Files in which the function of a path such as `robustness::names::x` may stand.
fn places(path: &[&str]) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut rooms = vec![root.join("tests/suite"), root.join("src")];
    rooms.extend(std::fs::read_dir(root.join("crates")).unwrap().map(|own| own.unwrap().path().join("src")));
    let modules: PathBuf = path.iter().filter(|module| **module != "tests").collect();
    rooms.into_iter().map(|room| room.join(&modules).with_extension("rs")).collect()
}

/// Whether a test stands there.
fn is_there(name: &str) -> bool {
    let path: Vec<&str> = name.split("::").collect();
    let (function, modules) = path.split_last().unwrap();
    places(modules).iter().filter_map(|file| std::fs::read_to_string(file).ok()).any(|text| {
        let own = text.find(&format!("fn {function}()"));
        own.is_some_and(|at| text[..at].trim_end().ends_with("#[test]"))
    })
}

#[test]
fn every_guarantee_names_a_test_that_is_there() {
    let page = include_str!("../../SECURITY.md");
    let section = page.split("\n## ").find(|section| section.starts_with("What is guaranteed")).unwrap();
    let guarantees: Vec<&str> = section.split("\n- **").skip(1).collect();
    assert!(guarantees.len() >= 7, "{} guarantees", guarantees.len());
    for guarantee in guarantees {
        let named: Vec<&str> = guarantee.split('`').skip(1).step_by(2).filter(|word| word.contains("::")).collect();
        assert!(!named.is_empty(), "no test of: {guarantee}");
        for name in named {
            assert!(is_there(name), "there is no test {name}");
        }
    }
    assert!(!is_there("robustness::names::no_such_test") && !is_there("robustness::names::files"));
}
