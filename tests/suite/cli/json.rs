//! Every number of `run --json` against the proof's own: a field without a number here, or with another one, fails.

use std::collections::BTreeMap;
use std::path::Path;

use linkproof::parts::{ChannelProof, Check, EngineProof};
use linkproof::{Options, Scenario, Verdict, prove};
use serde_json::Value;

use super::tools::Place;

/// Numbers by the names of fields; NaN and infinity are `null`.
type Numbers<'a> = BTreeMap<&'a str, f64>;

/// Compares all numbers of an object with `wanted`. Objects and lists in it are looked at elsewhere.
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

fn channels(what: &str, rows: &Value, own: &[ChannelProof]) {
    let rows = rows.as_array().unwrap();
    assert_eq!(rows.len(), own.len(), "{what}");
    for (row, own) in rows.iter().zip(own) {
        let name = own.residual.channel.to_string();
        assert_eq!((row["channel"].as_str(), row["verdict"].as_str()), (Some(name.as_str()), Some(own.verdict.word())));
        assert_eq!(row["unit"].as_str(), Some(own.residual.channel.kind.unit.symbol()));
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
    is_said(what, row, &BTreeMap::from([("dt_s", own.info.settings.resolution)]));
    channels(what, &row["channels"], &own.channels);
    checks(what, &row["checks"], &own.checks);
    let searched = own.search.as_ref().unwrap();
    let extrapolated = own.info.settings.extrapolated as f64;
    let search = BTreeMap::from([
        ("runs", searched.runs as f64),
        ("effort_steps", searched.effort),
        ("budget_steps", searched.budget),
        ("extrapolated_times", extrapolated),
    ]);
    is_said(what, &row["search"], &search);
    if let Some(forces) = &own.own_forces {
        is_said(what, &row["own_forces"], &BTreeMap::from([("dt_s", forces.info.settings.resolution)]));
        channels(&format!("{what}, own forces"), &row["own_forces"]["channels"], &forces.channels);
    }
}

/// One that is prescribed, with a finding, and one under forces, whose times are not its crank angles.
#[test]
fn every_number_of_the_json_is_the_proof_s_own() {
    let place = Place::new();
    for name in ["crank_rocker", "compressor_runup"] {
        let path = format!("scenarios/{name}.toml");
        let json = place.run(&format!("run {path} --no-record --json -")).json();
        let scenario = Scenario::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join(&path)).unwrap();
        let proof = prove(&scenario, &Options::default()).unwrap();
        let run = &json["runs"][0];
        is_said(name, run, &BTreeMap::new());
        assert_eq!(run["verdict"].as_str(), Some(proof.verdict.word()));
        let times = proof.reference_trajectory.times();
        let [first, last] = [times[0], times[times.len() - 1]];
        assert!(first < last);
        let reference = BTreeMap::from([("samples", times.len() as f64), ("from_s", first), ("to_s", last)]);
        is_said(name, &run["reference"], &reference);
        checks(name, &run["checks"], &proof.checks);
        assert_eq!(run["engines"].as_array().unwrap().len(), proof.engines.len());
        engine(name, &run["engines"][0], proof.engine());
        is_said(name, &run["left_out"], &BTreeMap::from([("loads", proof.scene.left_out.loads as f64)]));
        for (row, own) in run["work"].as_array().unwrap().iter().zip(&proof.work) {
            let counts: Numbers =
                own.work.iter().flat_map(|own| own.iter()).map(|(what, times)| (what.name(), times as f64)).collect();
            match own.work {
                Some(_) => is_said(&own.part, &row["counts"], &counts),
                None => assert!(row["counts"].is_null()),
            }
        }
    }
}
