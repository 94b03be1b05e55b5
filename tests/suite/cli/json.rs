//! Compares every number of `run --json` with the number in the proof.
//! The test fails if a number differs, or if the JSON has a numerical field that this file does not list.

use std::collections::BTreeMap;
use std::path::Path;

use linkage::solver::Provision;
use linkproof::parts::{ChannelProof, Check, EngineInfo, EngineName, EngineProof};
use linkproof::report::json::Document;
use linkproof::{Options, Proof, Scenario, Verdict, prove};
use prover::run::{SearchEnd, prove_against};
use serde_json::Value;

use super::tools::Place;

/// Numbers by field name; NaN and infinity are `null`.
type Numbers<'a> = BTreeMap<&'a str, f64>;

/// Compares all numbers of an object with `wanted`.
/// Nested objects and lists are compared by separate calls.
fn is_said(what: &str, object: &Value, wanted: &Numbers) {
    let object = object.as_object().unwrap_or_else(|| panic!("{what} is no object"));
    let found: Numbers = object.iter().filter_map(|(key, value)| Some((key.as_str(), value.as_f64()?))).collect();
    let finite: Numbers =
        wanted.iter().filter(|(_, value)| value.is_finite()).map(|(key, value)| (*key, *value)).collect();
    assert_eq!(found, finite, "{what}");
    for (key, _) in wanted.iter().filter(|(_, value)| !value.is_finite()) {
        assert!(object[*key].is_null(), "{what}: {key}");
    }
}

fn of_channel(own: &ChannelProof) -> Numbers<'static> {
    let (residual, parts) = (&own.residual, &own.parts);
    BTreeMap::from([
        ("scale", residual.scale),
        ("max", residual.max),
        ("rms", residual.rms),
        ("q75", residual.q75),
        ("q99", residual.q99),
        ("bound", own.bound),
        ("discretisation", parts.discretisation),
        ("iteration", parts.iteration),
        ("rounding", parts.rounding),
        ("reference", parts.reference),
        ("observed_order", own.convergence.observed),
        ("limit", own.limit.unwrap_or(f64::NAN)),
        ("worst_t_s", residual.worst_time),
        ("worst_crank_rad", residual.worst_crank),
        ("left_out", own.left_out as f64),
    ])
}

fn of_check(own: &Check) -> Numbers<'static> {
    let mut numbers = BTreeMap::from([("value", own.value), ("bound", own.bound)]);
    if let Verdict::Expected { off, .. } = own.verdict {
        numbers.insert("printed_off", off);
    }
    numbers
}

/// How an engine obtains the values of this channel's stage: it reads them or derives them.
fn source(info: &EngineInfo, own: &ChannelProof) -> String {
    match info.provides.iter().find(|(stage, _)| *stage == own.residual.channel.kind.stage.name()).unwrap().1 {
        Provision::Computed => "read".into(),
        Provision::Derived(how) => format!("derived: {how}"),
    }
}

fn channels(what: &str, rows: &Value, info: &EngineInfo, own: &[ChannelProof]) {
    let rows = rows.as_array().unwrap();
    assert_eq!(rows.len(), own.len(), "{what}");
    for (row, own) in rows.iter().zip(own) {
        let name = own.residual.channel.to_string();
        assert_eq!((row["channel"].as_str(), row["verdict"].as_str()), (Some(name.as_str()), Some(own.verdict.word())));
        assert_eq!(row["unit"].as_str(), Some(own.residual.channel.kind.unit.symbol()));
        assert_eq!(row["source"].as_str(), Some(source(info, own).as_str()), "{what}: {name}");
        is_said(&format!("{what}: {name}"), row, &of_channel(own));
    }
}

fn checks(what: &str, rows: &Value, own: &[Check]) {
    let rows = rows.as_array().unwrap();
    assert_eq!(rows.len(), own.len(), "{what}");
    for (row, own) in rows.iter().zip(own) {
        let name = own.name();
        let words = (Some(name.as_str()), Some(own.verdict.word()), Some(own.unit));
        assert_eq!((row["name"].as_str(), row["verdict"].as_str(), row["unit"].as_str()), words);
        is_said(&format!("{what}: {name}"), row, &of_check(own));
    }
}

fn engine(what: &str, row: &Value, own: &EngineProof) {
    // Engines that control their error have an accuracy instead of a step, so their field has a different name.
    let size = if own.info.controls_error { "accuracy" } else { "dt_s" };
    is_said(what, row, &BTreeMap::from([(size, own.info.settings.resolution)]));
    assert_eq!((row["name"].as_str(), row["verdict"].as_str()), (Some(own.info.name), Some(own.verdict.word())));
    channels(what, &row["channels"], &own.info, &own.channels);
    checks(what, &row["checks"], &own.checks);
    match &own.search {
        Some(searched) => {
            let search = BTreeMap::from([
                ("runs", searched.runs as f64),
                ("effort_steps", searched.effort),
                ("budget_steps", searched.budget),
                ("extrapolated_times", own.info.settings.extrapolated as f64),
            ]);
            is_said(what, &row["search"], &search);
            let end = match searched.end {
                SearchEnd::Decided => "decided",
                SearchEnd::Rounding => "rounding",
                SearchEnd::Budget => "budget",
                SearchEnd::Pace => "pace",
                SearchEnd::Nothing => "nothing left to choose",
            };
            assert_eq!(row["search"]["end"].as_str(), Some(end), "{what}");
        }
        None => assert!(row["search"].is_null(), "{what}"),
    }
    if let Some(forces) = &own.own_forces {
        is_said(what, &row["own_forces"], &BTreeMap::from([("dt_s", forces.info.settings.resolution)]));
        channels(&format!("{what}, own forces"), &row["own_forces"]["channels"], &forces.info, &forces.channels);
    }
}

fn proven(what: &str, run: &Value, proof: &Proof) {
    is_said(what, run, &BTreeMap::new());
    assert_eq!(run["verdict"].as_str(), Some(proof.verdict.word()));
    let times = proof.reference_trajectory.times();
    let [first, last] = [times[0], times[times.len() - 1]];
    assert!(first < last);
    let reference = BTreeMap::from([("samples", times.len() as f64), ("from_s", first), ("to_s", last)]);
    is_said(what, &run["reference"], &reference);
    checks(what, &run["checks"], &proof.checks);
    let engines = run["engines"].as_array().unwrap();
    assert_eq!(engines.len(), proof.engines.len());
    for (row, own) in engines.iter().zip(&proof.engines) {
        engine(what, row, own);
    }
    let disputes = run["disputes"].as_array().map_or(&[][..], Vec::as_slice);
    assert_eq!(disputes.len(), proof.disputes.len());
    for (row, own) in disputes.iter().zip(&proof.disputes) {
        assert_eq!((row["channel"].as_str(), row["odd_one_out"].as_str()), (Some(own.channel.as_str()), own.odd));
        assert_eq!(row["pairs"], serde_json::json!(own.pairs));
    }
    is_said(what, &run["left_out"], &BTreeMap::from([("loads", proof.scene.left_out.loads as f64)]));
    for (row, own) in run["work"].as_array().unwrap().iter().zip(&proof.work) {
        let counts: Numbers =
            own.work.iter().flat_map(|own| own.iter()).map(|(what, times)| (what.name(), times as f64)).collect();
        match own.work {
            Some(_) => is_said(&own.part, &row["counts"], &counts),
            None => assert!(row["counts"].is_null()),
        }
    }
}

/// The first case has a prescribed motion and a finding.
/// The second case moves under forces, so its crank angles are not proportional to its times.
#[test]
fn every_number_of_the_json_is_that_of_the_proof() {
    let place = Place::new();
    for name in ["crank_rocker", "compressor_runup"] {
        let path = format!("scenarios/{name}.toml");
        let json = place.run(&format!("run {path} --no-record --json -")).json();
        let scenario = Scenario::load(Path::new(env!("CARGO_MANIFEST_DIR")).join(&path)).unwrap();
        let proof = prove(&scenario, &Options::default()).unwrap();
        proven(name, &json["runs"][0], &proof);
    }
}

/// Features that the cases of the previous test lack: a grid that begins late, a different engine, and engines that
/// agree with each other but not with the reference.
/// The test also covers exhausted work and omitted loads.
#[test]
fn rare_parts_of_a_proof_are_exact_in_the_json() {
    let load = |name: &str, edit: [&str; 2]| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains(edit[0]), "{} in {name}", edit[0]);
        Scenario::parse(&text.replace(edit[0], edit[1]), &path).unwrap()
    };
    let same = ["format = 1", "format = 1"];
    let late = load("crank_rocker.toml", ["from_deg = 0\nto_deg = 360", "from_deg = 30\nto_deg = 60"]);
    let coarse = Options::default().step(2e-3);
    let two = coarse.clone().engine(EngineName::Rapier).engine(EngineName::Impulse);
    let wrong = load("crank_rocker.toml", ["mass_kg = 34.7", "mass_kg = 34.8"]);
    let some = load("loaded_slider.toml", same).only(&["link.crank".to_string()]).unwrap();
    let mut proofs = vec![
        ("late", prove(&late, &coarse).unwrap()),
        ("disputed", prove_against(&load("crank_rocker.toml", same), &wrong.case, &two).unwrap()),
        ("some channels", prove(&some, &coarse).unwrap()),
    ];
    for work in [1e2, 1e3, 1e4] {
        proofs.push(("little work", prove(&late, &Options::default().budget(work)).unwrap()));
    }
    if cfg!(feature = "simbody") {
        let simbody = Options::default().engine(EngineName::Simbody);
        proofs.push(("simbody", prove(&load("crank_rocker.toml", same), &simbody).unwrap()));
    }
    for (what, proof) in &proofs {
        let mut document = Document::new();
        document.add(proof, None);
        proven(what, &serde_json::from_str::<Value>(&document.text()).unwrap()["runs"][0], proof);
    }
    let of = |name: &str| &proofs.iter().find(|(own, _)| *own == name).unwrap().1;
    assert!(of("late").reference_trajectory.times()[0] > 0.0);
    assert!(of("disputed").disputes.iter().any(|own| own.odd.is_some()));
    let ends = proofs.iter().filter_map(|(_, proof)| proof.engine().search.as_ref()).map(|search| search.end);
    let ends: Vec<SearchEnd> = ends.collect();
    assert!(ends.contains(&SearchEnd::Budget) && ends.contains(&SearchEnd::Decided), "{ends:?}");
    assert!(of("some channels").scene.left_out.loads > 0);
}
