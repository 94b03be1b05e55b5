//! All information besides the verdict that an engineer needs to act.
//! This information states why something disagrees or is open, what was not judged, and which printed numbers are known
//! to be wrong.

use super::cells::distinct;
use super::judged::{Grade, grade, unproven};
use super::style::wrapped;
use super::{Tell, diagnosis};
use crate::sentences;
use linkage::error::Advice;
use prover::bounds::{Check, Verdict};
use prover::numbers::input_in;
use prover::run::Proof;

/// Reasons why something disagrees or is open, with the remedies.
/// `most` reasons are shown in full; disagreements come first.
pub fn reasons(proof: &Proof, tell: Tell, width: Option<usize>, most: usize, text: &mut String) {
    let open = unproven(proof);
    for (name, verdict) in open.iter().take(most) {
        let reason = format!("{name}: {}", verdict.reason(tell).unwrap_or_default());
        say!(text, "\n{}", wrapped(&reason, width, 2));
    }
    if open.len() > most {
        say!(text, sentences::and_more_3(&(open.len() - most), &tell(&Advice::AllResults)));
    }
}

/// The diagnosis of a disagreement.
pub fn diagnosed(proof: &Proof, width: Option<usize>, text: &mut String) {
    let found = proof.diagnosis.as_ref().filter(|_| grade(&proof.verdict) == Grade::Disagree).map(diagnosis::text);
    for told in found.into_iter().chain(proof.diagnosis_is_cut.then(|| diagnosis::CUT.into())) {
        say!(text, "\n{}", wrapped(&told, width, diagnosis::INDENT));
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
    // Each command is on a separate line, because a wrapped command cannot be copied.
    say!(text, sentences::checks_disagree_as_expected_see(&count, &(told.join(",\n  "))));
}

/// Number of instants that are not judged, with the quantities concerned, and followers that leave their cams.
pub fn notes(proof: &Proof, width: Option<usize>, text: &mut String) {
    for engine in &proof.engines {
        let left = || engine.channels.iter().filter(|channel| channel.left_out > 0);
        let Some(most) = left().map(|channel| channel.left_out).max() else { continue };
        let quantities = distinct(left().map(|channel| channel.residual.channel.kind.stage.name()));
        let told = sentences::up_to_of_instants_are_not_judged(
            &most,
            &proof.reference_trajectory.times().len(),
            &(quantities.join(", ").replace('_', " ")),
            &engine.info.name,
        );
        say!(text, "\n{}", wrapped(&told, width, 2));
    }
    let (reference, mechanism) = (&proof.reference_trajectory, &proof.scene.case.mechanism);
    for cam in mechanism.transmissions().iter().filter(|own| own.cam.is_some()) {
        let Some(forces) = reference.named(&format!("transmission.{}.force_N", cam.name())) else { continue };
        let is_off = |row: &usize| forces[*row] < 0.0;
        let Some(first) = (0..forces.len()).find(is_off) else { continue };
        let (count, all, at) = ((0..forces.len()).filter(is_off).count(), forces.len(), reference.told(first));
        let told = sentences::the_follower_leaves_the_cam(&cam.name(), &count, &all, &input_in(at, 1));
        say!(text, "\n{}", wrapped(&told, width, 2));
    }
}
