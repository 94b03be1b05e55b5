//! Proofs as text for the terminal.

use std::fmt::Write;

use comfy_table::Table;

use super::cells::{share, table, used};
use super::diagnosis;
use super::engines;
use super::own_forces;
use super::tell::Tell;
use crate::compare::{Check, Verdict};
use crate::proof::{ChannelProof, End, EngineInfo, EngineProof, OwnForces, Proof, Search};
use linkage::error::Advice;

/// Number of reasons that are shown in full; the others are only counted.
const REASONS: usize = 5;

/// The whole report of one proof, with its advice worded by `tell`.
#[must_use]
pub fn proof(proof: &Proof, tell: Tell) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "{}: {}", proof.scenario, proof.title);
    let _ = writeln!(text, "structure  {}", proof.formula);
    let _ = writeln!(text, "reference  {}, {} instants", proof.reference, proof.reference_trajectory.times().len());
    for engine in &proof.engines {
        let name = if proof.engines.len() > 1 { format!("{}: ", engine.info.name) } else { String::new() };
        let _ = writeln!(text, "engine     {name}{}", described(&engine.info));
        if let Some(search) = &engine.search {
            let _ = writeln!(text, "settings   {name}{}", found(&engine.info, search));
        }
    }
    match proof.engines.as_slice() {
        [only] => {
            let _ = writeln!(
                text,
                "\nEngine against reference, the worst channel of each quantity:\n{}",
                channels(&only.channels)
            );
        }
        several => {
            let _ = writeln!(
                text,
                "\nSide by side, the largest error over its scale (and its bound):\n{}",
                engines::table(several)
            );
            let _ = writeln!(text, "\n{}", engines::disputes(proof));
        }
    }
    for engine in &proof.engines {
        own_section(engine, proof.engines.len() > 1, &mut text);
    }
    left_out(proof, &mut text);
    let all: Vec<&Check> = proof.all_checks().collect();
    let _ = writeln!(text, "\nChecks:\n{}", checks(&all));
    expected(proof, &mut text);
    reasons(proof, tell, &mut text);
    let _ = writeln!(text, "\n{}", sentence(&proof.verdict, proof));
    if let (Some(found), Verdict::Disagree { .. }) = (&proof.diagnosis, &proof.verdict) {
        let _ = writeln!(text, "\n{}", diagnosis::text(found));
    }
    text
}

/// An engine, its resolution and the sources of its own error.
fn described(info: &EngineInfo) -> String {
    let resolution = info.settings.resolution;
    let [at, coarse, fine] = [resolution, 2.0 * resolution, resolution / 2.0].map(seconds);
    let name = &info.version;
    match info.controls_error {
        true => format!("{name}, accuracy {at}, and its own error from {coarse} and {fine}"),
        false => format!("{name}, step {at} s, and its own error from {coarse} and {fine} s"),
    }
}

/// The section on an engine's own forces, after the table of its channels: a table, or a line beside `several` engines.
fn own_section(engine: &EngineProof, several: bool, text: &mut String) {
    let Some(own) = &engine.own_forces else { return };
    let route = own.info.settings.route.name();
    match &own.failure {
        Some(error) => {
            let _ = writeln!(
                text,
                "\nForces as {} itself exerts them (route {route}) failed: {}",
                engine.info.name,
                error.message()
            );
        }
        None if several => {
            let _ = writeln!(
                text,
                "\nForces as {} itself exerts them (route {route}): {}",
                engine.info.name,
                own_forces::line(own)
            );
        }
        None => {
            let _ = writeln!(text, "\nThe forces above: {}.", own_forces::source(engine));
            let _ = writeln!(text, "Forces as the engine itself exerts them, by {}", own_how(own));
            let _ = writeln!(text, "{}", channels(&own.channels));
        }
    }
    if let Some(fault) = engine.force_fault() {
        let _ = writeln!(text, "\n{}", own_forces::sentence(fault));
    }
}

/// Route, settings and work.
fn own_how(own: &OwnForces) -> String {
    let settings = &own.info.settings;
    let told = own.info.told.iter().find(|(name, _)| *name == "reactions");
    let told = told.map_or_else(|| settings.route.name().to_string(), |(_, told)| told.clone());
    let step = seconds(settings.resolution);
    let search = own.search.as_ref().map(|search| found(&own.info, search)).unwrap_or_default();
    format!("{told}\n(route {}, step {step} s; {search}):", settings.route.name())
}

/// How many instants are not judged, and of what.
fn left_out(proof: &Proof, text: &mut String) {
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
        let _ = writeln!(
            text,
            "\nUp to {most} of {} instants are not judged in {} ({}): a drive or a loaded link reverses there, or the motion begins.",
            proof.reference_trajectory.times().len(),
            quantities.join(", "),
            engine.info.name
        );
    }
}

/// The settings that a proof has found, and the work it took.
fn found(info: &EngineInfo, search: &Search) -> String {
    let times = match info.settings.extrapolated {
        0 => "not extrapolated".into(),
        1 => "extrapolated once".into(),
        times => format!("extrapolated {times} times"),
    };
    let why = match search.end {
        End::Decided => "",
        End::Nothing => "; no other setting was left to choose",
        End::Rounding => "; finer steps would add rounding",
        End::Budget => "; the work that was allowed is done",
    };
    let (sweeps, runs, effort) = (info.settings.sweeps, search.runs, search.effort);
    let plural = if sweeps == 1 { "sweep" } else { "sweeps" };
    format!("found: {sweeps} {plural}, {times}, from {runs} runs with the work of {effort:.1e} steps{why}")
}

/// A step with at most five significant digits; the JSON has all digits.
fn seconds(step: f64) -> String {
    let rounded: f64 = format!("{step:.4e}").parse().unwrap_or(step);
    format!("{rounded:e}")
}

fn sentence(verdict: &Verdict, proof: &Proof) -> String {
    let own: Vec<&ChannelProof> =
        proof.engines.iter().flat_map(|engine| &engine.own_forces).flat_map(|own| &own.channels).collect();
    let closed = own.iter().filter(|own| !matches!(own.verdict, Verdict::Inconclusive { .. })).count();
    let own = own.len();
    let channels = proof.engines.iter().map(|engine| engine.channels.len()).sum::<usize>();
    let channels = match own {
        0 => format!("{channels} channels"),
        _ if closed < own && matches!(verdict, Verdict::Agree { .. }) => {
            format!("{channels} channels, {closed} of {own} forces that the engine itself exerts (the others are open)")
        }
        _ => format!("{channels} channels, {own} forces that the engine itself exerts"),
    };
    let checks = proof.all_checks().count();
    let count = |is: fn(&Verdict) -> bool| verdicts(proof).filter(|(_, verdict)| is(verdict)).count();
    match verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => {
            let known = count(|verdict| matches!(verdict, Verdict::Expected { .. }));
            let expected = if known == 0 { String::new() } else { format!(", {known} disagree as expected") };
            let within = verdicts(proof).filter(|(_, verdict)| matches!(verdict, Verdict::Agree { .. })).count();
            match proof.engines.len() {
                1 => format!("AGREE: {channels} and {} checks are within their bounds{expected}.", checks - known),
                _ => format!("AGREE: {within} channels and checks are within their bounds{expected}."),
            }
        }
        Verdict::Disagree { .. } => {
            let wrong = count(|verdict| matches!(verdict, Verdict::Disagree { .. }));
            format!("DISAGREE: {wrong} of {channels} and {checks} checks are beyond their bounds.")
        }
        Verdict::Inconclusive { .. } => {
            let open = count(|verdict| matches!(verdict, Verdict::Inconclusive { .. }));
            format!("INCONCLUSIVE: {open} of {channels} and {checks} checks prove nothing either way.")
        }
    }
}

fn verdicts(proof: &Proof) -> impl Iterator<Item = (String, &Verdict)> {
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
    channels.chain(proof.all_checks().map(|c| (c.name(), &c.verdict)))
}

fn reasons(proof: &Proof, tell: Tell, text: &mut String) {
    let of_report = |verdict: &Verdict| matches!(verdict, Verdict::Disagree { .. } | Verdict::Inconclusive { .. });
    // An engine without a run that stands has no channel to say so.
    let without_run = proof.engines.iter().filter(|engine| engine.channels.is_empty() && engine.failure.is_none());
    let without_run = without_run.map(|engine| (engine.info.name.to_string(), &engine.verdict));
    let open: Vec<(String, &Verdict)> =
        without_run.chain(verdicts(proof)).filter(|(_, verdict)| of_report(verdict)).collect();
    for (name, verdict) in open.iter().take(REASONS) {
        let _ = writeln!(text, "\n{name}: {}", verdict.reason(tell).unwrap_or_default());
    }
    if open.len() > REASONS {
        let _ = writeln!(text, "\n... and {} more ({})", open.len() - REASONS, tell(&Advice::AllResults));
    }
}

/// Verdict on a family of checks; `expected` if all wrong numbers are known to be wrong.
fn family_word<'a>(family: impl Iterator<Item = &'a Check> + Clone) -> &'static str {
    let word = crate::compare::overall(family.clone().map(|check| &check.verdict)).word();
    let known = family.clone().any(|check| matches!(check.verdict, Verdict::Expected { .. }));
    if known && word == "agree" { "expected" } else { word }
}

/// The published numbers that are wrong as expected, by finding.
fn expected(proof: &Proof, text: &mut String) {
    let mut findings: Vec<(&str, usize)> = Vec::new();
    for check in proof.all_checks() {
        if let Verdict::Expected { finding, .. } = &check.verdict {
            match findings.iter_mut().find(|(known, _)| known == finding) {
                Some((_, count)) => *count += 1,
                None => findings.push((finding, 1)),
            }
        }
    }
    for (finding, count) in findings {
        let _ = writeln!(text, "\n{count} checks disagree as expected, see docs/findings.md#{finding}");
    }
}

fn channels(channels: &[ChannelProof]) -> Table {
    let header = ["quantity", "worst channel", "crank deg", "error", "of scale", "bound", "order", "verdict"];
    let mut table = table(header, &[2, 3, 4, 5, 6]);
    let mut seen: Vec<&str> = Vec::new();
    for first in channels {
        let quantity = first.residual.channel.kind.quantity;
        if seen.contains(&quantity) {
            continue;
        }
        seen.push(quantity);
        let family = || channels.iter().filter(|c| c.residual.channel.kind.quantity == quantity);
        let worst = family().max_by(|a, b| used(a).total_cmp(&used(b))).unwrap_or(first);
        let residual = &worst.residual;
        table.add_row([
            format!("{quantity} ({})", family().count()),
            residual.channel.to_string(),
            format!("{:.1}", residual.worst_crank.to_degrees()),
            format!("{:.1e} {}", residual.max, residual.channel.kind.unit),
            share(residual.max, residual.scale),
            share(worst.bound, residual.scale),
            order(worst.convergence.observed),
            crate::compare::overall(family().map(|c| &c.verdict)).word().to_string(),
        ]);
    }
    table
}

fn order(observed: f64) -> String {
    if observed.is_nan() { "rounding".into() } else { format!("{observed:.2}") }
}

fn checks(checks: &[&Check]) -> Table {
    let mut table = table(["check", "numbers", "worst", "bound", "basis", "verdict"], &[1, 2, 3]);
    let mut seen: Vec<&str> = Vec::new();
    for first in checks {
        if seen.contains(&first.family.as_str()) {
            continue;
        }
        seen.push(&first.family);
        let family = || checks.iter().copied().filter(|check| check.family == first.family);
        let worst = family().max_by(|a, b| a.used().total_cmp(&b.used())).unwrap_or(first);
        let unit = |value: f64| format!("{value:.1e} {}", worst.unit).trim_end().to_string();
        let detail = if worst.detail.is_empty() { String::new() } else { format!(", worst in {}", worst.detail) };
        table.add_row([
            format!("{}{detail}", first.family),
            family().count().to_string(),
            unit(worst.value),
            unit(worst.bound),
            worst.basis.origin().word().to_string(),
            family_word(family()).to_string(),
        ]);
    }
    table
}
