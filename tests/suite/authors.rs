//! Tests of the page docs/authors.md.
//! Every row has one of three statuses.
//! The formulas, tables, tests and findings that a row names exist.
//! The commands of the page succeed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use scenario::Scenario;

use crate::cli::tools::Place;
use crate::common::many;
use crate::figures::anchors;

/// Sections of the page, and the least number of rows of each.
const SECTIONS: [(&str, usize); 5] = [("S0", 83), ("S1", 130), ("S2", 114), ("S3", 18), ("S4", 64)];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn page() -> String {
    fs::read_to_string(root().join("docs/authors.md")).unwrap()
}

fn cells(line: &str) -> Vec<&str> {
    line.trim_matches('|').split(" | ").map(str::trim).collect()
}

/// The rows of a section's table as lists of cells, without the head of the table.
fn rows<'a>(page: &'a str, section: &str) -> Vec<Vec<&'a str>> {
    let begin = format!("\n## {section}: ");
    let (_, text) = page.split_once(&begin).unwrap_or_else(|| panic!("no section {section}"));
    let lines = text.split("\n## ").next().unwrap().lines().filter(|line| line.starts_with('|'));
    let is_head = |line: &str| line == "| item | place | status |" || line.starts_with("|---");
    lines.filter(|line| !is_head(line)).map(cells).collect()
}

/// An item that a row names between back quotes.
enum Named<'a> {
    /// A command, and the expected exit code, which the row states behind the command.
    Command(&'a str, i32),
    /// Formulas of a scenario.
    Formulas(&'a str, Vec<&'a str>),
    /// Tables of published numbers of a scenario.
    Tables(&'a str, Vec<&'a str>),
    /// A test function.
    Test(&'a str),
}

fn named(status: &str) -> Vec<Named<'_>> {
    let parts: Vec<&str> = status.split('`').collect();
    let one = |at: usize| {
        let (word, rest) = parts[at].split_once(' ')?;
        let (scenario, names) = rest.split_once(": ").unwrap_or((rest, ""));
        match word {
            "linkproof" => {
                let after = parts.get(at + 1)?.strip_prefix(" (exit code ");
                let code = after.map_or(Ok(0), |digits| digits[..1].parse()).expect("an exit code");
                Some(Named::Command(parts[at], code))
            }
            "check" => Some(Named::Formulas(scenario, names.split(", ").collect())),
            "run" => Some(Named::Tables(scenario, names.split("; ").collect())),
            "test" => Some(Named::Test(rest)),
            _ => None,
        }
    };
    (1..parts.len()).step_by(2).filter_map(one).collect()
}

/// Whether a name fits a pattern, in which a star stands for any letters.
fn fits(pattern: &str, name: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == name,
        Some((before, after)) => {
            name.strip_prefix(before).is_some_and(|rest| (0..=rest.len()).any(|at| fits(after, &rest[at..])))
        }
    }
}

/// The items to which the rows may refer.
struct Shipped {
    anchors: Vec<String>,
    /// The sources of all tests.
    tests: String,
    scenarios: BTreeMap<String, Scenario>,
}

impl Shipped {
    fn new() -> Self {
        let mut scenarios = BTreeMap::new();
        for folder in ["", "formulas/"] {
            for entry in fs::read_dir(root().join("scenarios").join(folder)).unwrap() {
                let path = entry.unwrap().path();
                if path.extension().is_some_and(|ending| ending == "toml") {
                    let name = format!("{folder}{}", path.file_stem().unwrap().to_str().unwrap());
                    scenarios.insert(name, Scenario::load(&path).unwrap_or_else(|error| panic!("{error}")));
                }
            }
        }
        Shipped { anchors: anchors(), tests: sources(&root().join("tests/suite")), scenarios }
    }

    /// Faults of a row.
    fn faults(&self, row: &[&str]) -> Vec<String> {
        let [item, place, status] = row[..] else { return vec!["a row has three cells".into()] };
        if [item, place, status].iter().any(|cell| cell.is_empty()) {
            return vec!["a cell is empty".into()];
        }
        let links: Vec<&str> =
            status.split("](findings.md#").skip(1).map(|rest| rest.split(')').next().unwrap()).collect();
        let lost = links.iter().filter(|link| !self.anchors.iter().any(|anchor| anchor == *link));
        let mut found: Vec<String> = lost.map(|link| format!("no finding {link}")).collect();
        let is_wrong_in_print = status.starts_with("wrong in print: ");
        let all = named(status);
        if status.starts_with("reproduced: ") {
            found.extend(all.is_empty().then(|| "nothing shows that it is reproduced".into()));
        } else if is_wrong_in_print {
            found.extend(links.is_empty().then(|| "no finding is linked".into()));
        } else if !status.starts_with("cannot be: ") {
            found.push("the status is unknown".into());
        }
        for name in all {
            match name {
                Named::Command(line, _) => found.extend(placeholder(line)),
                Named::Test(test) if !self.tests.contains(&format!("fn {test}(")) => {
                    found.push(format!("no test {test}"))
                }
                Named::Test(_) => {}
                Named::Tables(scenario, tables) => found.extend(self.lost_tables(scenario, &tables)),
                Named::Formulas(scenario, formulas) => {
                    found.extend(self.lost_formulas(scenario, &formulas));
                    for (name, finding) in self.wrong_formulas(scenario, &formulas) {
                        found.extend((!is_wrong_in_print).then(|| format!("{name} is wrong in print")));
                        found.extend((!links.contains(&finding)).then(|| format!("{name} needs a link to {finding}")));
                    }
                }
            }
        }
        found
    }

    fn lost_tables(&self, scenario: &str, tables: &[&str]) -> Vec<String> {
        let Some(own) = self.scenarios.get(scenario) else { return vec![format!("no scenario {scenario}")] };
        let lost = tables.iter().filter(|table| !own.oracles.iter().any(|oracle| oracle.name == **table));
        lost.map(|table| format!("no table {table} in {scenario}")).collect()
    }

    fn lost_formulas(&self, scenario: &str, patterns: &[&str]) -> Vec<String> {
        let Some(own) = self.scenarios.get(scenario) else { return vec![format!("no scenario {scenario}")] };
        let lost =
            patterns.iter().filter(|pattern| !own.formulas.list.iter().any(|formula| fits(pattern, &formula.name)));
        lost.map(|pattern| format!("no formula {pattern} in {scenario}")).collect()
    }

    /// Name and finding of each formula that fits a pattern and is wrong as printed.
    fn wrong_formulas(&self, scenario: &str, patterns: &[&str]) -> Vec<(&str, &str)> {
        let all = self.scenarios.get(scenario).into_iter().flat_map(|own| &own.formulas.list);
        let meant = all.filter(|formula| patterns.iter().any(|pattern| fits(pattern, &formula.name)));
        meant.filter_map(|formula| Some((formula.name.as_str(), formula.finding.as_deref()?))).collect()
    }
}

/// Texts of all files below a directory, one after the other.
fn sources(directory: &Path) -> String {
    let entries = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path());
    let text = |path: std::path::PathBuf| match path.is_dir() {
        true => sources(&path),
        false => fs::read_to_string(&path).unwrap_or_default(),
    };
    entries.map(text).collect()
}

/// A fault if a command contains a word in capitals, such as FILE, instead of the name of a file.
fn placeholder(line: &str) -> Option<String> {
    let is_capital = |word: &str| word.len() > 2 && word.bytes().all(|letter| letter.is_ascii_uppercase());
    let mut words = line.split_whitespace().flat_map(|word| word.split(['/', '.']));
    words.find(|word| is_capital(word)).map(|word| format!("`{word}` is no file: {line}"))
}

/// The commands to run, each only once.
/// If rows name formulas of a scenario, one `check` of the scenario is a job; if rows name tables, one `run` is a job.
/// The commands written in a row form one job.
fn jobs(page: &str) -> Vec<Vec<(String, i32)>> {
    let (mut seen, mut short, mut jobs) = (BTreeSet::new(), BTreeSet::new(), Vec::new());
    for row in SECTIONS.iter().flat_map(|(section, _)| rows(page, section)) {
        let mut job = Vec::new();
        for name in named(row.get(2).copied().unwrap_or_default()) {
            match name {
                Named::Command(line, code) if seen.insert(line.to_string()) => job.push((line.to_string(), code)),
                Named::Formulas(scenario, _) => {
                    short.insert(format!("linkproof check scenarios/{scenario}.toml"));
                }
                Named::Tables(scenario, _) => {
                    short.insert(format!("linkproof run scenarios/{scenario}.toml --no-record"));
                }
                Named::Command(..) | Named::Test(_) => {}
            }
        }
        jobs.push(job);
    }
    let short = short.into_iter().filter(|line| !seen.contains(line)).map(|line| vec![(line, 0)]);
    short.collect::<Vec<_>>().into_iter().chain(jobs).filter(|job| !job.is_empty()).collect()
}

/// The commands of a job whose exit code is not the expected one.
fn failures(place: &Place, job: &[(String, i32)]) -> Vec<String> {
    let run = |(line, code): &(String, i32)| {
        let words = shlex::split(line).unwrap_or_else(|| panic!("no shell understands {line}"));
        let arguments: Vec<String> = words[1..].iter().flat_map(|word| expanded(place, word)).collect();
        let outcome = place.given(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
        (outcome.code != *code).then(|| format!("{line}: exit code {}\n{}", outcome.code, outcome.stderr))
    };
    job.iter().filter_map(run).collect()
}

/// An argument as a shell expands it: a star in the name of a scenario stands for all files that fit.
fn expanded(place: &Place, word: &str) -> Vec<String> {
    let pattern = word.rsplit_once('/').filter(|_| word.starts_with("scenarios/") && word.contains('*'));
    let Some((folder, pattern)) = pattern else { return vec![word.into()] };
    let entries = fs::read_dir(place.path(folder)).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut files: Vec<String> =
        names.filter(|name| fits(pattern, name)).map(|name| format!("{folder}/{name}")).collect();
    files.sort();
    files
}

/// A directory with the shipped files and the repository's scenarios, including the sixty of `variants60`.
fn place() -> Place {
    let place = Place::new();
    place.ok("new --shipped --force");
    place
}

#[test]
fn every_row_has_a_status_and_what_it_names_exists() {
    let (page, shipped) = (page(), Shipped::new());
    for (section, least) in SECTIONS {
        let rows = rows(&page, section);
        assert!(rows.len() >= least, "{section}: {} rows, {least} before", rows.len());
        for row in rows {
            let faults = shipped.faults(&row);
            assert!(faults.is_empty(), "{section}: {row:?}: {faults:#?}");
        }
    }
}

#[test]
fn the_commands_of_the_page_succeed() {
    let (page, place) = (page(), place());
    let jobs = jobs(&page);
    let commands = || jobs.iter().flatten();
    assert!(commands().count() > 100, "{} commands", commands().count());
    let written: Vec<&str> = commands().filter_map(|(line, _)| line.split(" -o ").nth(1)?.split(' ').next()).collect();
    let twice = written.iter().find(|file| written.iter().filter(|other| other == file).count() > 1);
    assert!(twice.is_none(), "two commands write {twice:?}");
    let found = many::each(0, jobs.len() as u64, |index| failures(&place, &jobs[index as usize]));
    let failed: Vec<String> = found.into_iter().flat_map(|(_, failures)| failures).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn bad_rows_and_failing_commands_are_found() {
    let shipped = Shipped::new();
    let faults = |line: &str| shipped.faults(&cells(line)).join("; ");
    for good in [
        "| a | 1 | reproduced: `check ov7_base: P2x, P43*`, `run ov7_base: positions.csv` |",
        "| a | 1 | reproduced: `test bad_rows_and_failing_commands_are_found` |",
        "| a | 1 | wrong in print: [finding](findings.md#ov7_new-wrong-indices), `check ov7_new: U345, U435` |",
        "| a | 1 | cannot be: no number in print |",
    ] {
        assert_eq!(faults(good), "");
    }
    for (bad, fault) in [
        ("| a | 1 | planned: `linkproof list` |", "the status is unknown"),
        ("| a | 1 | reproduced |", "the status is unknown"),
        ("| a | 1 | reproduced: by hand |", "nothing shows"),
        ("| a | 1 | wrong in print: a sign |", "no finding is linked"),
        ("| a | 1 | wrong in print: [finding](findings.md#no-such) |", "no finding no-such"),
        ("| a | 1 | reproduced: `check ov7_base: P2x, no_such` |", "no formula no_such in ov7_base"),
        ("| a | 1 | reproduced: `check no_such: P2x` |", "no scenario no_such"),
        ("| a | 1 | reproduced: `check ov7_base` |", "no formula  in ov7_base"),
        ("| a | 1 | reproduced: `check ov7_new: U*` |", "U345 is wrong in print"),
        (
            "| a | 1 | wrong in print: [finding](findings.md#ov7_new-misprinted-cells), `check ov7_new: U345` |",
            "U345 needs",
        ),
        ("| a | 1 | reproduced: `run ov7_base: no_such.csv` |", "no table no_such.csv"),
        ("| a | 1 | reproduced: `test no_such` |", "no test no_such"),
        ("| a | 1 | reproduced: `linkproof draw FILE` |", "`FILE` is no file"),
        ("| a |  | cannot be: no number in print |", "a cell is empty"),
        ("| a | cannot be: no number in print |", "three cells"),
    ] {
        assert!(faults(bad).contains(fault), "{bad}: {}", faults(bad));
    }
    let failed = |line: &str, code: i32| failures(&Place::empty(), &[(line.to_string(), code)]);
    assert_eq!(failed("linkproof list --solvers", 0), Vec::<String>::new());
    assert!(failed("linkproof inspect no_such.toml", 0)[0].contains("exit code 2"));
    assert_eq!(failed("linkproof inspect no_such.toml", 2), Vec::<String>::new());
}
