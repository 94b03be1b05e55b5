//! docs/tutorial.md, docs/machines.md and docs/course.md, followed word for word.
//! The commands of a page run in an empty directory; their output must equal the text below them on the page.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

use crate::common::expected::{agrees_by, is_updated};

/// A block of the page.
struct Block<'a> {
    language: &'a str,
    /// The text of the page between the previous block and the present block.
    before: &'a str,
    body: &'a str,
}

fn blocks(page: &str) -> Vec<Block<'_>> {
    let mut found = Vec::new();
    let mut rest = page;
    while let Some((before, block)) = rest.split_once("```") {
        let (language, block) = block.split_once('\n').unwrap();
        let (body, after) = block.split_once("```\n").unwrap_or_else(|| panic!("this block has no end:\n{block}"));
        found.push(Block { language, before, body });
        rest = after;
    }
    found
}

/// Output of a command, both streams, as on a terminal without colours; a refused command prints its error.
fn run(line: &str, place: &Path) -> String {
    let words = shlex::split(line).unwrap_or_else(|| panic!("no shell understands {line}"));
    let (program, arguments) = words.split_first().unwrap();
    assert_eq!(program, "linkproof", "{line}");
    let output = Command::cargo_bin("linkproof").unwrap().current_dir(place).args(arguments).output().unwrap();
    String::from_utf8([output.stdout, output.stderr].concat()).unwrap()
}

/// The page with the current outputs of its commands.
/// The text before a block of TOML names its file: `<!-- the file arm.toml -->` for a new file,
/// `<!-- at the end of four_bar.toml -->` for a file to which the block is added.
fn followed(page: &str, place: &Path) -> (String, usize) {
    let mut text = page.to_string();
    let (mut printed, mut count) = (String::new(), 0);
    for block in blocks(page) {
        match block.language {
            "sh" => {
                printed.clear();
                for line in block.body.lines() {
                    printed = run(line.split("  #").next().unwrap(), place);
                    count += 1;
                }
            }
            "text" => {
                text = text.replacen(&format!("```text\n{}```", block.body), &format!("```text\n{printed}```"), 1)
            }
            "toml" => {
                let named = |sign: &str| block.before.rsplit_once(sign)?.1.split_once(" -->");
                let added = named("<!-- at the end of ");
                let (name, _) = added
                    .or_else(|| named("<!-- the file "))
                    .unwrap_or_else(|| panic!("which file is this for?\n{}", block.body));
                let file = place.join(name);
                let old = added.map(|_| fs::read_to_string(&file).unwrap() + "\n").unwrap_or_default();
                fs::write(file, old + block.body).unwrap();
            }
            other => panic!("a block of {other:?}"),
        }
    }
    (text, count)
}

/// Whether two lines have the same content.
/// Numbers may differ by 1 %, because rounding differs between processors, for example in the last bit of a sine.
/// Numbers below 1e-9 are rounding errors and may differ by more.
/// Counts of quantities, channels and checks, and file sizes, are ignored.
fn are_alike(one: &str, other: &str) -> bool {
    let is_near = |(one, other): (&str, &str)| {
        let number =
            |word: &str| word.trim_matches(|sign: char| !sign.is_ascii_alphanumeric() && sign != '-').parse::<f64>();
        match (number(one), number(other)) {
            (Ok(a), Ok(b)) => (a - b).abs() <= 1e-2 * a.abs() || a.abs() < 1e-9 && b.abs() < 1e-9,
            _ => one == other,
        }
    };
    let words = |line| -> Vec<&str> { str::split(line, [' ', ',']).filter(|word| !word.is_empty()).collect() };
    let (one, other) = (words(one), words(other));
    let is_count = |index: usize| one.get(index + 1).is_some_and(|of| COUNTED.iter().any(|word| of.starts_with(word)));
    let mut pairs = one.iter().copied().zip(other.iter().copied()).enumerate();
    one.len() == other.len() && pairs.all(|(index, pair)| is_count(index) || is_near(pair))
}

/// Words that follow a count; two lines may differ in the counts before these words.
const COUNTED: [&str; 4] = ["quantities", "channels", "checks", "kB"];

#[test]
fn changed_output_lines_are_detected() {
    for (one, other) in [
        ("a  1.000 mm, 2e-16", "a 1.001 mm, 8e-16"),
        ("t_s,1.9999999999999999e0", "t_s,2.0000000000000000e0"),
        ("57 quantities agree", "58 quantities agree"),
        ("57 channels", "58 channels"),
    ] {
        assert!(are_alike(one, other));
    }
    for (one, other) in [("1.0 mm", "1.1 mm"), ("1.0 mm", "1.0 m"), ("agree", "agree 1"), ("2e-16", "2e-6")] {
        assert!(!are_alike(one, other));
    }
}

/// Names of the pictures that the page shows; the commands write the pictures under these names.
fn pictures(page: &str) -> impl Iterator<Item = &str> {
    page.split("](tutorial/").skip(1).map(|rest| rest.split_once(')').unwrap().0)
}

#[test]
fn the_tutorial_runs_as_written() {
    assert_runs_as_written("tutorial.md");
}

#[test]
fn the_tutorial_of_machines_runs_as_written() {
    assert_runs_as_written("machines.md");
}

#[test]
fn the_course_project_runs_as_written() {
    assert_runs_as_written("course.md");
}

fn assert_runs_as_written(page: &str) {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let path = format!("docs/{page}");
    let page = fs::read_to_string(docs.join(page)).unwrap();
    let place = TempDir::new().unwrap();
    let (text, count) = followed(&page, place.path());
    assert!(count >= 8, "only {count} commands");
    for name in pictures(&page) {
        let [kept, found] = [docs.join("tutorial").join(name), place.path().join(name)];
        if is_updated() {
            fs::copy(&found, &kept).unwrap();
        }
        assert!(fs::read(kept).unwrap() == fs::read(found).unwrap(), "the picture {name} has changed");
    }
    agrees_by(&path, &text, "tutorial", are_alike);
}
