//! The table of all files at the end of a command, and the number of files for each verdict.

use crate::plain::brief::resolution;
use crate::plain::cells::{flush, trimmed};
use crate::plain::judged::{Grade, grade, ranked};
use linkage::math::statistics::share;
use prover::bounds::Check;
use prover::numbers::percent;
use prover::run::Proof;

/// Outcomes of the files so far, in the order of the files.
/// A row has scenario, verdict, worst item, this item's ratio of error to bound, and the engine's step or accuracy, or
/// the number of engines.
#[derive(Clone, Debug, Default)]
pub(crate) struct Closing(Vec<[String; 5]>);

impl Closing {
    /// Adds a proof: its verdict, and its worst item.
    pub(crate) fn add(&mut self, proof: &Proof) {
        let [worst, share] = worst(proof);
        self.0.push([proof.scenario.clone(), proof.verdict.word().into(), worst, share, resolution(proof)]);
    }

    /// Adds a file that could not be proven.
    pub(crate) fn add_failure(&mut self, file: &str) {
        self.0.push([file, "error", "-", "-", "-"].map(String::from));
    }

    /// The table in at most `width` columns, and the count.
    /// `None` for a single file, because the report above already shows its verdict.
    pub(crate) fn text(&self, width: usize) -> Option<String> {
        if self.0.len() < 2 {
            return None;
        }
        let mut table = flush("scenario | verdict | worst | of bound> | engine", Some(width));
        // Names of checks may be long, so this column is wrapped.
        if let Some(worst) = table.column_mut(2) {
            worst.remove_constraint();
        }
        Some(format!("{}\n\n{}\n", trimmed(table.add_rows(&self.0)), self.count()))
    }

    /// `3 scenarios: 1 disagree, 2 agree`, the most serious first.
    fn count(&self) -> String {
        let of = |word: &'static str| (self.0.iter().filter(|row| row[1] == word).count(), word);
        let counts = ["error", "disagree", "inconclusive", "agree"].map(of).into_iter().filter(|(count, _)| *count > 0);
        let told: Vec<String> = counts.map(|(count, word)| format!("{count} {word}")).collect();
        format!("{} scenarios: {}", self.0.len(), told.join(", "))
    }
}

/// Name of the worst item, and its ratio of error to bound.
/// The item is the worst channel, which is the first one in the order of [`ranked`]. If all channels agree but a check
/// disagrees or is open, the item is the check with the largest ratio.
/// Checks that agree are ignored. The bound of a published number is half a unit of its last digit, so the ratio of
/// such a check is usually near 1 and gives no information.
fn worst(proof: &Proof) -> [String; 2] {
    let channel = ranked(proof).into_iter().next().map(|(_, channel)| channel);
    let check = proof.all_checks().filter(|check| grade(&check.verdict) != Grade::Agree);
    let check = check.max_by(|a, b| a.used().total_cmp(&b.used()));
    let of_check = |check: &Check| [check.name(), percent(check.used())];
    match (channel, check) {
        (Some(channel), Some(check)) if grade(&channel.verdict) == Grade::Agree => of_check(check),
        (None, Some(check)) => of_check(check),
        (None, None) => ["-".into(), "-".into()],
        (Some(channel), _) => {
            let residual = &channel.residual;
            [residual.channel.to_string(), percent(share(residual.max, channel.bound))]
        }
    }
}
