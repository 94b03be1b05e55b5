//! Outcomes as JUnit: a suite for each scenario, a case for each channel and check. No times, so that equal runs give
//! equal bytes.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::outcomes::{Outcome, Outcomes};

/// The outcomes as XML.
#[must_use]
pub fn xml(outcomes: &Outcomes) -> String {
    let mut report = Report::new("linkproof");
    for entry in &outcomes.entries {
        let mut suite = TestSuite::new(entry.name.as_str());
        for case in &entry.cases {
            let status = match &case.outcome {
                Outcome::Agrees | Outcome::Expected(_) => TestCaseStatus::success(),
                Outcome::Disagrees(reason) => failed(NonSuccessKind::Failure, "disagree", reason),
                // It stands in the way of a verdict, though nothing is wrong.
                Outcome::Open(reason) => failed(NonSuccessKind::Error, "inconclusive", reason),
            };
            let mut own = TestCase::new(case.name.as_str(), status);
            own.set_classname(format!("{}.{}", entry.name, case.by));
            if let Outcome::Expected(finding) = &case.outcome {
                own.set_system_out(finding.as_str());
            }
            suite.add_test_case(own);
        }
        if let Some(error) = &entry.error {
            let mut own = TestCase::new("proof", failed(NonSuccessKind::Error, "error", error));
            own.set_classname(entry.name.as_str());
            suite.add_test_case(own);
        }
        report.add_test_suite(suite);
    }
    report.to_string().expect("plain structures are always XML")
}

fn failed(kind: NonSuccessKind, word: &str, reason: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(kind);
    status.set_type(word).set_message(reason);
    status
}
