//! Metadata and log of the recording of a proof.

use std::collections::BTreeMap;

use super::json;
use crate::plain::Tell;
use crate::plain::judged::{self, Grade, grade};
use linkage::math::KeepNan;
use prover::bounds::Verdict;
use prover::run::{EngineProof, Proof};
use recording::{Level, LogEntry};

/// Versions, settings and verdict, by name.
pub(crate) fn metadata(proof: &Proof) -> BTreeMap<String, String> {
    let mut metadata = BTreeMap::from([
        ("linkproof".to_string(), env!("CARGO_PKG_VERSION").to_string()),
        ("reference".into(), proof.reference.into()),
        ("structure".into(), proof.formula.clone()),
        ("verdict".into(), proof.verdict.word().into()),
    ]);
    for EngineProof { info, own_forces, .. } in &proof.engines {
        let named = if proof.engines.len() == 1 { String::new() } else { format!("_{}", info.name) };
        let [engine, provides] = ["engine", "provides"].map(|word| format!("{word}{named}"));
        let resolution = if info.controls_error { "accuracy" } else { "step_s" };
        metadata.insert(engine.clone(), info.version.clone());
        metadata.insert(format!("{engine}_{resolution}"), format!("{:e}", info.settings.resolution));
        metadata.extend(info.told.iter().map(|(name, value)| (format!("{engine}_{name}"), value.clone())));
        let provided = info.provides.iter().map(|(stage, how)| (format!("{provides}_{stage}"), json::provision(how)));
        metadata.extend(provided);
        metadata.extend(own_forces.iter().flat_map(|own| {
            let (route, verdict) = (own.info.settings.route.name(), own.verdict.word());
            [("route", route), ("verdict", verdict)]
                .map(|(key, value)| (format!("{engine}_own_forces_{key}"), value.into()))
        }));
    }
    metadata
}

/// The verdict at the start, and every number that disagrees or is open, at its worst instant.
pub(crate) fn log(proof: &Proof, tell: Tell) -> Vec<LogEntry> {
    let start = proof.reference_trajectory.times().iter().copied().fold(f64::INFINITY, f64::smaller);
    let level = |verdict: &Verdict| grade(verdict).of([Level::Info, Level::Warning, Level::Error]);
    let mut log = vec![LogEntry {
        time: start,
        level: level(&proof.verdict),
        text: format!("{}: {}", proof.scenario, proof.verdict.word()),
    }];
    let mut all = judged::of(proof);
    all.retain(|own| grade(own.verdict) != Grade::Agree);
    all.sort_by_key(|own| own.sort);
    log.extend(all.into_iter().filter_map(|own| {
        let text = format!("{}: {}", own.name, own.verdict.reason(tell)?);
        Some(LogEntry { time: own.worst.unwrap_or(start), level: level(own.verdict), text })
    }));
    log
}
