//! Thousands of bad scenarios: no panic, no hang, and every error states its location.
//! Every error also states the key at fault, unless the whole file is at fault.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use linkage::case::Grid;
use linkproof::parts::ChannelProof;
use linkproof::{Options, Proof, Verdict, prove};
use scenario::Scenario;

use crate::common::damage::{Damaged, damaged};
use crate::common::draws;
use crate::common::entries;
use crate::common::many::{each, number};

/// Limits of a proof, in instants and in revolutions: large enough to run every part of the proof.
const INSTANTS: usize = 5;
const TURNS: f64 = 1.5;
/// Work limit of the search for settings, in steps.
const BUDGET: f64 = 2e4;
/// Outcome of a scenario, in a few words.
fn ending(index: u64, bad: &Damaged) -> String {
    let scenario = match Scenario::parse(&bad.text, &bad.path) {
        Ok(scenario) => scenario,
        Err(error) => {
            entries::explains(&error, &bad.text);
            return format!("refused: {:?}", error.kind());
        }
    };
    // A scenario that loads is solved at only a few instants of its grid near the start.
    // Nothing else in the scenario is changed.
    let Some(scenario) = shortened(scenario) else { return "loads, with no instant near its start".into() };
    match prove(&scenario, &Options::default().budget(BUDGET)) {
        Ok(proof) => {
            if proof.verdict.word() == "disagree" {
                println!("number {index} disagrees in {}; {:?}", disagreeing(&proof).join(", "), bad.what);
            }
            format!("proven: {}", proof.verdict.word())
        }
        Err(error) => {
            assert!(!error.message().trim().is_empty());
            format!("not solved: {:?}", error.kind())
        }
    }
}

/// The disagreeing values, each with its bound.
fn disagreeing(proof: &Proof) -> Vec<String> {
    let checks = proof.all_checks().filter(|check| matches!(check.verdict, Verdict::Disagree { .. }));
    let channels = proof.engines.iter().flat_map(|engine| &engine.channels);
    let channels = channels.filter(|channel| matches!(channel.verdict, Verdict::Disagree { .. }));
    let checks = checks.map(|one| format!("{} {}: {:e} of {:e}", one.family, one.detail, one.value, one.bound));
    let channel = |one: &ChannelProof| format!("{}: {:e} of {:e}", one.residual.channel, one.residual.max, one.bound);
    checks.chain(channels.map(channel)).collect()
}

fn shortened(mut scenario: Scenario) -> Option<Scenario> {
    let case = &scenario.case;
    let near = |row: &usize| {
        let turned = (case.grid.inputs[*row] - case.crank().at(0.0).value).abs();
        turned <= TURNS * std::f64::consts::TAU || case.is_free()
    };
    let rows: Vec<usize> = (0..case.grid.len()).filter(near).collect();
    let rows: Vec<usize> = rows.iter().copied().step_by((rows.len() / INSTANTS).max(1)).take(INSTANTS).collect();
    if rows.is_empty() {
        return None;
    }
    let pick = |values: &[f64]| rows.iter().map(|&row| values[row]).collect();
    scenario.case = case.on(Grid { times: pick(&case.grid.times), inputs: pick(&case.grid.inputs) }).ok()?;
    Some(scenario)
}

/// A part of the bad scenarios, for a quick test.
/// `LINKPROOF_BAD_FROM` and `LINKPROOF_BAD_SCENARIOS` select scenarios by number.
/// `LINKPROOF_BAD_TO` names a directory to which the selected scenarios are written.
#[test]
fn bad_scenarios_end_with_a_message_and_a_position() {
    let count = number("LINKPROOF_BAD_SCENARIOS").unwrap_or(draws(100) as u64);
    let found = each(number("LINKPROOF_BAD_FROM").unwrap_or(0), count, |index| {
        let bad = damaged(1, index);
        if let Some(directory) = std::env::var_os("LINKPROOF_BAD_TO") {
            let text = format!("# {}\n{}", bad.what.join("; ").escape_debug(), bad.text);
            std::fs::write(std::path::Path::new(&directory).join(format!("{index}.toml")), text).unwrap();
        }
        let since = Instant::now();
        let ended = catch_unwind(AssertUnwindSafe(|| ending(index, &bad))).map_err(|panic| {
            let why = panic.downcast_ref::<String>().cloned();
            let why = why.or_else(|| panic.downcast_ref::<&str>().map(ToString::to_string));
            format!("{index}: {:?}: {}", bad.what, why.unwrap_or_default())
        });
        (since.elapsed(), ended)
    });
    let mut endings = BTreeMap::<&str, usize>::new();
    for (_, (_, ended)) in &found {
        *endings.entry(ended.as_ref().map_or("panicked", String::as_str)).or_insert(0) += 1;
    }
    println!("{count} bad scenarios:");
    endings.iter().for_each(|(ending, times)| println!("{times:6} {ending}"));
    let mut times: Vec<(Duration, u64)> = found.iter().map(|(index, (time, _))| (*time, *index)).collect();
    times.sort();
    let whole: Duration = times.iter().map(|(time, _)| *time).sum();
    println!("mean {:?}, slowest {:?}", whole / count as u32, times.iter().rev().take(5).collect::<Vec<_>>());
    let panics: Vec<&String> = found.iter().filter_map(|(_, (_, ended))| ended.as_ref().err()).collect();
    assert!(panics.is_empty(), "{} panics: {panics:#?}", panics.len());
}
