//! Several engines side by side, and the party that disagrees with all other parties.
//! The reports also show the forces that an engine itself exerts, beside the forces that follow from its motion.

use super::cells::{fitted, share, trimmed};
use super::judged::{grade, worst};
use crate::sentences;
use linkage::solver::Provision;
use linkage::trajectory::Stage;
use prover::bounds::overall;
use prover::numbers;
use prover::run::{EngineProof, ForceFault, Proof};

/// A table with one row per engine and one column per stage.
/// A cell shows the worst channel: the worst by verdict, and among equal verdicts the one with the largest ratio of
/// error to bound.
pub fn table(engines: &[EngineProof], width: Option<usize>) -> String {
    let rows = engines.iter().map(|engine| {
        let verdict = engine.failure.as_ref().map_or(engine.verdict.word(), |_| "failed").to_string();
        let stages = Stage::ALL.map(|stage| of_stage(engine, stage));
        [engine.info.name.to_string()].into_iter().chain(stages).chain([verdict])
    });
    let header = format!("engine | {}> | verdict", Stage::ALL.map(Stage::name).join("> | "));
    trimmed(fitted(&header, width).add_rows(rows))
}

/// Error and bound of the worst channel of a stage, both divided by the channel's scale, and a mark if the stage does
/// not agree.
fn of_stage(engine: &EngineProof, stage: Stage) -> String {
    let own = || engine.channels.iter().filter(|channel| channel.residual.channel.kind.stage == stage);
    let Some(worst) = worst(own()) else { return "-".into() };
    let residual = &worst.residual;
    let mark = grade(&overall(own().map(|channel| &channel.verdict))).of(["", " ?", " !"]);
    format!("{} ({}){mark}", share(residual.max, residual.scale), share(worst.bound, residual.scale))
}

/// States which parties disagree with each other, and which party disagrees with all other parties.
pub fn disputes(proof: &Proof) -> String {
    let mut text = String::new();
    for engine in &proof.engines {
        if let Some(error) = &engine.failure {
            say!(text, "{} failed: {}", engine.info.name, error.message());
        }
    }
    if proof.disputes.is_empty() {
        text.push_str(sentences::NO_TWO_OF_THEM_DIFFER_BY_MORE);
        return text;
    }
    for party in [proof.reference].into_iter().chain(proof.engines.iter().map(|engine| engine.info.name)) {
        let alone = proof.disputes.iter().filter(|dispute| dispute.odd == Some(party));
        if let Some(first) = alone.clone().next() {
            say!(text, sentences::the_odd_one_out_in_channels(&alone.count(), &party, &first.channel));
        }
    }
    let open = proof.disputes.iter().filter(|dispute| dispute.odd.is_none());
    if let Some(first) = open.clone().next() {
        let pairs: Vec<String> = first.pairs.iter().map(|[a, b]| format!("{a} and {b}")).collect();
        let (count, channel, pairs) = (open.count(), &first.channel, pairs.join(", "));
        say!(text, sentences::in_channels_no_single_one_stands(&count, &channel, &pairs));
    }
    text.truncate(text.trim_end().len());
    text
}

/// How an engine's joint reactions are obtained: read from the engine, or derived by the stated method.
pub fn source(engine: &EngineProof) -> &str {
    match engine.info.provides.iter().find(|(stage, _)| *stage == Stage::Reactions.name()) {
        Some((_, Provision::Derived(how))) => how,
        Some((_, Provision::Computed)) | None => "read",
    }
}

/// Verdict on the forces that an engine itself exerts, and the worst of their channels.
pub fn exerted(own: &EngineProof) -> String {
    let Some(worst) = worst(&own.channels) else { return "none".into() };
    let (residual, unit) = (&worst.residual, worst.residual.channel.kind.unit);
    let [error, bound] = [residual.max, worst.bound].map(|value| numbers::error_in(value, unit.symbol()));
    let numbers = sentences::of_in(&error, &bound, &residual.channel);
    sentences::channels_at_most(&own.channels.len(), &own.verdict.word(), &numbers)
}

/// A sentence that says which forces are wrong: those computed from the motion, those that the engine exerts, or both.
pub fn sentence(fault: ForceFault) -> &'static str {
    match fault {
        ForceFault::Reading => sentences::THE_ENGINE_MOTION_AND_THE_FORCES_THAT_IT_EXERTS,
        ForceFault::Exerted => sentences::THE_ENGINE_MOTION_AND_THE_FORCES,
        ForceFault::Both => sentences::THE_MOTION_AGREES_AND_THE_FORCES,
    }
}
