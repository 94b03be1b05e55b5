//! The short report of a proof: the verdict in one line, the worst channels, and all information that the user needs to
//! act.

use super::cells::{flush, trimmed};
use super::judged::{self, Grade, counts, grade, ranked, verdicts};
use super::style::{self, wrapped};
use super::{Tell, engines, reasons};
use crate::sentences;
use linkage::trajectory::{Channel, Trajectory, Unit};
use prover::numbers;
use prover::run::{EngineInfo, Proof};

/// Number of channels that are shown with their values.
const WORST: usize = 3;

/// The verdict in one line: scenario, verdict, how much was judged, and the step.
/// Each channel of the scenario counts once, even if there are several engines or if a force is judged twice: computed
/// from the motion, and exerted by the engine.
/// In contrast, the number of results includes everything that was judged.
#[must_use]
pub fn verdict_line(proof: &Proof) -> String {
    let (checks, all) = (proof.all_checks().count(), judged::of(proof).len());
    let channels = proof.reference_trajectory.channels().len();
    let failed: Vec<&str> =
        proof.engines.iter().filter(|engine| engine.failure.is_some()).map(|engine| engine.info.name).collect();
    let [.., wrong, open] = counts(verdicts(proof).into_iter().map(|(_, verdict)| verdict));
    let what = match grade(&proof.verdict) {
        Grade::Agree => {
            sentences::channels_and_checks(&channels, &if channels == 1 { "quantity" } else { "quantities" }, &checks)
        }
        Grade::Disagree => sentences::of_numbers_differ(&wrong, &all),
        Grade::Open if !failed.is_empty() => format!("{} failed", failed.join(", ")),
        Grade::Open if proof.engines.iter().all(|engine| engine.channels.is_empty()) => sentences::NO_RUN_STANDS.into(),
        Grade::Open => sentences::of_numbers_are_open(&open, &all),
    };
    format!("{}: {}: {what}; {}", proof.scenario, style::verdict(&proof.verdict), resolution(proof))
}

/// The step or accuracy of a single engine; with several engines, the number of engines.
pub fn resolution(proof: &Proof) -> String {
    match proof.engines.as_slice() {
        [only] => of_engine(&only.info),
        several => format!("{} engines", several.len()),
    }
}

fn of_engine(info: &EngineInfo) -> String {
    let resolution = info.settings.resolution;
    match info.controls_error {
        true => format!("accuracy {}", numbers::error(resolution)),
        false => sentences::step_ms(&numbers::significant(1e3 * resolution, 4)),
    }
}

/// The short report, in lines of at most `width` columns; `tell` puts the advice into words.
#[must_use]
pub fn proof(proof: &Proof, tell: Tell, width: usize) -> String {
    let width = Some(width);
    let mut text = format!("{}\n", verdict_line(proof));
    worst(proof, width, &mut text);
    let mut paragraph = |told: &str| say!(text, "\n{}", wrapped(told, width, 2));
    if proof.engines.len() > 1 {
        paragraph(&engines::disputes(proof));
    }
    for engine in &proof.engines {
        if let Some(fault) = engine.force_fault() {
            paragraph(engines::sentence(fault));
        }
    }
    // If the proof agrees, undecided results do not change its verdict, so only the first reason is shown.
    let most = if grade(&proof.verdict) == Grade::Agree { 1 } else { WORST };
    reasons::reasons(proof, tell, width, most, &mut text);
    reasons::diagnosed(proof, width, &mut text);
    reasons::notes(proof, width, &mut text);
    reasons::expected(proof, tell, &mut text);
    text
}

/// The worst channels at their worst instants: both values, their difference and the bound.
pub fn worst(proof: &Proof, width: Option<usize>, text: &mut String) {
    let all = ranked(proof);
    if all.is_empty() {
        return;
    }
    let engine = match proof.engines.as_slice() {
        [only] => only.info.name,
        _ => "engine",
    };
    let input = proof.reference_trajectory.input();
    let (at_unit, reference) = (input.shown_in().0, proof.reference);
    let header = format!("worst channel | at {at_unit}> | {reference}> | {engine}> | error> | bound> | unit");
    let mut table = flush(&header, width);
    for (engine, channel) in all.into_iter().take(WORST) {
        let (residual, kind) = (&channel.residual, channel.residual.channel.kind);
        let name = match proof.engines.len() {
            1 => residual.channel.without_unit(),
            _ => format!("{} ({})", residual.channel.without_unit(), engine.info.name),
        };
        let (factor, unit) = read(kind.unit);
        let [difference, bound] = [factor * residual.max, factor * channel.bound];
        let value = |side: &Trajectory| at(side, &residual.channel, residual.worst_time).map(|value| factor * value);
        // Reference and engine have a value of every judged channel, so no judged channel is skipped.
        let found = engine.trajectory.as_ref().and_then(value);
        let (Some(right), Some(found)) = (value(&proof.reference_trajectory), found) else { continue };
        // An angle may differ by whole revolutions, which do not count as a difference, so they are subtracted.
        let turns = if kind.periodic { 360.0 * ((found - right) / 360.0).round() } else { 0.0 };
        let [right, found] = numbers::beside([right, found - turns], bound);
        table.add_row([
            name,
            numbers::fixed(input.shown(residual.worst_crank), 1),
            right,
            found,
            numbers::error(difference),
            numbers::error(bound),
            unit,
        ]);
    }
    say!(text, "\n{}", trimmed(&table));
}

/// Value of a channel at an instant of the grid.
fn at(side: &Trajectory, channel: &Channel, time: f64) -> Option<f64> {
    let row = side.times().iter().position(|&own| own == time)?;
    side.column(channel)?.get(row).copied()
}

/// Factor and symbol of the unit for display: degrees and millimetres.
fn read(unit: Unit) -> (f64, String) {
    match unit {
        Unit::Radian => (1f64.to_degrees(), "deg".into()),
        Unit::Metre => (1e3, "mm".into()),
        Unit::RadianPerSecond
        | Unit::RadianPerSecondSquared
        | Unit::MetrePerSecond
        | Unit::MetrePerSecondSquared
        | Unit::Newton
        | Unit::NewtonMetre => (1.0, unit.to_string()),
    }
}
