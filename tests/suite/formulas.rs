//! Formulas: the library of textbook results is right, corrupted formulas are found and explained, and errors help the
//! user.

mod authors;
mod diagnosis;
mod errors;
mod fixed;
mod library;
mod limits;
mod parameters;
mod planted;
mod reduced;
mod transfer;
mod undefined;
mod wrong_input;

use std::path::{Path, PathBuf};

use prover::check::FormulaOutcome;
use prover::run::solved::{Claimed, judge};
use scenario::{Formulas, Scenario, files_in};

fn files() -> Vec<PathBuf> {
    files_in(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/formulas")).unwrap()
}

fn load(path: &Path) -> Scenario {
    Scenario::load(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The scenario with one formula rewritten; later formulas that use this formula change with it.
fn rewritten(scenario: &Scenario, name: &str, text: &str) -> Scenario {
    let mut formulas = Formulas::over(scenario.formulas.parameters.clone());
    for own in &scenario.formulas.list {
        let text = if own.name == name { text } else { &own.text };
        let formula = formulas.add(&own.name, text).unwrap_or_else(|fault| panic!("{text}: {fault}"));
        // Only the rewritten formula is judged.
        formula.claim = own.claim.clone().filter(|_| own.name == name);
        (formula.source, formula.valid, formula.error) = (own.source.clone(), own.valid, own.error);
    }
    let mut changed = scenario.clone();
    changed.formulas = formulas;
    changed
}

fn judged(scenario: &Scenario) -> Claimed {
    judge(scenario).unwrap_or_else(|error| panic!("{}: {error}", scenario.name))
}

/// Whether a side finds that a formula has a wrong value.
fn is_wrong(claimed: &Claimed, name: &str) -> bool {
    let all = claimed.judgement.sides.iter().flat_map(|(_, all)| all.iter().flatten());
    all.filter(|judged| judged.name == name && judged.order == 0)
        .any(|judged| judged.outcome() == FormulaOutcome::Wrong)
}

/// Whether a text contains all words of one of the alternatives, `a & b | c`.
fn is_named(said: &str, alternatives: &str) -> bool {
    alternatives.split(" | ").any(|words| words.split(" & ").all(|word| said.contains(word.trim())))
}
