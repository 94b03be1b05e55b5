//! Texts that tests expect, in files of the repository. `UPDATE_EXPECTED=1` writes the files anew.

use std::path::Path;
use std::{env, fs};

/// Number of differing lines that a failure shows.
const SHOWN: usize = 20;

/// Whether this run rewrites the files of expected texts, instead of comparing texts with these files.
pub fn is_updated() -> bool {
    env::var_os("UPDATE_EXPECTED").is_some_and(|value| value == "1")
}

/// Asserts that a text equals a file of the repository. `tests` names the tests that write the file anew.
#[track_caller]
pub fn agrees_with(path: &str, text: &str, tests: &str) {
    agrees_by(path, text, tests, |_, _| false);
}

/// Like [`agrees_with`], but lines that differ are accepted if `are_alike` accepts them.
#[track_caller]
pub fn agrees_by(path: &str, text: &str, tests: &str, are_alike: impl Fn(&str, &str) -> bool) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    if is_updated() {
        return fs::write(file, text).unwrap();
    }
    let expected = fs::read_to_string(file).unwrap_or_default();
    let [found, expected]: [Vec<&str>; 2] = [text, &expected].map(|text| text.split('\n').collect());
    let is_other = |row: &usize| match (found.get(*row), expected.get(*row)) {
        (Some(found), Some(expected)) => found != expected && !are_alike(found, expected),
        _ => true,
    };
    let told = |row: usize| {
        let [expected, found] = [&expected, &found].map(|lines| lines.get(row).unwrap_or(&"(no such line)"));
        format!("line {}: {expected}\ninstead:  {found}", row + 1)
    };
    let rows = 0..found.len().max(expected.len());
    let shown: Vec<String> = rows.filter(is_other).take(SHOWN).map(told).collect();
    let renew = format!("UPDATE_EXPECTED=1 cargo test --release --test suite {tests}");
    assert!(shown.is_empty(), "{path} differs:\n{}\nThis writes it anew: {renew}", shown.join("\n"));
}
