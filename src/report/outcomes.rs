//! What came of scenarios or comparisons, in one list for test reports and comments.

use std::path::Path;

use super::versus;
use crate::plain::judged::{self, Judged, Sort};
use crate::plain::tell::Tell;
use linkage::error::{Advice, Error};
use prover::compare::Verdict;

use prover::proof::Proof;

use prover::versus::{Comparison, Pair};

/// One channel or check.
#[derive(Clone, Debug)]
pub(super) struct Case {
    /// What judged it: an engine, or the analytic sides.
    pub(super) by: String,
    pub(super) name: String,
    pub(super) outcome: Outcome,
}

/// Who judges checks of the analytic sides on each other.
const SIDES: &str = "analytic sides";

impl Case {
    fn of(by: &str, name: String, verdict: &Verdict, tell: Tell) -> Case {
        let reason = || verdict.reason(|advice: &Advice| tell(advice)).unwrap_or_default();
        let outcome = match verdict {
            Verdict::Agree { .. } => Outcome::Agrees,
            Verdict::Expected { .. } => Outcome::Expected(reason()),
            Verdict::Disagree { .. } => Outcome::Disagrees(reason()),
            Verdict::Inconclusive { .. } => Outcome::Open(reason()),
        };
        Case { by: by.into(), name, outcome }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Outcome {
    Agrees,
    /// The published number is wrong, as a finding says.
    Expected(String),
    Disagrees(String),
    /// Nothing is proven.
    Open(String),
}

/// A scenario with its cases, or with the error that kept it from being proven.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) title: String,
    pub(super) verdict: &'static str,
    pub(super) cases: Vec<Case>,
    pub(super) error: Option<String>,
}

/// The outcomes of a command, scenario by scenario, or comparison by comparison.
#[derive(Clone, Debug)]
pub struct Outcomes {
    /// What an entry is: a scenario, or a comparison.
    pub(super) noun: &'static str,
    pub(super) entries: Vec<Entry>,
    tell: Tell,
}

impl Outcomes {
    /// None yet; `tell` words advice.
    #[must_use]
    pub fn told_by(tell: Tell) -> Self {
        Outcomes { noun: "scenario", entries: Vec::new(), tell }
    }

    /// Those of a comparison: every channel and every check of every pair.
    #[must_use]
    pub fn of_comparison(paths: [&Path; 2], comparison: &Comparison, tell: Tell) -> Self {
        let entry = |pair: &Pair| {
            let channels = pair.channels.iter().map(|own| ("comparison", own.claim.text.clone(), &own.verdict));
            let checks = pair.checks.iter().map(|check| (SIDES, check.name(), &check.verdict));
            let cases = channels.chain(checks).map(|(by, name, verdict)| Case::of(by, name, verdict, tell));
            let verdict = pair.verdict().word();
            Entry { name: versus::who(paths, pair), title: String::new(), verdict, cases: cases.collect(), error: None }
        };
        Outcomes { noun: "comparison", entries: comparison.pairs.iter().map(entry).collect(), tell }
    }

    /// Adds a proof: every channel of every engine, and every check.
    pub fn add(&mut self, proof: &Proof) {
        // Forces of an engine's own that prove nothing take nothing from the verdict.
        let is_left_out =
            |own: &Judged| own.sort == Sort::OwnForce && matches!(own.verdict, Verdict::Inconclusive { .. });
        let judged = judged::of(proof).into_iter().filter(|own| !is_left_out(own));
        let by = |own: &Judged| own.engine.map_or(SIDES, |engine| engine.info.name);
        let cases = judged.map(|own| Case::of(by(&own), own.name, own.verdict, self.tell)).collect();
        let failures = proof.engines.iter().filter_map(|engine| engine.failure.as_ref());
        let error = failures.map(|error| error.message().to_string()).next();
        let (name, title) = (proof.scenario.clone(), proof.title.clone());
        self.entries.push(Entry { name, title, verdict: proof.verdict.word(), cases, error });
    }

    /// Adds a scenario that could not be proven.
    pub fn add_failure(&mut self, scenario: &str, error: &Error) {
        let error = Some(error.lines_by(self.tell));
        let name = scenario.to_string();
        self.entries.push(Entry { name, title: String::new(), verdict: "error", cases: Vec::new(), error });
    }
}
