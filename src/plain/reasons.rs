//! All information besides the verdict that an engineer needs to act.
//! This information states why something disagrees or is open, what was not judged, and which printed numbers are known
//! to be wrong.

use super::judged::{Grade, grade, unproven};
use super::style::wrapped;
use super::{Tell, diagnosis};
use crate::sentences;
use analytic::assur::{effort_at_rest, rows_at_rest};
use linkage::case::FrictionSeat;
use linkage::error::Advice;
use linkage::input::Input;
use linkage::math::statistics::distinct;
use prover::bounds::{Check, Verdict};
use prover::numbers::{input_in, quantity};
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

/// The published numbers that are known to be wrong, grouped by the finding that explains them.
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

/// Largest number of instants at rest that are solved for the interval of the driving moment or force.
const MOST_AT_REST: usize = 20;

/// Reports joints with friction and transmissions with losses, if they are at rest.
/// Also reports the widest interval of the first drive's moment or force at these instants.
fn at_rest(proof: &Proof, width: Option<usize>, text: &mut String) {
    let (case, reference) = (&proof.scene.case, &proof.reference_trajectory);
    if case.is_free() {
        return;
    }
    // The analytic sides have already solved all rows, so an error is not expected and is ignored.
    let Some(all) = case.has_friction().then(|| rows_at_rest(case).ok()).flatten() else { return };
    let count = reference.times().len();
    for (friction, rows) in case.frictions().zip(all) {
        let (name, is_force) = friction.name();
        let channel = match friction.seat {
            FrictionSeat::Joint { .. } if is_force => format!("joint.{name}.friction_N"),
            FrictionSeat::Joint { .. } => format!("joint.{name}.friction_N_m"),
            FrictionSeat::Mesh { .. } => format!("transmission.{name}.force_N"),
        };
        if reference.named(&channel).is_none() {
            continue;
        }
        let solved = rows.iter().step_by(rows.len().div_ceil(MOST_AT_REST).max(1));
        let ranges = solved.filter_map(|&row| Some((row, effort_at_rest(case, row).ok()??)));
        let widest = ranges.max_by(|(_, a), (_, b)| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        let Some((row, range)) = widest.filter(|(_, range)| range[1] > range[0]) else { continue };
        let unit = if case.crank().input == Input::Slide { "N" } else { "N m" };
        let [least, most] = range.map(|own| quantity(own, unit));
        let at = input_in(reference.told(row), 1);
        let what = if friction.is_mesh() { "Transmission" } else { "Joint" };
        let told = sentences::it_rests(&what, &name, &rows.len(), &count, &at, &least, &most);
        say!(text, "\n{}", wrapped(&told, width, 2));
    }
}

/// Reports the number of instants that are not judged, and the quantities concerned.
/// Also reports joints that rest, and followers that leave their cams.
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
    at_rest(proof, width, text);
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
