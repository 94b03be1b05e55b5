//! Proofs as text for the terminal.

use comfy_table::Table;

use crate::plain::brief;
use crate::plain::cells::{distinct, fitted, share, trimmed, used};
use crate::plain::engines;
use crate::plain::own_forces;
use crate::plain::reasons::{self, count};
use crate::plain::style::wrapped;
use crate::plain::tell::Tell;
use prover::compare::{Check, Verdict};
use prover::numbers;
use prover::proof::{ChannelProof, End, EngineInfo, EngineProof, Proof, Search};

/// Number of reasons that are shown in full; the others are only counted.
const REASONS: usize = 5;

/// The whole report of one proof, with its advice worded by `tell`: verdict and worst channels, then everything else. Its
/// lines have at most `width` columns, if there is a width.
#[must_use]
pub fn proof(proof: &Proof, tell: Tell, width: Option<usize>) -> String {
    let mut text = format!("{}\n{}\n", brief::verdict_line(proof), sentence(&proof.verdict, proof));
    brief::worst(proof, width, &mut text);
    text.push('\n');
    let mut line = |what: &str, told: &str| {
        say!(text, "{}", wrapped(&format!("{what:<11}{told}"), width, 11));
    };
    line("title", &proof.title);
    line("structure", &proof.formula);
    let instants = proof.reference_trajectory.times().len();
    line("reference", &format!("{}, {instants} instants", proof.reference));
    for engine in &proof.engines {
        let name = if proof.engines.len() > 1 { format!("{}: ", engine.info.name) } else { String::new() };
        line("engine", &format!("{name}{}", described(&engine.info)));
        if let Some(search) = &engine.search {
            line("settings", &format!("{name}{}", found(&engine.info, search)));
        }
    }
    match proof.engines.as_slice() {
        [only] => {
            let table = trimmed(&channels(&only.channels, width));
            say!(text, "\nEngine against reference, the worst channel of each quantity:\n{table}");
        }
        several => {
            let table = trimmed(&engines::table(several, width));
            say!(text, "\nSide by side, the largest error over its scale (and its bound):\n{table}");
            say!(text, "\n{}", wrapped(&engines::disputes(proof), width, 2));
        }
    }
    for engine in &proof.engines {
        own_section(engine, proof.engines.len() > 1, width, &mut text);
    }
    reasons::left_out(proof, width, &mut text);
    let all: Vec<&Check> = proof.all_checks().collect();
    say!(text, "\nChecks:\n{}", trimmed(&checks(&all, width)));
    reasons::expected(proof, tell, &mut text);
    reasons::reasons(proof, tell, width, REASONS, &mut text);
    reasons::diagnosed(proof, width, &mut text);
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
fn own_section(engine: &EngineProof, several: bool, width: Option<usize>, text: &mut String) {
    let Some(own) = &engine.own_forces else { return };
    let route = own.info.settings.route.name();
    match &own.failure {
        Some(error) => {
            let (name, why) = (engine.info.name, error.message());
            let told = format!("Forces as {name} itself exerts them (route {route}) are not judged: {why}");
            say!(text, "\n{}", wrapped(&told, width, 2));
        }
        None if several => {
            let (name, how) = (engine.info.name, own_forces::line(own));
            let told = format!("Forces as {name} itself exerts them (route {route}): {how}");
            say!(text, "\n{}", wrapped(&told, width, 2));
        }
        None => {
            let source = format!("The forces above: {}.", own_forces::source(engine));
            let told = format!("{source}\nForces as the engine itself exerts them, by {}", own_how(own));
            say!(text, "\n{}", wrapped(&told, width, 2));
            say!(text, "{}", trimmed(&channels(&own.channels, width)));
        }
    }
    if let Some(fault) = engine.force_fault() {
        say!(text, "\n{}", wrapped(own_forces::sentence(fault), width, 2));
    }
}

/// Route, settings and work.
fn own_how(own: &EngineProof) -> String {
    let settings = &own.info.settings;
    let told = own.info.told.iter().find(|(name, _)| *name == "reactions");
    let told = told.map_or_else(|| settings.route.name().to_string(), |(_, told)| told.clone());
    let step = seconds(settings.resolution);
    let search = own.search.as_ref().map(|search| found(&own.info, search)).unwrap_or_default();
    format!("{told}\n(route {}, step {step} s; {search}):", settings.route.name())
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
        End::Pace => "; at this pace the work that was allowed would not be enough",
    };
    let (sweeps, runs, effort) = (info.settings.sweeps, search.runs, search.effort);
    let plural = if sweeps == 1 { "sweep" } else { "sweeps" };
    format!(
        "found: {sweeps} {plural}, {times}, from {runs} runs with the work of {} steps{why}",
        numbers::error(effort)
    )
}

/// A step with at most five significant digits; the JSON has all digits.
fn seconds(step: f64) -> String {
    numbers::significant(step, 5)
}

/// How much was judged, and what came of it.
pub(super) fn sentence(verdict: &Verdict, proof: &Proof) -> String {
    let own: Vec<&ChannelProof> =
        proof.engines.iter().flat_map(|engine| &engine.own_forces).flat_map(|own| &own.channels).collect();
    let closed = own.iter().filter(|own| !matches!(own.verdict, Verdict::Inconclusive { .. })).count();
    let own = own.len();
    let channels = proof.reference_trajectory.channels().len();
    let channels = match own {
        0 => format!("{channels} channels"),
        _ if closed < own && matches!(verdict, Verdict::Agree { .. }) => {
            format!("{channels} channels, {closed} of {own} forces that the engine itself exerts (the others are open)")
        }
        _ => format!("{channels} channels, {own} forces that the engine itself exerts"),
    };
    let checks = proof.all_checks().count();
    match verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => {
            let known = count(proof, |verdict| matches!(verdict, Verdict::Expected { .. }));
            let expected = if known == 0 { String::new() } else { format!(", {known} disagree as expected") };
            let within = count(proof, |verdict| matches!(verdict, Verdict::Agree { .. }));
            match proof.engines.len() {
                1 => format!("{channels} and {} checks are within their bounds{expected}.", checks - known),
                _ => format!("{within} channels and checks are within their bounds{expected}."),
            }
        }
        Verdict::Disagree { .. } => {
            let wrong = count(proof, |verdict| matches!(verdict, Verdict::Disagree { .. }));
            let are = if wrong == 1 { "number is beyond its bound" } else { "numbers are beyond their bounds" };
            format!("{wrong} {are}, of {channels} and {checks} checks.")
        }
        Verdict::Inconclusive { .. } => {
            let open = count(proof, |verdict| matches!(verdict, Verdict::Inconclusive { .. }));
            let prove = if open == 1 { "number proves" } else { "numbers prove" };
            format!("{open} {prove} nothing either way, of {channels} and {checks} checks.")
        }
    }
}

/// Verdict on a family of checks; `expected` if all wrong numbers are known to be wrong.
fn family_word<'a>(family: impl Iterator<Item = &'a Check> + Clone) -> &'static str {
    let word = prover::compare::overall(family.clone().map(|check| &check.verdict)).word();
    let known = family.clone().any(|check| matches!(check.verdict, Verdict::Expected { .. }));
    if known && word == "agree" { "expected" } else { word }
}

fn channels(channels: &[ChannelProof], width: Option<usize>) -> Table {
    let header = ["quantity", "worst channel", "crank deg", "error", "of scale", "bound", "order", "verdict"];
    let mut table = fitted(header, &[2, 3, 4, 5, 6], width);
    for quantity in distinct(channels.iter().map(|own| own.residual.channel.kind.quantity)) {
        let family = || channels.iter().filter(|c| c.residual.channel.kind.quantity == quantity);
        let Some(worst) = family().max_by(|a, b| used(a).total_cmp(&used(b))) else { continue };
        let residual = &worst.residual;
        table.add_row([
            format!("{quantity} ({})", family().count()),
            residual.channel.to_string(),
            numbers::fixed(residual.worst_crank.to_degrees(), 1),
            numbers::error_in(residual.max, residual.channel.kind.unit.symbol()),
            share(residual.max, residual.scale),
            share(worst.bound, residual.scale),
            order(worst.convergence.observed),
            prover::compare::overall(family().map(|c| &c.verdict)).word().to_string(),
        ]);
    }
    table
}

fn order(observed: f64) -> String {
    if observed.is_nan() { "rounding".into() } else { format!("{observed:.2}") }
}

fn checks(checks: &[&Check], width: Option<usize>) -> Table {
    let mut table = fitted(["check", "numbers", "worst", "bound", "basis", "verdict"], &[1, 2, 3], width);
    for name in distinct(checks.iter().map(|check| check.family.as_str())) {
        let family = || checks.iter().copied().filter(|check| check.family == name);
        let Some(worst) = family().max_by(|a, b| a.used().total_cmp(&b.used())) else { continue };
        let detail = if worst.detail.is_empty() { String::new() } else { format!(", worst in {}", worst.detail) };
        table.add_row([
            format!("{name}{detail}"),
            family().count().to_string(),
            numbers::error_in(worst.value, worst.unit),
            numbers::error_in(worst.bound, worst.unit),
            worst.basis.origin().word().to_string(),
            family_word(family()).to_string(),
        ]);
    }
    table
}
