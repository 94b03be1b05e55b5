//! What an engineer needs besides the verdict to act on it: why something disagrees or is open, what was not judged, and
//! which printed numbers are known to be wrong.

use super::cells::distinct;
use super::diagnosis;
use super::judged;
use super::own_forces;
use super::style::wrapped;
use super::tell::Tell;
use linkage::error::Advice;
use prover::compare::Check;
use prover::compare::Verdict;
use prover::proof::Proof;

/// All verdicts of a proof by name: channels, forces that engines exert themselves, and checks.
pub fn verdicts(proof: &Proof) -> Vec<(String, &Verdict)> {
    let several = proof.engines.len() > 1;
    // An engine without a run that stands has no channel to say so.
    let without_run = proof.engines.iter().filter(|engine| engine.channels.is_empty() && engine.failure.is_none());
    let mut all: Vec<_> = without_run.map(|engine| (engine.info.name.to_string(), &engine.verdict)).collect();
    for engine in &proof.engines {
        let name = |name: String| if several { format!("{name} ({})", engine.info.name) } else { name };
        all.extend(judged::of_engine(engine).map(|own| (name(own.name), own.verdict)));
        let failed = engine.own_forces.iter().filter(|own| own.failure.is_some());
        all.extend(failed.map(|own| (own_forces::of_all(engine, several), &own.verdict)));
    }
    all.extend(proof.all_checks().map(|check| (check.name(), &check.verdict)));
    all
}

/// Number of verdicts of a sort.
pub fn count(proof: &Proof, is: fn(&Verdict) -> bool) -> usize {
    verdicts(proof).iter().filter(|(_, verdict)| is(verdict)).count()
}

/// Why something disagrees or is open, with the way out: `most` reasons in full, what disagrees first.
pub fn reasons(proof: &Proof, tell: Tell, width: Option<usize>, most: usize, text: &mut String) {
    let of_report = |verdict: &Verdict| matches!(verdict, Verdict::Disagree { .. } | Verdict::Inconclusive { .. });
    let mut open = verdicts(proof);
    open.retain(|(_, verdict)| of_report(verdict));
    open.sort_by_key(|(_, verdict)| matches!(verdict, Verdict::Inconclusive { .. }));
    for (name, verdict) in open.iter().take(most) {
        let reason = format!("{name}: {}", verdict.reason(tell).unwrap_or_default());
        say!(text, "\n{}", wrapped(&reason, width, 2));
    }
    if open.len() > most {
        say!(text, "\n... and {} more ({})", open.len() - most, tell(&Advice::AllResults));
    }
}

/// The diagnosis of a disagreement.
pub fn diagnosed(proof: &Proof, width: Option<usize>, text: &mut String) {
    if let (Some(found), Verdict::Disagree { .. }) = (&proof.diagnosis, &proof.verdict) {
        say!(text, "\n{}", wrapped(&diagnosis::text(found), width, diagnosis::INDENT));
    }
    if proof.diagnosis_is_cut {
        say!(text, "\n{}", wrapped(diagnosis::CUT, width, diagnosis::INDENT));
    }
}

/// The published numbers that are wrong as expected, by finding.
pub fn expected(proof: &Proof, tell: Tell, text: &mut String) {
    let finding = |check: &Check| match &check.verdict {
        Verdict::Expected { finding, .. } => Some(tell(&Advice::Text(format!("docs/findings.md#{finding}")))),
        Verdict::Agree { .. } | Verdict::Disagree { .. } | Verdict::Inconclusive { .. } => None,
    };
    let findings: Vec<String> = proof.all_checks().filter_map(finding).collect();
    if findings.is_empty() {
        return;
    }
    let (count, told) = (findings.len(), distinct(findings));
    // One a line: a command that is broken cannot be copied.
    say!(text, "\n{count} checks disagree as expected, see\n  {}", told.join(",\n  "));
}

/// How many instants are not judged, and of what.
pub fn left_out(proof: &Proof, width: Option<usize>, text: &mut String) {
    for engine in &proof.engines {
        let Some(most) = engine.channels.iter().map(|channel| channel.left_out).max().filter(|&most| most > 0) else {
            continue;
        };
        let left = engine.channels.iter().filter(|channel| channel.left_out > 0);
        let quantities = distinct(left.map(|channel| channel.residual.channel.kind.stage.name()));
        let told = format!(
            "Up to {most} of {} instants are not judged in {} ({}): a drive or a loaded link reverses there, or the motion begins.",
            proof.reference_trajectory.times().len(),
            quantities.join(", ").replace('_', " "),
            engine.info.name
        );
        say!(text, "\n{}", wrapped(&told, width, 2));
    }
}
