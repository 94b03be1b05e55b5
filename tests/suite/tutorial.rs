//! docs/tutorial.md, followed word for word: its commands run in an empty directory, and print what stands below them.

use std::path::Path;
use std::{env, fs};

use assert_cmd::Command;
use tempfile::TempDir;

const PAGE: &str = "docs/tutorial.md";

/// A block of the page.
struct Block<'a> {
    language: &'a str,
    /// The text before it, from the block before on.
    before: &'a str,
    body: &'a str,
}

fn blocks(page: &str) -> Vec<Block<'_>> {
    let mut found = Vec::new();
    let mut rest = page;
    while let Some((before, block)) = rest.split_once("```") {
        let (language, block) = block.split_once('\n').unwrap();
        let (body, after) = block.split_once("```\n").unwrap_or_else(|| panic!("{PAGE}: a block has no end"));
        found.push(Block { language, before, body });
        rest = after;
    }
    found
}

/// What a command prints, both streams, as on a terminal without colours; a refused one prints its error.
fn run(line: &str, place: &Path) -> String {
    let words = shlex::split(line).unwrap_or_else(|| panic!("no shell understands {line}"));
    let (program, arguments) = words.split_first().unwrap();
    assert_eq!(program, "linkproof", "{line}");
    let output = Command::cargo_bin("linkproof").unwrap().current_dir(place).args(arguments).output().unwrap();
    String::from_utf8([output.stdout, output.stderr].concat()).unwrap()
}

/// The page with the outputs that its commands have now. What goes to a file is named before its block, as in
/// `<!-- at the end of four_bar.toml -->`.
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
                let named = block.before.rsplit("<!-- at the end of ").next().and_then(|rest| rest.split_once(" -->"));
                let file =
                    place.join(named.unwrap_or_else(|| panic!("{PAGE}: which file is this for?\n{}", block.body)).0);
                let old = fs::read_to_string(&file).unwrap();
                fs::write(file, format!("{old}\n{}", block.body)).unwrap();
            }
            other => panic!("{PAGE}: a block of {other:?}"),
        }
    }
    (text, count)
}

/// `INSTA_UPDATE=always` writes the outputs anew, as it does with snapshots.
#[test]
fn the_tutorial_runs_as_it_stands() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(PAGE);
    let page = fs::read_to_string(&path).unwrap();
    let place = TempDir::new().unwrap();
    let (text, count) = followed(&page, place.path());
    assert!(count >= 8, "only {count} commands");
    if env::var_os("INSTA_UPDATE").is_some_and(|value| value == "always") {
        fs::write(path, text).unwrap();
        return;
    }
    let differing = text.lines().zip(page.lines()).find(|(new, old)| new != old);
    assert!(text == page, "{differing:#?}\nINSTA_UPDATE=always cargo test --release --test suite tutorial");
}
