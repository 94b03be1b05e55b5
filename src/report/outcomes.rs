//! Outcomes of scenarios or comparisons, in one list for test reports and comments.

use std::path::Path;

use super::compare;
use crate::plain::Tell;
use crate::plain::figures;
use crate::plain::judged::{self, Grade, JudgedNumber, Sort, grade};
use linkage::error::Error;
use prover::bounds::Verdict;
use prover::compare::{PartyComparison, SidePair};
use prover::run::Proof;

/// One channel or check.
#[derive(Clone, Debug)]
pub(super) struct Case {
    /// The party that was judged: an engine, or the analytic sides.
    pub(super) by: &'static str,
    pub(super) name: String,
    pub(super) verdict: Verdict,
    /// The reason, if the outcome is not a plain agreement.
    pub(super) reason: Option<String>,
}

/// Name of the party for checks of the analytic sides.
const SIDES: &str = "analytic sides";

/// A scenario with its cases, or with the error that prevented its proof.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) title: String,
    pub(super) verdict: &'static str,
    pub(super) cases: Vec<Case>,
    pub(super) error: Option<String>,
    /// Figures of the motion as cells of a table with its header; empty for a comparison.
    pub(super) figures: Vec<[String; 4]>,
}

/// The outcomes of a command, scenario by scenario, or comparison by comparison.
#[derive(Clone, Debug)]
pub struct Outcomes {
    /// Noun for an entry: scenario, or comparison.
    pub(super) noun: &'static str,
    pub(super) entries: Vec<Entry>,
    tell: Tell,
}

impl Outcomes {
    /// An empty list; `tell` puts advice into words.
    #[must_use]
    pub fn told_by(tell: Tell) -> Self {
        Outcomes { noun: "scenario", entries: Vec::new(), tell }
    }

    /// The outcomes of a comparison: every channel and every check of every pair.
    #[must_use]
    pub fn of_comparison(paths: [&Path; 2], comparison: &PartyComparison, tell: Tell) -> Self {
        let mut all = Outcomes { noun: "comparison", entries: Vec::new(), tell };
        let entry = |pair: &SidePair| {
            let channels = pair.channels.iter().map(|own| all.case("comparison", own.claim.text.clone(), &own.verdict));
            let checks = pair.checks.iter().map(|check| all.case(SIDES, check.name(), &check.verdict));
            let (name, cases) = (compare::who(paths, pair), channels.chain(checks).collect());
            Entry {
                name,
                title: String::new(),
                verdict: pair.verdict().word(),
                cases,
                error: None,
                figures: Vec::new(),
            }
        };
        all.entries = comparison.pairs.iter().map(entry).collect();
        all
    }

    fn case(&self, by: &'static str, name: String, verdict: &Verdict) -> Case {
        Case { by, name, verdict: verdict.clone(), reason: verdict.reason(self.tell) }
    }

    /// Adds a proof: every channel of every engine, and every check.
    pub fn add(&mut self, proof: &Proof) {
        // If the verdict on the forces exerted by an engine is open, these forces do not affect the verdict of the
        // proof.
        let counts = |own: &JudgedNumber| own.sort != Sort::OwnForce || grade(own.verdict) != Grade::Open;
        let judged = judged::of(proof).into_iter().filter(counts);
        let by = |own: &JudgedNumber| own.engine.map_or(SIDES, |engine| engine.info.name);
        let cases = judged.map(|own| self.case(by(&own), own.name, own.verdict)).collect();
        let error =
            proof.engines.iter().find_map(|engine| engine.failure.as_ref()).map(|own| own.message().to_string());
        let (name, title) = (proof.scenario.clone(), proof.title.clone());
        let (word, unit) = figures::place(proof);
        let mut figures = figures::rows(proof);
        if !figures.is_empty() {
            figures.insert(0, ["figure".into(), "value".into(), "unit".into(), format!("at {word}, {unit}")]);
        }
        self.entries.push(Entry { name, title, verdict: proof.verdict.word(), cases, error, figures });
    }

    /// Adds a scenario that could not be proven.
    pub fn add_failure(&mut self, scenario: &str, error: &Error) {
        let error = Some(error.lines_by(self.tell));
        let name = scenario.to_string();
        let (title, cases, figures) = (String::new(), Vec::new(), Vec::new());
        self.entries.push(Entry { name, title, verdict: "error", cases, error, figures });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plain::brief;
    use crate::plain::judged::{counts, verdicts};
    use crate::report::{junit, markdown};
    use fixtures::of_repository;
    use linkage::error::Advice;
    use prover::run::{Options, prove};

    /// This test uses a coarse step, so that some results are inconclusive.
    #[test]
    fn verdict_line_and_test_reports_have_equal_counts() {
        let scenario = of_repository("scenarios/crank_rocker.toml");
        let proof = prove(&scenario, &Options::default().step(5e-3).sweeps(2)).unwrap();
        let [agree, expected, wrong, open] = counts(verdicts(&proof).into_iter().map(|(_, verdict)| verdict));
        assert!(expected > 0 && wrong == 0 && open > 0, "{agree} {expected} {wrong} {open}");
        let line = brief::verdict_line(&proof);
        assert!(
            line.contains(&format!(" {open} of {} results could not be decided;", agree + expected + open)),
            "{line}"
        );
        // Undecided forces exerted by an engine do not affect the verdict.
        let forces = judged::of(&proof).into_iter().filter(|own| own.sort == Sort::OwnForce);
        let open = open - forces.filter(|own| grade(own.verdict) == Grade::Open).count();
        let mut outcomes = Outcomes::told_by(Advice::to_string);
        outcomes.add(&proof);
        let (table, xml) = (markdown::text(&outcomes), junit::xml(&outcomes));
        assert!(table.contains(&format!("| {agree} | {expected} | {wrong} | {open} |\n")), "{table}");
        let tests = agree + expected + open;
        let head = format!("tests=\"{tests}\" skipped=\"0\" failures=\"{wrong}\" errors=\"{open}\"");
        assert!(xml.contains(&head), "{xml}");
        assert_eq!(xml.matches("<error ").count(), open);
    }
}
