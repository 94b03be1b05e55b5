//! What an engineer needs besides the verdict to act on it: why something disagrees or is open, what was not judged, and
//! which printed numbers are known to be wrong.

use super::diagnosis;
use super::own_forces;
use super::style::wrapped;
use super::tell::Tell;
use crate::compare::Verdict;
use crate::proof::{ChannelProof, Proof};
use linkage::error::Advice;

/// All verdicts of a proof by name: channels, forces that engines exert themselves, and checks.
pub(super) fn verdicts(proof: &Proof) -> impl Iterator<Item = (String, &Verdict)> {
    let several = proof.engines.len() > 1;
    let channels = proof.engines.iter().flat_map(move |engine| {
        let name = move |channel: &ChannelProof| match several {
            true => format!("{} ({})", channel.residual.channel, engine.info.name),
            false => channel.residual.channel.to_string(),
        };
        let own = engine.own_forces.iter().flat_map(move |own| {
            let failed = own.failure.iter().map(move |_| (own_forces::of_all(engine, several), &own.verdict));
            let named = move |channel: &'_ ChannelProof| match several {
                true => format!("{} ({})", own_forces::name(channel), engine.info.name),
                false => own_forces::name(channel),
            };
            own.channels.iter().map(move |channel| (named(channel), &channel.verdict)).chain(failed)
        });
        engine.channels.iter().map(move |channel| (name(channel), &channel.verdict)).chain(own)
    });
    // An engine without a run that stands has no channel to say so.
    let without_run = proof.engines.iter().filter(|engine| engine.channels.is_empty() && engine.failure.is_none());
    let without_run = without_run.map(|engine| (engine.info.name.to_string(), &engine.verdict));
    without_run.chain(channels).chain(proof.all_checks().map(|c| (c.name(), &c.verdict)))
}

/// Number of verdicts of a sort.
pub(super) fn count(proof: &Proof, is: fn(&Verdict) -> bool) -> usize {
    verdicts(proof).filter(|(_, verdict)| is(verdict)).count()
}

/// Why something disagrees or is open, with the way out: `most` reasons in full, what disagrees first.
pub(super) fn reasons(proof: &Proof, tell: Tell, width: Option<usize>, most: usize, text: &mut String) {
    let of_report = |verdict: &Verdict| matches!(verdict, Verdict::Disagree { .. } | Verdict::Inconclusive { .. });
    let mut open: Vec<(String, &Verdict)> = verdicts(proof).filter(|(_, verdict)| of_report(verdict)).collect();
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
pub(super) fn diagnosed(proof: &Proof, width: Option<usize>, text: &mut String) {
    if let (Some(found), Verdict::Disagree { .. }) = (&proof.diagnosis, &proof.verdict) {
        say!(text, "\n{}", wrapped(&diagnosis::text(found), width, diagnosis::INDENT));
    }
    if proof.diagnosis_is_cut {
        say!(text, "\n{}", wrapped(diagnosis::CUT, width, diagnosis::INDENT));
    }
}

/// The published numbers that are wrong as expected, by finding.
pub(super) fn expected(proof: &Proof, tell: Tell, text: &mut String) {
    let mut findings: Vec<(&str, usize)> = Vec::new();
    for check in proof.all_checks() {
        if let Verdict::Expected { finding, .. } = &check.verdict {
            match findings.iter_mut().find(|(known, _)| known == finding) {
                Some((_, count)) => *count += 1,
                None => findings.push((finding, 1)),
            }
        }
    }
    if findings.is_empty() {
        return;
    }
    let count: usize = findings.iter().map(|(_, count)| count).sum();
    let place = |finding: &str| tell(&Advice::Text(format!("docs/findings.md#{finding}")));
    let told: Vec<String> = findings.iter().map(|(finding, _)| place(finding)).collect();
    // One a line: a command that is broken cannot be copied.
    say!(text, "\n{count} checks disagree as expected, see\n  {}", told.join(",\n  "));
}

/// How many instants are not judged, and of what.
pub(super) fn left_out(proof: &Proof, width: Option<usize>, text: &mut String) {
    for engine in &proof.engines {
        let Some(most) = engine.channels.iter().map(|channel| channel.left_out).max().filter(|&most| most > 0) else {
            continue;
        };
        let mut quantities: Vec<&str> = Vec::new();
        for channel in engine.channels.iter().filter(|channel| channel.left_out > 0) {
            if !quantities.contains(&channel.residual.channel.kind.stage.name()) {
                quantities.push(channel.residual.channel.kind.stage.name());
            }
        }
        let told = format!(
            "Up to {most} of {} instants are not judged in {} ({}): a drive or a loaded link reverses there, or the motion begins.",
            proof.reference_trajectory.times().len(),
            quantities.join(", ").replace('_', " "),
            engine.info.name
        );
        say!(text, "\n{}", wrapped(&told, width, 2));
    }
}
