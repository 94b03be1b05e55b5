//! Proofs as JSON, schema 2. Numbers that are not finite (an order that is hidden by rounding) are `null`.

use std::collections::BTreeMap;

use serde::Serialize;

use super::diagnosis_json;
use crate::plain::tell::Tell;
use linkage::error::{Advice, Error};
use linkage::solver::Provision;
use linkage::work::Work;
use prover::compare::{Check, Verdict};
use prover::proof::{ChannelProof, Dispute, End, EngineInfo, EngineProof, Entry, ForceFault, OwnForces, Proof, Search};

/// The whole document.
#[derive(Debug, Serialize)]
pub struct Document {
    schema: u32,
    runs: Vec<Run>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<Failure>,
    #[serde(skip)]
    tell: Tell,
}

#[derive(Debug, Serialize)]
struct Run {
    scenario: String,
    title: String,
    verdict: &'static str,
    reason: Option<String>,
    structure: String,
    reference: Reference,
    /// Checks on the analytic sides.
    checks: Vec<CheckRow>,
    engines: Vec<Engine>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    disputes: Vec<DisputeRow>,
    #[serde(skip_serializing_if = "Option::is_none")]
    diagnosis: Option<diagnosis_json::Row>,
    /// Whether the search for it ended at its limit of work.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    diagnosis_cut: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    recording: Option<String>,
    /// What nothing wanted depends on.
    left_out: Left,
    /// What was done, part by part.
    work: Vec<Part>,
}

#[derive(Debug, Serialize)]
struct Left {
    links: Vec<String>,
    joints: Vec<String>,
    drives: Vec<String>,
    loads: usize,
}

#[derive(Debug, Serialize)]
struct Part {
    part: String,
    why: &'static str,
    /// Exact counts by name; `null` for what was not needed.
    counts: Option<BTreeMap<&'static str, u64>>,
}

#[derive(Debug, Serialize)]
struct Reference {
    name: &'static str,
    samples: usize,
    from_s: f64,
    to_s: f64,
}

#[derive(Debug, Serialize)]
struct Engine {
    name: &'static str,
    version: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    dt_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    accuracy: Option<f64>,
    settings: serde_json::Map<String, serde_json::Value>,
    /// How the settings were found, if they were not all given.
    #[serde(skip_serializing_if = "Option::is_none")]
    search: Option<SearchRow>,
    provides: serde_json::Map<String, serde_json::Value>,
    verdict: &'static str,
    reason: Option<String>,
    channels: Vec<Channel>,
    /// Forces as the engine itself exerts them, judged besides those among the channels, which follow from its motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    own_forces: Option<OwnForcesRow>,
    checks: Vec<CheckRow>,
    #[serde(skip_serializing_if = "Option::is_none")]
    failure: Option<String>,
}

#[derive(Debug, Serialize)]
struct OwnForcesRow {
    route: &'static str,
    dt_s: f64,
    settings: serde_json::Map<String, serde_json::Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    search: Option<SearchRow>,
    verdict: &'static str,
    reason: Option<String>,
    /// Which of the two judgements is against the forces, if one is.
    fault: Option<&'static str>,
    channels: Vec<Channel>,
    #[serde(skip_serializing_if = "Option::is_none")]
    failure: Option<String>,
}

#[derive(Debug, Serialize)]
struct SearchRow {
    runs: usize,
    effort_steps: f64,
    budget_steps: f64,
    end: &'static str,
    extrapolated_times: usize,
}

#[derive(Debug, Serialize)]
struct DisputeRow {
    channel: String,
    pairs: Vec<[&'static str; 2]>,
    odd_one_out: Option<&'static str>,
}

#[derive(Debug, Serialize)]
struct Channel {
    channel: String,
    unit: &'static str,
    /// Where the engine's values come from.
    source: String,
    scale: f64,
    max: f64,
    rms: f64,
    q75: f64,
    q99: f64,
    bound: f64,
    discretisation: f64,
    iteration: f64,
    rounding: f64,
    /// Error of the reference itself.
    reference: f64,
    /// How the bound is known, in one word, and its justification.
    origin: &'static str,
    basis: String,
    verdict: &'static str,
    reason: Option<String>,
    observed_order: f64,
    limit: Option<f64>,
    worst_t_s: f64,
    worst_crank_rad: f64,
    /// Instants that are not judged, because a drive or a loaded link reverses there.
    left_out: usize,
}

#[derive(Debug, Serialize)]
struct CheckRow {
    name: String,
    value: f64,
    bound: f64,
    unit: &'static str,
    /// How the bound is known, in one word, and its justification.
    origin: &'static str,
    basis: String,
    verdict: &'static str,
    reason: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    finding: Option<String>,
    /// Residual of the printed number that the finding calls wrong; `value` is the residual of the correct one.
    #[serde(skip_serializing_if = "Option::is_none")]
    printed_off: Option<f64>,
}

/// A scenario that could not be read or proven.
#[derive(Debug, Serialize)]
pub(super) struct Failure {
    scenario: String,
    message: String,
    line: Option<usize>,
    key: Option<String>,
    help: Option<String>,
}

impl Failure {
    /// One for each of the errors of a file, and one that counts those that are not told.
    pub(super) fn each(scenario: &str, error: &Error, tell: Tell) -> Vec<Failure> {
        let told = |error: &Error| Failure {
            scenario: scenario.into(),
            message: error.message().into(),
            line: error.place().map(linkage::error::Place::line),
            key: error.scenario_key().map(Into::into),
            help: error.way_out_by(tell),
        };
        let rest = |message| Failure { scenario: scenario.into(), message, line: None, key: None, help: None };
        error.each().map(told).chain(error.rest().map(rest)).collect()
    }
}

impl Document {
    /// An empty document whose advice names no options.
    #[must_use]
    pub fn new() -> Self {
        Document::told_by(Advice::to_string)
    }

    /// An empty document whose advice is worded by `tell`.
    #[must_use]
    pub fn told_by(tell: Tell) -> Self {
        Document { schema: 2, runs: Vec::new(), errors: Vec::new(), tell }
    }

    /// Adds a proof and the path of its recording, if one was written.
    pub fn add(&mut self, proof: &Proof, recording: Option<String>) {
        self.runs.push(run(proof, recording, self.tell));
    }

    /// Adds a scenario that could not be proven: an entry for each of its errors.
    pub fn add_failure(&mut self, scenario: &str, error: &Error) {
        self.errors.extend(Failure::each(scenario, error, self.tell));
    }

    /// The document as text, with a newline at its end.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("plain structures are always JSON");
        text.push('\n');
        text
    }
}

impl Default for Document {
    fn default() -> Self {
        Self::new()
    }
}

fn run(proof: &Proof, recording: Option<String>, tell: Tell) -> Run {
    let times = proof.reference_trajectory.times();
    let left = &proof.scene.left_out;
    Run {
        scenario: proof.scenario.clone(),
        title: proof.title.clone(),
        verdict: proof.verdict.word(),
        reason: proof.verdict.reason(tell),
        structure: proof.formula.clone(),
        reference: Reference {
            name: proof.reference,
            samples: times.len(),
            from_s: times.first().copied().unwrap_or(0.0),
            to_s: times.last().copied().unwrap_or(0.0),
        },
        checks: proof.checks.iter().map(|own| check(own, tell)).collect(),
        engines: proof.engines.iter().map(|own| engine(own, tell)).collect(),
        disputes: proof.disputes.iter().map(dispute).collect(),
        diagnosis: proof
            .diagnosis
            .as_ref()
            .filter(|_| matches!(proof.verdict, Verdict::Disagree { .. }))
            .map(diagnosis_json::row),
        diagnosis_cut: proof.diagnosis_is_cut,
        recording,
        left_out: Left {
            links: left.links.clone(),
            joints: left.joints.clone(),
            drives: left.drives.clone(),
            loads: left.loads,
        },
        work: proof.work.iter().map(part).collect(),
    }
}

fn part(entry: &Entry) -> Part {
    let counts = |work: &Work| work.iter().map(|(what, times)| (what.name(), times)).collect();
    Part { part: entry.part.clone(), why: entry.why, counts: entry.work.as_ref().map(counts) }
}

fn engine(proof: &EngineProof, tell: Tell) -> Engine {
    let info = &proof.info;
    let resolution = Some(info.settings.resolution);
    Engine {
        name: info.name,
        version: info.version.clone(),
        dt_s: resolution.filter(|_| !info.controls_error),
        accuracy: resolution.filter(|_| info.controls_error),
        settings: told(info),
        search: proof.search.as_ref().map(|own| search(own, info.settings.extrapolated)),
        provides: info.provides.iter().map(|(k, v)| ((*k).into(), provision(v).into())).collect(),
        verdict: proof.verdict.word(),
        reason: proof.verdict.reason(tell),
        channels: proof.channels.iter().map(|own| channel(info, own, tell)).collect(),
        own_forces: proof.own_forces.as_ref().map(|own| own_forces(proof, own, tell)),
        checks: proof.checks.iter().map(|own| check(own, tell)).collect(),
        failure: proof.failure.as_ref().map(|error| error.message().to_string()),
    }
}

fn told(info: &EngineInfo) -> serde_json::Map<String, serde_json::Value> {
    info.told.iter().map(|(k, v)| ((*k).into(), v.clone().into())).collect()
}

fn own_forces(engine: &EngineProof, own: &OwnForces, tell: Tell) -> OwnForcesRow {
    let OwnForces { info, search: found, channels, verdict, failure, .. } = own;
    let fault = engine.force_fault().map(|fault| match fault {
        ForceFault::Reading => "reading",
        ForceFault::Exerted => "exerted",
        ForceFault::Both => "both",
    });
    OwnForcesRow {
        route: info.settings.route.name(),
        dt_s: info.settings.resolution,
        settings: told(info),
        search: found.as_ref().map(|own| search(own, info.settings.extrapolated)),
        verdict: verdict.word(),
        reason: verdict.reason(tell),
        fault,
        channels: channels.iter().map(|own| channel(info, own, tell)).collect(),
        failure: failure.as_ref().map(|error| error.message().to_string()),
    }
}

fn search(search: &Search, extrapolated_times: usize) -> SearchRow {
    let end = match search.end {
        End::Decided => "decided",
        End::Rounding => "rounding",
        End::Budget => "budget",
        End::Pace => "pace",
        End::Nothing => "nothing left to choose",
    };
    let &Search { runs, effort: effort_steps, budget: budget_steps, .. } = search;
    SearchRow { runs, effort_steps, budget_steps, end, extrapolated_times }
}

fn dispute(dispute: &Dispute) -> DisputeRow {
    DisputeRow { channel: dispute.channel.clone(), pairs: dispute.pairs.clone(), odd_one_out: dispute.odd }
}

fn channel(info: &EngineInfo, proof: &ChannelProof, tell: Tell) -> Channel {
    let residual = &proof.residual;
    let stage = residual.channel.kind.stage.name();
    let source = info.provides.iter().find(|(own, _)| *own == stage).map(|(_, how)| provision(how));
    Channel {
        channel: residual.channel.to_string(),
        unit: residual.channel.kind.unit.symbol(),
        source: source.unwrap_or_default(),
        scale: residual.scale,
        max: residual.max,
        rms: residual.rms,
        q75: residual.q75,
        q99: residual.q99,
        bound: proof.bound,
        discretisation: proof.parts.discretisation,
        iteration: proof.parts.iteration,
        rounding: proof.parts.rounding,
        reference: proof.parts.reference,
        origin: proof.basis.origin().word(),
        basis: proof.basis.to_string(),
        verdict: proof.verdict.word(),
        reason: proof.verdict.reason(tell),
        observed_order: proof.convergence.observed,
        limit: proof.limit,
        worst_t_s: residual.worst_time,
        worst_crank_rad: residual.worst_crank,
        left_out: proof.left_out,
    }
}

fn check(check: &Check, tell: Tell) -> CheckRow {
    let (finding, printed_off) = match &check.verdict {
        Verdict::Expected { finding, off } => (Some(finding.clone()), Some(*off)),
        Verdict::Agree { .. } | Verdict::Disagree { .. } | Verdict::Inconclusive { .. } => (None, None),
    };
    CheckRow {
        name: check.name(),
        value: check.value,
        bound: check.bound,
        unit: check.unit,
        origin: check.basis.origin().word(),
        basis: check.basis.to_string(),
        verdict: check.verdict.word(),
        reason: check.verdict.reason(tell),
        finding,
        printed_off,
    }
}

/// How a channel is provided, in words.
#[must_use]
pub fn provision(provision: &Provision) -> String {
    match provision {
        Provision::Computed => "read".into(),
        Provision::Derived(how) => format!("derived: {how}"),
    }
}
