//! The short report of a proof: the verdict, the mechanism as the file describes it, its figures, and all information
//! that the user needs to act.

use super::cells::{flush, trimmed};
use super::judged::{self, Grade, counts, grade, ranked, verdicts};
use super::style::{self, wrapped};
use super::{Tell, engines, figures, machine, reasons};
use crate::sentences;
use linkage::math::KeepNan;
use linkage::trajectory::{Channel, Trajectory, Unit};
use prover::numbers;
use prover::run::{EngineInfo, Proof};

/// Number of channels that are shown with their values.
const WORST: usize = 3;

/// The verdict in one line: scenario, verdict, how much was judged, and the step.
/// Each channel of the scenario counts once, even if there are several engines or if a force is judged twice: computed
/// from the motion, and exerted by the engine.
/// The number of results, in contrast, counts everything that was judged, for every engine.
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

/// The verdict in one sentence for people: who agrees, and how well. `None` unless the proof agrees.
#[must_use]
pub fn agreement(proof: &Proof) -> Option<String> {
    if grade(&proof.verdict) != Grade::Agree {
        return None;
    }
    let names: Vec<&str> = proof.engines.iter().map(|engine| engine.info.name).collect();
    let engines = match names.as_slice() {
        [only] => sentences::the_simulation(&capital(only)),
        several => sentences::the_simulations(&several.iter().map(|own| capital(own)).collect::<Vec<_>>().join(", ")),
    };
    let parties = sentences::both_sides_and(&engines);
    let all = proof.reference_trajectory.channels();
    let is_open = |channel: &&Channel| {
        let own = proof.engines.iter().flat_map(|engine| &engine.channels);
        !own.filter(|own| own.residual.channel == **channel).all(|own| grade(&own.verdict) == Grade::Agree)
    };
    let largest = largest_difference(proof).map_or_else(String::new, |(share, channel)| {
        sentences::the_largest_difference(&numbers::percent(share), &channel.without_unit())
    });
    let open = all.iter().filter(is_open).count();
    Some(match open {
        0 if all.len() == 1 => sentences::the_only_one_agrees(&parties, &largest),
        0 => sentences::all_agree(&parties, &all.len(), &largest),
        _ => sentences::most_agree(&parties, &(all.len() - open), &all.len(), &largest),
    })
}

/// A name with a capital at its beginning.
fn capital(name: &str) -> String {
    let mut signs = name.chars();
    signs.next().map_or_else(String::new, |first| first.to_uppercase().chain(signs).collect())
}

/// Among the agreeing channels, the channel with the largest residual in relation to its range, and this ratio.
/// A channel that varies by no more than its bound has no range.
fn largest_difference(proof: &Proof) -> Option<(f64, &Channel)> {
    let shares = proof.engines.iter().flat_map(|engine| &engine.channels).filter_map(|own| {
        let channel = &own.residual.channel;
        let values = proof.reference_trajectory.column(channel)?;
        let ends = values
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.smaller(*value), high.larger(*value)]);
        let range = ends[1] - ends[0];
        (range > own.bound && grade(&own.verdict) == Grade::Agree).then(|| (own.residual.max / range, channel))
    });
    shares.max_by(|(one, _), (other, _)| one.total_cmp(other))
}

/// The mechanism as the file describes it, and the figures of its motion.
pub fn facts(proof: &Proof, width: Option<usize>, text: &mut String) {
    text.push('\n');
    for (what, told) in machine::rows(proof) {
        say!(text, "{}", wrapped(&format!("{what:<11}{told}"), width, 11));
    }
    let rows = figures::rows(proof);
    if rows.is_empty() {
        return;
    }
    let (word, unit) = figures::place(proof);
    let mut table = flush(&format!("figure | value> | unit | at {word}, {unit}"), width);
    say!(text, "\n{}", trimmed(table.add_rows(rows)));
}

/// The short report, in lines of at most `width` columns; `tell` puts the advice into words.
#[must_use]
pub fn proof(proof: &Proof, tell: Tell, width: usize) -> String {
    let width = Some(width);
    let mut text = format!("{}\n", verdict_line(proof));
    let grade = grade(&proof.verdict);
    if let Some(told) = agreement(proof) {
        say!(text, "{}", wrapped(&told, width, 0));
        facts(proof, width, &mut text);
    } else if proof.engines.iter().flat_map(|own| &own.channels).any(|own| judged::grade(&own.verdict) != Grade::Agree)
    {
        worst(proof, width, &mut text);
    }
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
    let most = if grade == Grade::Agree { 1 } else { reasons::MOST };
    reasons::reasons(proof, tell, width, most, &mut text);
    reasons::diagnosed(proof, width, &mut text);
    reasons::notes(proof, width, &mut text);
    reasons::expected(proof, tell, &mut text);
    if grade != Grade::Agree {
        facts(proof, width, &mut text);
    }
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
