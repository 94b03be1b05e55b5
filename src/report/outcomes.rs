//! What came of scenarios or comparisons, in one list for test reports and comments.

use std::path::Path;

use super::versus;
use crate::plain::Tell;
use crate::plain::judged::{self, Grade, Judged, Sort, grade};
use linkage::error::Error;
use prover::compare::Verdict;
use prover::proof::Proof;
use prover::versus::{Comparison, Pair};

/// One channel or check.
#[derive(Clone, Debug)]
pub(super) struct Case {
    /// What judged it: an engine, or the analytic sides.
    pub(super) by: &'static str,
    pub(super) name: String,
    pub(super) verdict: Verdict,
    /// Why it is no plain agreement.
    pub(super) reason: Option<String>,
}

/// Who judges checks of the analytic sides on each other.
const SIDES: &str = "analytic sides";

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
        let mut all = Outcomes { noun: "comparison", entries: Vec::new(), tell };
        let entry = |pair: &Pair| {
            let channels = pair.channels.iter().map(|own| all.case("comparison", own.claim.text.clone(), &own.verdict));
            let checks = pair.checks.iter().map(|check| all.case(SIDES, check.name(), &check.verdict));
            let (name, cases) = (versus::who(paths, pair), channels.chain(checks).collect());
            Entry { name, title: String::new(), verdict: pair.verdict().word(), cases, error: None }
        };
        all.entries = comparison.pairs.iter().map(entry).collect();
        all
    }

    fn case(&self, by: &'static str, name: String, verdict: &Verdict) -> Case {
        Case { by, name, verdict: verdict.clone(), reason: verdict.reason(self.tell) }
    }

    /// Adds a proof: every channel of every engine, and every check.
    pub fn add(&mut self, proof: &Proof) {
        // Forces of an engine's own that prove nothing take nothing from the verdict.
        let counts = |own: &Judged| own.sort != Sort::OwnForce || grade(own.verdict) != Grade::Open;
        let judged = judged::of(proof).into_iter().filter(counts);
        let by = |own: &Judged| own.engine.map_or(SIDES, |engine| engine.info.name);
        let cases = judged.map(|own| self.case(by(&own), own.name, own.verdict)).collect();
        let error =
            proof.engines.iter().find_map(|engine| engine.failure.as_ref()).map(|own| own.message().to_string());
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
