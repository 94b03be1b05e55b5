//! Diagnoses of planted faults: each fault is either named or left unexplained.

mod cases;
mod engines;
mod parties;
mod random;
mod report;
mod values;

use std::path::Path;

use linkage::case::Case;
use linkage::solver::Solver;
use linkage::trajectory::{Stage, Trajectory};
use linkproof::plain::diagnosis::cause;
use prover::bounds::{differences, scales};
use prover::diagnosis::{Diagnosis, DiagnosisInput, SuspectChannel, diagnose};
use scenario::Scenario;

fn text(name: &str) -> String {
    std::fs::read_to_string(Path::new("scenarios").join(format!("{name}.toml"))).unwrap()
}

fn parsed(name: &str, text: &str) -> Scenario {
    let path = Path::new("scenarios").join(format!("{name}.toml"));
    Scenario::parse(text, &path).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The text with one passage replaced.
fn edited(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "`{from}` must stand in the scenario");
    text.replacen(from, to, 1)
}

/// Outcome of one diagnosis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// The fault is named.
    Named,
    /// A cause other than the fault is named, and the fault is mentioned as an equally good explanation.
    Mentioned,
    /// The diagnosis explains everything by a cause other than the fault, and does not mention the fault.
    Wrong,
    /// No cause is named as explaining everything.
    Nothing,
}

/// Outcome of a diagnosis.
/// The words of the named cause should begin with one of the alternatives in `expected`, separated by `|`; `*` stands
/// for any channels.
fn outcome(diagnosis: Option<&Diagnosis>, expected: &str) -> Outcome {
    let Some(found) = diagnosis.filter(|found| found.is_explained()) else { return Outcome::Nothing };
    let is_told = |words: &str, expected: &str| match expected.split_once('*') {
        Some((start, rest)) => words.starts_with(start) && words.contains(rest),
        None => words.starts_with(expected),
    };
    let is_meant = |words: &str| expected.split('|').any(|expected| is_told(words, expected));
    match &found.cause {
        Some(named) if is_meant(&cause(named)) => Outcome::Named,
        _ if found.also.iter().any(|also| is_meant(&cause(also))) => Outcome::Mentioned,
        _ => Outcome::Wrong,
    }
}

/// One line about a diagnosis.
fn told(diagnosis: Option<&Diagnosis>) -> String {
    let Some(found) = diagnosis else { return "no diagnosis".into() };
    let also: Vec<String> = found.also.iter().map(cause).collect();
    let named = found.cause.as_ref().map_or("nothing".into(), cause);
    let (left, all) = (found.left_over.len(), found.since.len());
    format!("{named}; left over {left} of {all}; also {also:?}; {} solved", found.solved)
}

/// Typical bounds of an engine, as fractions of a channel's scale.
fn share(stage: Stage) -> f64 {
    match stage {
        Stage::Positions => 1e-6,
        Stage::Velocities => 1e-5,
        Stage::Accelerations => 1e-4,
        Stage::Reactions | Stage::BalancingMoment => 1e-3,
    }
}

/// Adds a numerical error to the values of a suspect, and diagnoses the suspect.
/// The bounds are typical bounds of an engine, and the error is at most 0.7 times these bounds.
fn examined(case: &Case, suspect: &Trajectory, step: Option<f64>) -> Option<Diagnosis> {
    let reference = analytic::AssurSolver.solve(case).unwrap();
    let mut seed = 1u64;
    let mut noise = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let (mut columns, mut judged) = (Vec::new(), Vec::new());
    for ((channel, values), scale) in reference.iter().zip(scales(&reference)) {
        let bound = share(channel.kind.stage) * scale;
        let found = suspect.column(channel).unwrap();
        let phase = noise();
        let wave = |row: usize| (6.0 * row as f64 / found.len() as f64 + phase).sin();
        let own: Vec<f64> =
            found.iter().enumerate().map(|(row, value)| value + bound * (0.4 * wave(row) + 0.3 * noise())).collect();
        let gaps = differences(values, &own, channel.kind.periodic);
        judged.push(SuspectChannel {
            channel: channel.clone(),
            bound,
            disagrees: gaps.iter().any(|gap| !(gap.abs() <= bound)),
        });
        columns.push(own);
    }
    let (times, cranks) = (reference.times().to_vec(), reference.inputs().to_vec());
    let suspicious = Trajectory::new(times, cranks, reference.channels().to_vec(), columns).unwrap();
    let question = DiagnosisInput {
        suspect: "the other",
        reference: &reference,
        suspicious: &suspicious,
        judged: &judged,
        case,
        solver: &analytic::AssurSolver,
        step: step.map(|step| (step, "step")),
    };
    diagnose(&question, &[])
}

/// Counts outcomes, prints each outcome, and collects the outcomes that are not allowed.
#[derive(Default)]
struct Tally {
    counts: [usize; 4],
    wrong: Vec<String>,
}

impl Tally {
    fn add(&mut self, what: &str, diagnosis: Option<&Diagnosis>, expected: &str) {
        let outcome = outcome(diagnosis, expected);
        let line = format!("{outcome:?}: {what}: {}", told(diagnosis));
        println!("{line}");
        self.counts[outcome as usize] += 1;
        if outcome != Outcome::Named {
            self.wrong.push(line);
        }
    }

    fn told(&self, what: &str) {
        let [named, mentioned, wrong, nothing] = self.counts;
        println!("{what}: {named} named, {mentioned} mentioned, {wrong} wrong, {nothing} nothing");
    }
}
