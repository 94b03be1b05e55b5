//! Tables, recordings and scenarios compared with each other: correct inputs agree, and faults are found and named.

mod constants;
pub(crate) mod digits;
mod files;
mod foreign;
mod instants;
mod mistakes;
mod pairs;

use std::path::Path;

use formula::Rounded;
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;
use prover::compare::{ComparedParty, ComparisonRule, PartyComparison, compare};
use prover::tables::{Held, Raw};
use scenario::Scenario;
use scenario::mapping::{Mapped, Mapping};

fn scenario(name: &str) -> Scenario {
    Scenario::load(Path::new("scenarios").join(format!("{name}.toml"))).unwrap()
}

/// The solution of an analytic side for a scenario, with all channels.
fn solved(scenario: &Scenario) -> Trajectory {
    let all = scenario.case.all_channels();
    analytic::AssurSolver.solve(&scenario.case.wanting_only(&all)).unwrap()
}

/// A table of named columns, each number with all digits of a double.
pub(crate) fn table(columns: &[(&str, Vec<f64>)]) -> Raw {
    let doubles = |values: &[f64]| values.iter().map(|&value| Rounded::nearly(value)).collect();
    Raw {
        names: columns.iter().map(|(name, _)| (*name).to_string()).collect(),
        columns: columns.iter().map(|(_, values)| doubles(values)).collect(),
        lines: Vec::new(),
    }
}

/// The mapping with these lines, each `EXPR=CHANNEL`.
fn mapping(lines: &[&str]) -> Mapping {
    let mut mapping = Mapping::default();
    lines.iter().for_each(|line| mapping.push(Mapped::parse(line, "a test").unwrap()));
    mapping
}

fn held(raw: &Raw) -> ComparedParty {
    Held::of_table(raw, &Mapping::default()).unwrap().into()
}

pub(crate) fn against(scenario: &Scenario, raw: &Raw, how: &ComparisonRule) -> PartyComparison {
    compare([scenario.clone().into(), held(raw)], how).unwrap()
}
