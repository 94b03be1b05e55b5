//! The short report of a proof: the verdict in one line, the channels that are worst, and whatever is needed to act.

use super::cells::{flush, trimmed, used};
use super::engines;
use super::own_forces;
use super::reasons::{self, count};
use super::style;
use super::tell::Tell;
use linkage::trajectory::{Channel, Trajectory, Unit};
use prover::compare::Verdict;
use prover::numbers;
use prover::proof::{ChannelProof, EngineInfo, EngineProof, Proof};

/// Channels that are shown with their values.
const WORST: usize = 3;

/// The verdict in one line: scenario, verdict, how much was judged, at which step. Channels are those of the scenario,
/// whatever the number of engines, and forces that are judged twice count once; numbers are all that were judged.
#[must_use]
pub fn verdict_line(proof: &Proof) -> String {
    let checks = proof.all_checks().count();
    let own = |engine: &EngineProof| engine.own_forces.as_ref().map_or(0, |own| own.channels.len());
    let judged: usize = proof.engines.iter().map(|engine| engine.channels.len() + own(engine)).sum();
    let channels = proof.reference_trajectory.channels().len();
    let failed: Vec<&str> =
        proof.engines.iter().filter(|engine| engine.failure.is_some()).map(|engine| engine.info.name).collect();
    let what = match &proof.verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => format!("{channels} channels and {checks} checks"),
        Verdict::Disagree { .. } => {
            let wrong = count(proof, |verdict| matches!(verdict, Verdict::Disagree { .. }));
            format!("{wrong} of {} numbers differ", judged + checks)
        }
        Verdict::Inconclusive { .. } if !failed.is_empty() => format!("{} failed", failed.join(", ")),
        Verdict::Inconclusive { .. } if proof.engines.iter().all(|engine| engine.channels.is_empty()) => {
            "no run stands".to_string()
        }
        Verdict::Inconclusive { .. } => {
            let open = count(proof, |verdict| matches!(verdict, Verdict::Inconclusive { .. }));
            format!("{open} of {} numbers are open", judged + checks)
        }
    };
    format!("{}: {}: {what}; {}", proof.scenario, style::verdict(&proof.verdict), resolution(proof))
}

/// The step or accuracy of the engine, or how many engines there are.
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
        false => format!("step {} ms", numbers::significant(1e3 * resolution, 4)),
    }
}

/// The short report, in lines of at most `width` columns; advice is worded by `tell`.
#[must_use]
pub fn proof(proof: &Proof, tell: Tell, width: usize) -> String {
    let width = Some(width);
    let mut text = format!("{}\n", verdict_line(proof));
    worst(proof, width, &mut text);
    if proof.engines.len() > 1 {
        say!(text, "\n{}", style::wrapped(&engines::disputes(proof), width, 2));
    }
    for engine in &proof.engines {
        if let Some(own) = &engine.own_forces
            && let Some(error) = &own.failure
        {
            let told = format!("Forces as {} itself exerts them are not judged: {}", engine.info.name, error.message());
            say!(text, "\n{}", style::wrapped(&told, width, 2));
        }
        if let Some(fault) = engine.force_fault() {
            say!(text, "\n{}", style::wrapped(own_forces::sentence(fault), width, 2));
        }
    }
    // What is open beside an agreement takes nothing from it.
    let most = match proof.verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => 1,
        Verdict::Disagree { .. } | Verdict::Inconclusive { .. } => WORST,
    };
    reasons::reasons(proof, tell, width, most, &mut text);
    reasons::diagnosed(proof, width, &mut text);
    reasons::left_out(proof, width, &mut text);
    reasons::expected(proof, tell, &mut text);
    text
}

/// All channels of all engines, the one that uses most of its bound first.
pub fn ranked(proof: &Proof) -> Vec<(&EngineProof, &ChannelProof)> {
    let mut all = Vec::new();
    for engine in &proof.engines {
        all.extend(engine.channels.iter().map(|channel| (engine, channel)));
    }
    all.sort_by(|(_, a), (_, b)| used(b).total_cmp(&used(a)));
    all
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
    let header = ["worst channel", "at deg", proof.reference, engine, "error", "bound", "unit"];
    let mut table = flush(header, &[1, 2, 3, 4, 5], width);
    for (engine, channel) in all.into_iter().take(WORST) {
        let (residual, kind) = (&channel.residual, channel.residual.channel.kind);
        let name = match proof.engines.len() {
            1 => residual.channel.to_string(),
            _ => format!("{} ({})", residual.channel, engine.info.name),
        };
        let (factor, unit) = read(kind.unit);
        let [difference, bound] = [factor * residual.max, factor * channel.bound];
        let value = |side: &Trajectory| at(side, &residual.channel, residual.worst_time).map(|value| factor * value);
        let right = value(&proof.reference_trajectory);
        let found = engine.trajectory.as_ref().and_then(value);
        // An angle may differ by whole turns, which nobody counts as a difference.
        let turns = |found: f64| match (kind.periodic, right) {
            (true, Some(right)) => found - 360.0 * ((found - right) / 360.0).round(),
            _ => found,
        };
        // Every channel that is judged has both values.
        let (Some(right), Some(found)) = (right, found.map(turns)) else { continue };
        let [right, found] = numbers::beside([right, found], bound);
        table.add_row([
            name,
            numbers::fixed(residual.worst_crank.to_degrees(), 1),
            right,
            found,
            numbers::error(difference),
            numbers::error(bound),
            unit.into(),
        ]);
    }
    say!(text, "\n{}", trimmed(&table));
}

/// Value of a channel at an instant of the grid.
fn at(side: &Trajectory, channel: &Channel, time: f64) -> Option<f64> {
    let row = side.times().iter().position(|&own| own == time)?;
    side.column(channel)?.get(row).copied()
}

/// Factor and symbol of the unit that people read: degrees and millimetres.
fn read(unit: Unit) -> (f64, &'static str) {
    match unit {
        Unit::Radian => (1f64.to_degrees(), "deg"),
        Unit::Metre => (1e3, "mm"),
        Unit::RadianPerSecond
        | Unit::RadianPerSecondSquared
        | Unit::MetrePerSecond
        | Unit::MetrePerSecondSquared
        | Unit::Newton
        | Unit::NewtonMetre => (1.0, unit.symbol()),
    }
}
