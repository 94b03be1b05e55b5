//! The parts of every bound of a few scenarios, as a reviewed table.
//! Other tests plant an error that is a multiple of the bound, so they also pass if the bound is far too wide.
//! This test fails if a bound is a thousand times too wide.
//!
//! Numbers have two digits.
//! A number may differ from the table by a factor of up to 1.5, which allows for the noise between machines.
//! The engine settings are fixed, so changes in the search for settings do not affect the table.
//! `UPDATE_EXPECTED=1 cargo test --release --test suite bounds` writes the table anew; a changed table needs a reason.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use linkage::math::KeepNan;
use linkproof::{Options, Proof, Scenario, prove};
use prover::run::solved::judge;

use crate::common::expected::agrees_by;

/// Largest ratio of two numbers that differ only by noise.
const NOISE: f64 = 1.5;

/// The parts of an engine's bounds, in the order of the table.
const ENGINE: &str = "discretisation, iteration, rounding, reference";

/// A sample: name in the table, file, edits, time step (s; zero if no engine runs and only claims are judged), sweeps.
type Sample = (&'static str, &'static str, &'static [(&'static str, &'static str)], f64, usize);

const SAMPLES: [Sample; 9] = [
    ("four-bar", "scenarios/crank_rocker.toml", &[], 2e-3, 16),
    // This sample is a millionth of a degree from a dead point.
    // The condition number therefore affects every number with which a claim is compared.
    (
        "dead point",
        "scenarios/crank_rocker.toml",
        &[
            ("C = { x_mm = 150, y_mm = 15 }", "C = { x_mm = 400, y_mm = 0 }"),
            ("A = { x_m = 0.025995627740337, y_m = 0 }", "A = { x_mm = 300, y_mm = 0 }"),
            ("B = { x_m = 0.34707193189181, y_m = 0 }", "B = { x_mm = 250, y_mm = 0 }"),
            ("B = { x_mm = 250, y_mm = 0 }\nD", "B = { x_mm = 200, y_mm = 0 }\nD"),
            ("crank_deg = 0\n", "crank_deg = 30\n"),
            (
                "from_deg = 0\nto_deg = 360\nstep_deg = 1\n",
                "angles_deg = [30, 60, 78.5, 78.5848413]\n[[formula]]\nname = \"a\"\nexpression = \"1\"\nchannel = \"link.rocker.angle_rad\"\n[[formula]]\nname = \"b\"\nexpression = \"1\"\nchannel = \"link.rocker.omega_rad_s\"\n[[formula]]\nname = \"c\"\nexpression = \"1\"\nchannel = \"link.rocker.alpha_rad_s2\"\n[[formula]]\nname = \"d\"\nexpression = \"1\"\nchannel = \"joint.C.fx_N\"\n",
            ),
        ],
        0.0,
        0,
    ),
    ("class III", "scenarios/class3_group.toml", &[], 1e-3, 32),
    ("run-up", "scenarios/crank_rocker_runup.toml", &[], 1e-3, 16),
    ("beginning", "tests/outside/scenarios/massless_coupler_runup.toml", &[], 1e-3, 16),
    ("reversals", "tests/outside/scenarios/loads_of_all_sorts.toml", &[], 2e-3, 16),
    ("change point", "tests/outside/scenarios/parallel_cranks_passing.toml", &[], 2e-4, 64),
    ("table", "scenarios/ov7_new_tabulated.toml", &[], 5e-4, 32),
    ("formula", "scenarios/formulas/slider_crank_centric.toml", &[], 1e-3, 16),
];

fn scenario((name, file, edits, _, _): &Sample) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let mut text = std::fs::read_to_string(&path).unwrap();
    if !edits.is_empty() {
        text.truncate(text.find("[[oracle]]").unwrap_or(text.len()));
    }
    for (old, new) in *edits {
        assert!(text.contains(old), "{name}: {old}");
        text = text.replace(old, new);
    }
    Scenario::parse(&text, &path).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn proven(sample: &Sample) -> Proof {
    let options = Options::default().step(sample.3).sweeps(sample.4).extrapolated(0);
    prove(&scenario(sample), &options).unwrap_or_else(|error| panic!("{}: {error}", sample.0))
}

/// Bounds of claims that are judged without an engine.
/// For each claim: the bound at the instant with the largest ratio of residual to bound.
fn claimed(sample: &Sample, all: &mut Numbers) {
    let found = judge(&scenario(sample)).unwrap_or_else(|error| panic!("{}: {error}", sample.0));
    for (side, judged) in found.judgement.sides.iter() {
        for own in judged.iter().flatten() {
            let what = format!("claim ({side}), {}, derivative {}", own.claim, own.order);
            all.insert((sample.0.into(), what), vec![own.worst.map_or(0.0, |worst| worst.bound)]);
        }
    }
}

/// Numbers of the table.
type Numbers = BTreeMap<(String, String), Vec<f64>>;

/// The parts of all bounds of a proof, grouped by subject.
/// Engine, for each quantity: the widest parts, as fractions of the channel's scale, and the largest number of omitted
/// instants.
/// Reference, for each quantity: the widest bound.
/// Checks, for each family or formula: the narrowest and the widest bound of both analytic sides.
fn parts(sample: &Sample, proof: &Proof, all: &mut Numbers) {
    let mut widen = |what: String, values: &[f64]| {
        let own = all.entry((sample.0.into(), what)).or_insert_with(|| vec![0.0; values.len()]);
        own.iter_mut().zip(values).for_each(|(own, value)| *own = own.larger(*value));
    };
    let engine = proof.engine();
    for own in engine.channels.iter().filter(|own| own.residual.scale > 0.0) {
        let (quantity, scale) = (own.residual.channel.kind.quantity, own.residual.scale);
        let parts = &own.parts;
        // An iteration part that is below the engine's rounding is noise of the machine, so the table lists the part as
        // zero.
        let iteration = if parts.iteration <= parts.rounding { 0.0 } else { parts.iteration };
        let of_error = [parts.discretisation, iteration, parts.rounding, parts.reference];
        widen(format!("engine, {quantity}: {ENGINE}"), &of_error.map(|part| part / scale));
        widen(format!("engine, {quantity}: instants left out"), &[own.left_out as f64]);
    }
    for (channel, bound) in proof.reference_trajectory.channels().iter().zip(&proof.reference_bounds) {
        widen(format!("reference, {}", channel.kind.quantity), &[*bound]);
    }
    let mut ends: BTreeMap<String, [f64; 2]> = BTreeMap::new();
    for check in proof.all_checks() {
        let is_formula = check.family.starts_with("formulas");
        let family = if is_formula { check.name() } else { check.family.clone() };
        let own = ends.entry(family.replace(" (assur)", "").replace(" (newton)", "")).or_insert([f64::INFINITY, 0.0]);
        *own = [own[0].smaller(check.bound), own[1].larger(check.bound)];
    }
    ends.into_iter().for_each(|(family, ends)| widen(format!("check, {family}"), &ends));
}

/// The table as text: one line per entry.
fn table(all: &Numbers) -> String {
    all.iter().fold(String::new(), |mut text, ((sample, what), values)| {
        let values: Vec<String> = values.iter().map(|value| format!("{value:.1e}")).collect();
        let _ = writeln!(text, "{sample} | {what} | {}", values.join(" "));
        text
    })
}

/// Whether two numbers differ only by noise and by the rounding to the written digits.
fn is_same(one: f64, other: f64) -> bool {
    one == other || (one > 0.0 && other > 0.0 && one / other <= NOISE && other / one <= NOISE)
}

/// Whether two lines of the table have the same subject and the same numbers.
fn are_alike(one: &str, other: &str) -> bool {
    let [one, other] = [one, other].map(|line| {
        let (subject, values) = line.rsplit_once(" | ").unwrap_or_else(|| panic!("{line}"));
        (subject, values.split(' ').map(|value| value.parse().unwrap()).collect::<Vec<f64>>())
    });
    let mut pairs = one.1.iter().zip(&other.1);
    one.0 == other.0 && one.1.len() == other.1.len() && pairs.all(|(one, other)| is_same(*one, *other))
}

#[test]
fn the_parts_of_all_bounds_match_the_reviewed_values() {
    let mut found = Numbers::new();
    for sample in &SAMPLES {
        match sample.3 == 0.0 {
            true => claimed(sample, &mut found),
            false => parts(sample, &proven(sample), &mut found),
        }
    }
    agrees_by("tests/suite/bounds/parts.txt", &table(&found), "bounds", are_alike);
}

/// Tests the comparison itself: a factor of a thousand, a factor of 1.6, a part that has vanished, and NaN.
#[test]
fn a_part_of_another_size_is_detected() {
    assert!(is_same(1.0e-9, 1.1e-9) && is_same(0.0, 0.0));
    for (one, other) in [(1e-9, 1e-6), (1e-9, 1.6e-9), (1e-9, 0.0), (0.0, 1e-9), (1e-9, f64::NAN)] {
        assert!(!is_same(one, other) && !is_same(other, one), "{one:e} {other:e}");
    }
}
