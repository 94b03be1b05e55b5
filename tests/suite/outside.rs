//! Two independent checks of code that all parties share.
//! The first check uses numbers of a program that shares no code with the parties (`tests/outside/`).
//! The second check uses laws that the sampled channels must satisfy.

mod coverage;
mod sampled;

use std::path::{Path, PathBuf};

use linkproof::{Options, Scenario, prove};

/// Beginning of the text `source` for numbers from a foreign program.
const SOURCE: &str = "tests/outside/";

/// Files of a directory of the package that are scenarios, in order.
fn files(directory: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(directory)).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|own| own == "toml"));
    files.sort();
    files
}

fn loaded(path: &Path) -> Scenario {
    Scenario::load(path).unwrap_or_else(|error| panic!("{error}"))
}

/// The files cover cases that are missing in the shipped files:
/// two resistances on one link, a massless coupler under forces, an eccentric RPR dyad, a PRP dyad on moving guides, an
/// offset guide at negative speed, a drive's joint with its links in reverse order, and a motor with
/// an initial speed on an open chain.
#[test]
fn external_numbers_hold_on_both_sides_and_in_the_engine() {
    let files = files("tests/outside/scenarios");
    assert!(files.len() >= 9);
    for path in files {
        let scenario = loaded(&path);
        let numbers: usize = scenario.oracles.iter().flat_map(|own| &own.series).map(|own| own.points.len()).sum();
        let proof = prove(&scenario, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(proof.verdict.word(), "agree", "{}: {:?}", scenario.name, proof.verdict);
        let judged = proof.checks.iter().filter(|check| check.family.contains("Newton and Euler at"));
        assert_eq!(judged.count(), 2 * numbers, "{}: every number is judged on both sides", scenario.name);
    }
}
