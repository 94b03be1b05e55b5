//! Runs the command as a user would, on scenarios of the repository or on edited copies.

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

/// A separate directory with copies of the repository's scenarios, in which commands run.
pub struct Place(TempDir);

/// Output and exit code of a command.
pub struct Outcome {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Place {
    /// An empty directory, as a new user has it.
    pub fn empty() -> Self {
        Place(TempDir::new().unwrap())
    }

    pub fn new() -> Self {
        let place = Place::empty();
        copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios"), &place.path("scenarios"));
        place
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a copy of a scenario with replaced texts. Each text must occur exactly once.
    pub fn edited(&self, scenario: &str, to: &str, edits: &[(&str, &str)]) {
        let mut text = fs::read_to_string(self.path(&format!("scenarios/{scenario}"))).unwrap();
        for (old, new) in edits {
            assert_eq!(text.matches(old).count(), 1, "`{old}` in {scenario}");
            text = text.replace(old, new);
        }
        fs::write(self.path(&format!("scenarios/{to}")), text).unwrap();
    }

    /// Runs `linkproof` in this directory; blanks separate the arguments.
    pub fn run(&self, arguments: &str) -> Outcome {
        self.given(&arguments.split_whitespace().collect::<Vec<_>>())
    }

    /// Runs `linkproof` in this directory with arguments that may contain blanks.
    pub fn given(&self, arguments: &[&str]) -> Outcome {
        let mut command = Command::cargo_bin("linkproof").unwrap();
        let output = command.current_dir(self.0.path()).args(arguments).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        let (stdout, stderr) = (text(output.stdout), text(output.stderr));
        assert!(!stderr.contains("panicked"), "{arguments:?}: {stderr}");
        Outcome { code: output.status.code().expect("an exit code"), stdout, stderr }
    }

    /// Runs a command that must succeed with nothing on standard error.
    pub fn ok(&self, arguments: &str) -> String {
        let outcome = self.run(arguments);
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{arguments}: {}", outcome.stdout);
        outcome.stdout
    }

    /// Runs a command that must be refused: exit code 2, a message with all of `words`, and a remedy.
    pub fn refused(&self, arguments: &str, words: &[&str]) -> Outcome {
        let outcome = self.run(arguments);
        assert_eq!(outcome.code, 2, "{arguments}: {}", outcome.stderr);
        for word in words {
            assert!(outcome.stderr.contains(word), "{arguments}: `{word}` is not in: {}", outcome.stderr);
        }
        let way_out = ["help: ", "possible values", "expected", "try '--help'"];
        assert!(way_out.iter().any(|way| outcome.stderr.contains(way)), "{arguments}: no way out: {}", outcome.stderr);
        outcome
    }
}

impl Outcome {
    /// Standard output without line ends, so that a sentence is found wherever it wraps.
    pub fn unbroken(&self) -> String {
        self.stdout.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// Standard output, which must be JSON only.
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {}", self.stdout))
    }
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() { copy(&path, &target) } else { fs::copy(&path, &target).map(drop).unwrap() }
    }
}

/// Texts under `key` in the objects of an array.
pub fn texts<'a>(rows: &'a Value, key: &str) -> Vec<&'a str> {
    rows.as_array().unwrap().iter().map(|row| row[key].as_str().unwrap()).collect()
}

/// A table of `solve`: header and rows.
pub struct Table {
    pub header: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub fn of(text: &str) -> Self {
        let cells = |line: &str| line.split(',').map(str::to_string).collect::<Vec<_>>();
        let mut lines = text.lines().map(cells);
        let table = Table { header: lines.next().expect("a header"), rows: lines.collect() };
        assert!(table.rows.iter().all(|row| row.len() == table.header.len()));
        table
    }

    /// Numbers of a column.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = self.header.iter().position(|column| column == name).unwrap_or_else(|| panic!("no column {name}"));
        self.rows.iter().map(|row| row[at].parse().unwrap()).collect()
    }
}

/// The commands that a help lists.
/// Continuation lines are skipped because they are indented further than commands.
/// Arguments are skipped because they do not begin with a lower-case letter.
pub fn listed(help: &str) -> impl Iterator<Item = &str> {
    let above = help.split("\nOptions:").next().unwrap_or_default().lines();
    above
        .filter_map(|line| line.strip_prefix("  ")?.split(' ').next())
        .filter(|word| word.starts_with(|first: char| first.is_ascii_lowercase()))
}
