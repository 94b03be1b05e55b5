//! Proofs as text for the terminal.

use crate::plain::cells::{counted, fitted, share, table, trimmed};
use crate::plain::judged::{self, JudgedNumber, Sort, counts, verdicts, worst};
use crate::plain::style::wrapped;
use crate::plain::{Tell, brief, engines, reasons};
use crate::sentences;
use linkage::math::statistics;
use linkage::math::statistics::distinct;
use prover::bounds::{Check, Verdict, overall};
use prover::numbers;
use prover::run::{ChannelProof, EngineInfo, EngineProof, Proof, SearchEnd, SettingsSearch};

/// The whole report of one proof: verdict and worst channels, then everything else.
/// `tell` puts the advice into words.
/// Lines have at most `width` columns, if a width is given.
#[must_use]
pub fn proof(proof: &Proof, tell: Tell, width: Option<usize>) -> String {
    let mut text = format!("{}\n{}\n", brief::verdict_line(proof), sentence(proof));
    if let Some(told) = brief::agreement(proof) {
        say!(text, "{}", wrapped(&told, width, 0));
    }
    brief::facts(proof, width, &mut text);
    brief::worst(proof, width, &mut text);
    text.push('\n');
    let mut line = |what: &str, told: &str| {
        say!(text, "{}", wrapped(&format!("{what:<11}{told}"), width, 11));
    };
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
            let table = channels(&only.channels, width);
            say!(text, sentences::engine_against_reference_the_worst(&table));
        }
        several => {
            let table = engines::table(several, width);
            say!(text, sentences::side_by_side_the_largest(&table));
            say!(text, "\n{}", wrapped(&engines::disputes(proof), width, 2));
        }
    }
    for engine in &proof.engines {
        own_section(engine, proof.engines.len() > 1, width, &mut text);
    }
    reasons::notes(proof, width, &mut text);
    say!(text, "\nChecks:\n{}", checks(proof, width));
    reasons::expected(proof, tell, &mut text);
    reasons::reasons(proof, tell, width, reasons::MOST, &mut text);
    reasons::diagnosed(proof, width, &mut text);
    text
}

/// An engine, its resolution, and the runs from which its error is estimated.
fn described(info: &EngineInfo) -> String {
    let resolution = info.settings.resolution;
    let [at, coarse, fine] = [resolution, 2.0 * resolution, resolution / 2.0].map(seconds);
    let name = &info.version;
    match info.controls_error {
        true => sentences::accuracy_and_its_own_error(&name, &at, &coarse, &fine),
        false => sentences::step_and_its_own_error_from_and(&name, &at, &coarse, &fine),
    }
}

/// The section on the forces that an engine itself exerts, printed after the table of the engine's channels.
/// The section is a table, or a single line if there are `several` engines.
fn own_section(engine: &EngineProof, several: bool, width: Option<usize>, text: &mut String) {
    let Some(own) = &engine.own_forces else { return };
    let (name, route) = (engine.info.name, own.info.settings.route.name());
    let mut paragraph = |told: &str| say!(text, "\n{}", wrapped(told, width, 2));
    match &own.failure {
        Some(error) => {
            let why = error.message();
            paragraph(&sentences::forces_as_itself_exerts_them_route_are_not_judged(&name, &route, &why));
        }
        None if several => {
            let how = engines::exerted(own);
            paragraph(&sentences::forces_as_itself_exerts_them_route(&name, &route, &how));
        }
        None => {
            let (source, how, table) = (engines::source(engine), own_how(own), channels(&own.channels, width));
            paragraph(&sentences::the_forces_above_forces_as_the_engine(&source, &how));
            say!(text, "{table}");
        }
    }
    if let Some(fault) = engine.force_fault() {
        say!(text, "\n{}", wrapped(engines::sentence(fault), width, 2));
    }
}

/// Route, settings and work.
fn own_how(own: &EngineProof) -> String {
    let settings = &own.info.settings;
    let told = own.info.told.iter().find(|(name, _)| *name == "reactions");
    let told = told.map_or_else(|| settings.route.name().to_string(), |(_, told)| told.clone());
    let step = seconds(settings.resolution);
    let search = own.search.as_ref().map(|search| found(&own.info, search)).unwrap_or_default();
    sentences::route_step(&told, &settings.route.name(), &step, &search)
}

/// The settings that a proof has found, and the work of the search.
fn found(info: &EngineInfo, search: &SettingsSearch) -> String {
    let times = match info.settings.extrapolated {
        0 => "not extrapolated".into(),
        1 => "extrapolated once".into(),
        times => sentences::extrapolated_times(&times),
    };
    let why = match search.end {
        SearchEnd::Decided => "",
        SearchEnd::Nothing => sentences::NO_OTHER_SETTING_WAS_LEFT,
        SearchEnd::Rounding => sentences::FINER_STEPS_WOULD_ADD_ROUNDING,
        SearchEnd::Budget => sentences::THE_WORK_THAT_WAS_ALLOWED,
        SearchEnd::Pace => sentences::AT_THIS_PACE_THE_WORK_THAT_WAS_ALLOWED,
    };
    let (sweeps, runs, effort) = (counted(info.settings.sweeps, "sweep"), search.runs, numbers::error(search.effort));
    sentences::found_from_runs_with_the_work(&sweeps, &times, &runs, &effort, &why)
}

/// A step with at most five significant digits; the JSON has all digits.
fn seconds(step: f64) -> String {
    numbers::significant(step, 5)
}

/// How much was judged, and the outcome.
pub(super) fn sentence(proof: &Proof) -> String {
    let forces = proof.engines.iter().flat_map(|engine| &engine.own_forces).flat_map(|own| &own.channels);
    let [agree, expected, wrong, open] = counts(forces.map(|own| &own.verdict));
    let closed = agree + expected + wrong;
    let own = closed + open;
    let channels = proof.reference_trajectory.channels().len();
    let channels = match own {
        0 => format!("{channels} channels"),
        _ if open > 0 && matches!(proof.verdict, Verdict::Agree { .. }) => {
            sentences::channels_of_forces_that_the_engine(&channels, &closed, &own)
        }
        _ => sentences::channels_forces_that_the_engine(&channels, &own),
    };
    let checks = proof.all_checks().count();
    let [within, known, wrong, open] = counts(verdicts(proof).into_iter().map(|(_, verdict)| verdict));
    match proof.verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => {
            let expected = if known == 0 { String::new() } else { sentences::disagree_as_expected(&known) };
            match proof.engines.len() {
                1 => sentences::and_checks_are_within_their(&channels, &(checks - known), &expected),
                _ => sentences::channels_and_checks_are_within(&within, &expected),
            }
        }
        Verdict::Disagree { .. } => {
            let are = if wrong == 1 {
                sentences::NUMBER_IS_BEYOND_ITS_BOUND
            } else {
                sentences::NUMBERS_ARE_BEYOND_THEIR_BOUNDS
            };
            sentences::of_and_checks(&wrong, &are, &channels, &checks)
        }
        Verdict::Inconclusive { .. } => {
            let prove = if open == 1 { "number could not be decided" } else { "numbers could not be decided" };
            sentences::nothing_either_way_of_and_checks(&open, &prove, &channels, &checks)
        }
    }
}

/// The channels as a table with one row per quantity. Of all channels of this quantity, the row shows the worst one: by
/// verdict, then by the ratio of error to bound.
fn channels(channels: &[ChannelProof], width: Option<usize>) -> String {
    let input = channels.first().map(|own| own.residual.input).unwrap_or_default();
    let (word, unit) = (input.word(), input.shown_in().0);
    let header = format!("quantity | worst channel | {word} {unit}> | error> | of scale> | bound> | order> | verdict");
    let quantities = distinct(channels.iter().map(|own| own.residual.channel.kind.quantity));
    let rows = quantities.into_iter().filter_map(|quantity| {
        let family = || channels.iter().filter(|own| own.residual.channel.kind.quantity == quantity);
        let worst = worst(family())?;
        let (residual, order) = (&worst.residual, worst.convergence.observed);
        Some([
            format!("{quantity} ({})", family().count()),
            residual.channel.to_string(),
            numbers::fixed(input.shown(residual.worst_crank), 1),
            numbers::error_in(residual.max, residual.channel.kind.unit.symbol()),
            share(residual.max, residual.scale),
            share(worst.bound, residual.scale),
            if order.is_nan() { "rounding".into() } else { format!("{order:.2}") },
            overall(family().map(|own| &own.verdict)).word().to_string(),
        ])
    });
    trimmed(fitted(&header, width).add_rows(rows))
}

/// The checks as a table with one row per family. Of all checks of this family, the row shows the one with the largest
/// ratio of residual to bound. A family is `expected` if findings explain all its published numbers that are wrong.
fn checks(proof: &Proof, width: Option<usize>) -> String {
    let families = distinct(proof.all_checks().map(|check| check.family.as_str()));
    let rows = families.into_iter().filter_map(|name| {
        let family = || proof.all_checks().filter(|check| check.family == name);
        let worst: &Check = family().max_by(|a, b| a.used().total_cmp(&b.used()))?;
        let detail = if worst.detail.is_empty() { String::new() } else { sentences::worst_in(&worst.detail) };
        let [_, known, wrong, open] = counts(family().map(|check| &check.verdict));
        let is_known = known > 0 && wrong + open == 0;
        Some([
            format!("{name}{detail}"),
            family().count().to_string(),
            numbers::error_in(worst.value, worst.unit),
            numbers::error_in(worst.bound, worst.unit),
            worst.basis.origin().word().to_string(),
            if is_known { "expected" } else { overall(family().map(|check| &check.verdict)).word() }.to_string(),
        ])
    });
    trimmed(fitted("check | numbers> | worst> | bound> | basis | verdict", width).add_rows(rows))
}

/// Every residual of a proof beside its bound, for readers who examine the bounds.
/// The text has a line for every channel of every engine, and for every check.
#[must_use]
pub fn residuals(proof: &Proof) -> String {
    let mut all = judged::of(proof);
    all.sort_by_key(|own| own.sort == Sort::Check);
    let rows = all.into_iter().map(|own| {
        let JudgedNumber { sort, engine, name, value, bound, unit, verdict, .. } = own;
        let side = engine.filter(|_| sort != Sort::Check).map_or("", |engine| engine.info.name);
        let used = numbers::significant(statistics::share(value, bound), 3);
        let [value, bound] = [value, bound].map(|number| numbers::significant(number, 4));
        [name, side.into(), value, bound, unit.into(), used, verdict.word().into()]
    });
    let header = "channel or check | side | residual> | bound> | unit | used> | verdict";
    format!("\n{}\n", trimmed(table(header).add_rows(rows)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use fixtures::of_repository;
    use prover::run::{Options, prove};

    /// Each line has a residual, its bound and their ratio; the lines have the order of the proof.
    #[test]
    fn every_residual_is_printed_beside_its_bound() {
        let proof =
            prove(&of_repository("scenarios/crank_rocker.toml"), &Options::default().step(2e-3).sweeps(16)).unwrap();
        let channels = proof
            .engines
            .iter()
            .flat_map(|engine| engine.channels.iter().chain(engine.own_forces.iter().flat_map(|own| &own.channels)));
        let channels = channels.map(|own| ([own.residual.max, own.bound], own.verdict.word()));
        let checks = proof.all_checks().map(|own| ([own.value, own.bound], own.verdict.word()));
        let text = residuals(&proof);
        let verdicts = ["agree", "disagree", "inconclusive", "expected"];
        let mut lines = text.lines().filter(|line| verdicts.iter().any(|word| line.ends_with(word)));
        for ([value, bound], verdict) in channels.chain(checks) {
            let line = lines.next().unwrap();
            let numbers: Vec<f64> = line.split_whitespace().filter_map(|cell| cell.parse().ok()).collect();
            let found = &numbers[numbers.len() - 3..];
            for (found, wanted) in found.iter().zip([value, bound, value / bound]) {
                assert!((found - wanted).abs() <= 5e-3 * wanted.abs(), "{line}: {found} {wanted}");
            }
            assert!(line.ends_with(verdict), "{line}: {verdict}");
        }
        assert_eq!(lines.next(), None);
    }
}
