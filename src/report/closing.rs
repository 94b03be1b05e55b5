//! The table that closes a command over several files, and the count of their verdicts.

use crate::plain::brief::{ranked, resolution};
use crate::plain::cells::{flush, trimmed};
use prover::compare::{Check, Verdict};
use prover::numbers::percent;
use prover::proof::Proof;

/// One file of the command.
#[derive(Clone, Debug)]
struct Row {
    scenario: String,
    verdict: &'static str,
    worst: String,
    of_bound: String,
    step: String,
}

/// What came of the files so far, in their order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Closing(Vec<Row>);

impl Closing {
    /// Adds a proof: its verdict, and what uses most of its bound.
    pub(crate) fn add(&mut self, proof: &Proof) {
        let (worst, of_bound) = worst(proof);
        let (scenario, verdict) = (proof.scenario.clone(), proof.verdict.word());
        self.0.push(Row { scenario, verdict, worst, of_bound, step: resolution(proof) });
    }

    /// Adds a file that could not be proven.
    pub(crate) fn add_failure(&mut self, file: &str) {
        let dash = || "-".to_string();
        self.0.push(Row { scenario: file.into(), verdict: "error", worst: dash(), of_bound: dash(), step: dash() });
    }

    /// The table in at most `width` columns, and the count; `None` for a single file, whose verdict stands above.
    pub(crate) fn text(&self, width: usize) -> Option<String> {
        if self.0.len() < 2 {
            return None;
        }
        let mut table = flush(["scenario", "verdict", "worst", "of bound", "engine"], &[3], Some(width));
        // The name of a check may be long; it is broken instead of the others.
        if let Some(worst) = table.column_mut(2) {
            worst.remove_constraint();
        }
        for Row { scenario, verdict, worst, of_bound, step } in &self.0 {
            table.add_row([scenario, *verdict, worst, of_bound, step]);
        }
        Some(format!("{}\n\n{}\n", trimmed(&table), self.count()))
    }

    /// `3 scenarios: 1 disagree, 2 agree`, the gravest first.
    fn count(&self) -> String {
        let of = |word: &'static str| (self.0.iter().filter(|row| row.verdict == word).count(), word);
        let counts = ["error", "disagree", "inconclusive", "agree"].map(of).into_iter().filter(|(count, _)| *count > 0);
        let told: Vec<String> = counts.map(|(count, word)| format!("{count} {word}")).collect();
        format!("{} scenarios: {}", self.0.len(), told.join(", "))
    }
}

/// Name and share of its bound of what uses most of it: a check only where it disagrees or is open and no channel does.
/// A published number uses nearly all of its last digit's half as a rule, and says nothing by that.
fn worst(proof: &Proof) -> (String, String) {
    let is_at_fault = |verdict: &Verdict| matches!(verdict, Verdict::Disagree { .. } | Verdict::Inconclusive { .. });
    let channel = ranked(proof).into_iter().next().map(|(_, channel)| channel);
    let check = proof.all_checks().filter(|check| is_at_fault(&check.verdict));
    let check = check.max_by(|a, b| a.used().total_cmp(&b.used()));
    let of_check = |check: &Check| (check.name(), percent(check.used()));
    match (channel, check) {
        (Some(channel), Some(check)) if !is_at_fault(&channel.verdict) => of_check(check),
        (None, Some(check)) => of_check(check),
        (None, None) => ("-".into(), "-".into()),
        (Some(channel), _) => {
            let residual = &channel.residual;
            let share = if residual.max == 0.0 { 0.0 } else { residual.max / channel.bound };
            (residual.channel.to_string(), percent(share))
        }
    }
}
