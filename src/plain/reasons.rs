//! All information besides the verdict that an engineer needs to act.
//! This information states why something disagrees or is open, what was not judged, and which printed numbers are known
//! to be wrong.

use super::formula_blocks::{self, Line};
use super::judged::{Grade, grade, unproven};
use super::style::wrapped;
use super::{Tell, diagnosis};
use crate::sentences;
use analytic::assur::{effort_at_rest, rows_at_rest};
use linkage::case::{CaseParts, FrictionSeat};
use linkage::error::Advice;
use linkage::input::Input;
use linkage::math::statistics::distinct;
use linkage::mechanism::{CamContact, CamFigures, Transmission, TransmissionKind};
use linkage::trajectory::Channel;
use prover::bounds::{Check, Verdict};
use prover::numbers::{input_in, quantity, significant};
use prover::run::Proof;

/// The reason why something disagrees or is open, and the number of verdicts with that reason.
pub struct Reason {
    key: String,
    /// The name of the first judged number with this reason, and the reason.
    pub told: String,
    /// Number of verdicts with this reason.
    pub count: usize,
}

/// Largest number of blocks of a kind; further ones are only counted.
pub const MOST: usize = 10;

/// A block for each value or derivative of a formula that is wrong or open. If the value is wrong, its derivatives have
/// no block.
#[must_use]
pub fn formulas(proof: &Proof, tell: Tell, width: Option<usize>) -> Vec<String> {
    let Some(judgement) = &proof.judgement else { return Vec::new() };
    let mut lines = formula_blocks::lines(&proof.formulas, judgement);
    let told = in_blocks(proof);
    // If the bounds are scaled, the verdict of a check may differ from the verdict of its formula.
    let is_told = |line: &Line| {
        proof
            .formula_checks()
            .any(|(own, check)| own.name == line.judged.name && told.iter().any(|told| std::ptr::eq(*told, check)))
    };
    lines.retain(is_told);
    formula_blocks::blocks(&lines, (&proof.formulas, judgement), tell, width, false)
}

/// The checks of formulas that [`formulas`] explains: unproven checks whose formula is unproven too.
fn in_blocks(proof: &Proof) -> Vec<&Check> {
    let both = proof.formula_checks();
    both.filter(|(own, check)| {
        [formula_blocks::grade(own), grade(&check.verdict)].iter().all(|own| *own != Grade::Agree)
    })
    .map(|(_, check)| check)
    .collect()
}

/// Reasons why something disagrees or is open, with the remedies: a block for each cause, disagreements first.
/// At most `most` blocks are shown; further blocks are only counted.
pub fn reasons(proof: &Proof, tell: Tell, width: Option<usize>, most: usize, text: &mut String) {
    let mut all = formulas(proof, tell, width);
    all.extend(grouped(proof, tell).into_iter().map(|own| wrapped(&own.text(), width, 2)));
    all.iter().take(most).for_each(|block| say!(text, "\n{block}"));
    if all.len() > most {
        say!(text, sentences::and_more_3(&(all.len() - most), &tell(&Advice::AllResults)));
    }
}

impl Reason {
    /// The reason, and the number of further verdicts with the same reason.
    #[must_use]
    pub fn text(&self) -> String {
        let more = match self.count {
            1 => String::new(),
            count => sentences::and_more_alike(&(count - 1)),
        };
        format!("{}{more}", self.told)
    }
}

/// The distinct reasons of all verdicts, disagreements first. Formulas that have a block ([`formulas`]) are left out.
pub fn grouped(proof: &Proof, tell: Tell) -> Vec<Reason> {
    let mut all: Vec<Reason> = Vec::new();
    let told = in_blocks(proof);
    for (name, verdict) in unproven(proof) {
        if told.iter().any(|check| std::ptr::eq(&check.verdict, verdict)) {
            continue;
        }
        let reason = verdict.reason(tell).unwrap_or_default();
        let key = key(&name, verdict, &reason);
        match all.iter_mut().find(|own| own.key == key) {
            Some(own) => own.count += 1,
            None => all.push(Reason { key, told: format!("{name}: {reason}"), count: 1 }),
        }
    }
    all
}

/// Key under which equivalent reasons are counted once.
/// For an inconclusive verdict, the key is the reason without its numbers.
/// For any other verdict, the key is the cause. If the reason states no cause, the key is the name without its side and
/// channel.
fn key(name: &str, verdict: &Verdict, reason: &str) -> String {
    let bare = name.replace(" (assur)", "").replace(" (newton)", "");
    let channel = bare.split([' ', '(']).next().unwrap_or_default();
    match verdict {
        Verdict::Inconclusive { .. } => reason.replace(|sign: char| sign.is_ascii_digit() || ".e-+".contains(sign), ""),
        Verdict::Agree { .. } | Verdict::Expected { .. } | Verdict::Disagree { .. } => {
            match reason.split_once("cause: ") {
                Some((_, cause)) => cause.to_string(),
                None if Channel::named(channel).is_some() => bare.replacen(channel, "", 1),
                None => bare,
            }
        }
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

/// Largest number of instants at rest at which the interval of possible driving moments or forces is computed.
const MOST_AT_REST: usize = 20;

/// Reports each joint with friction and each transmission with losses that is at rest at some instants.
/// Also reports the widest interval of possible moments or forces of the first drive at the instants of rest.
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
        if least == most {
            continue;
        }
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
    let (reference, case) = (&proof.reference_trajectory, &proof.scene.case);
    for own in case.mechanism.transmissions().iter() {
        if let Some(found) = cam_figures(case, own).filter(|found| found.curvature < 0.0) {
            let undercut = significant(-1e3 * found.curvature, 4);
            let told = sentences::the_cam_is_undercut(&own.name(), &undercut, &undercut_remedy(own));
            say!(text, "\n{}", wrapped(&told, width, 2));
        }
    }
    for cam in case.mechanism.transmissions().iter().filter(|own| own.cam.is_some()) {
        let Some(forces) = reference.named(&format!("transmission.{}.force_N", cam.name())) else { continue };
        let is_off = |row: &usize| forces[*row] < 0.0;
        let Some(first) = (0..forces.len()).find(is_off) else { continue };
        let (count, all, at) = ((0..forces.len()).filter(is_off).count(), forces.len(), reference.told(first));
        let told = sentences::the_follower_leaves_the_cam(&cam.name(), &count, &all, &input_in(at, 1));
        say!(text, "\n{}", wrapped(&told, width, 2));
    }
}

/// Figures of a cam; `None` for other transmissions.
pub fn cam_figures(case: &CaseParts, own: &Transmission) -> Option<CamFigures> {
    let cam = own.cam.as_ref()?;
    Some(cam.figures(own.coordinates_in(case.mechanism.joints(), &case.start.motions())))
}

/// How the profile of an undercut cam becomes possible.
pub fn undercut_remedy(cam: &Transmission) -> &'static str {
    match cam.design.kind {
        TransmissionKind::Cam { contact: CamContact::Roller { radius, .. }, .. } if radius > 0.0 => {
            sentences::ENLARGE_THE_BASE_CIRCLE_OR_REDUCE_THE_ROLLER
        }
        TransmissionKind::Cam { .. }
        | TransmissionKind::Gears { .. }
        | TransmissionKind::Rack { .. }
        | TransmissionKind::Screw { .. }
        | TransmissionKind::Belt { .. } => sentences::ENLARGE_THE_BASE_CIRCLE,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equivalent_reasons_have_the_same_key() {
        let open = Verdict::Inconclusive { reason: String::new(), advice: Vec::new() };
        let wrong = Verdict::Disagree { place: String::new() };
        let keys = [("a", "may reach 2.4 %"), ("b", "may reach 46 %")].map(|(name, why)| key(name, &open, why));
        assert_eq!(keys[0], keys[1]);
        let sides = ["x (assur), y", "x (newton), y"].map(|name| key(name, &wrong, "1 N is beyond the bound"));
        assert_eq!(sides[0], sides[1]);
        assert_ne!(sides[0], key("z (assur), y", &wrong, "1 N is beyond the bound"));
        for suffix in ["", " (rapier)", " as the engine exerts it"] {
            let names = ["link.crank.x_m", "point.B.y_m"].map(|name| format!("{name}{suffix}"));
            let keys = names.map(|name| key(&name, &wrong, "1e-3 is beyond 1e-6"));
            assert_eq!(keys[0], keys[1]);
        }
    }
}
