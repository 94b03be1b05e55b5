//! Proofs as JSON, schema 2. Numbers that are not finite are `null`, for example an observed order of convergence that
//! cannot be determined because of rounding.

use crate::sentences;
use std::collections::BTreeMap;

use serde::Serialize;

use super::pretty::rows;
use crate::plain::Tell;
use crate::plain::diagnosis::{cause, nature, standing};
use crate::plain::judged::{Grade, grade};
use crate::plain::machine;
use linkage::case::LeftOut;
use linkage::error::{Advice, Error};
use linkage::input::InputValue;
use linkage::solver::Provision;
use linkage::work::Work;
use prover::bounds::{Check, Verdict};
use prover::diagnosis::{Diagnosis, PartyStanding, Since};
use prover::run::{
    ChannelProof, Dispute, EngineInfo, EngineProof, ForceFault, LedgerEntry, Proof, ReportedFigure, SearchEnd,
    SettingsSearch,
};

/// Words by name.
type Words = BTreeMap<&'static str, String>;
/// A value of the input, by its key.
type Keyed = BTreeMap<String, f64>;

/// The value of the input under its key, such as `crank_rad` or `slide_m`. The key has the prefix `before`.
fn keyed(before: &str, at: InputValue) -> Keyed {
    [(format!("{before}{}", at.input.key()), at.value)].into()
}

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

rows! {
    /// A proof.
    struct Run = |proof: &Proof, recording: Option<String>, tell: Tell| {
        let times = proof.reference_trajectory.times();
        let left = &proof.scene.left_out;
        let found = proof.diagnosis.as_ref().filter(|_| grade(&proof.verdict) == Grade::Disagree);
    } {
        scenario: String = proof.scenario.clone(),
        title: String = proof.title.clone(),
        verdict: &'static str = proof.verdict.word(),
        reason: Option<String> = proof.verdict.reason(tell),
        structure: String = proof.formula.clone(),
        reference: Reference = Reference::of(proof.reference, times),
        /// The mechanism in words, as the file describes it.
        machine: BTreeMap<&'static str, String> = machine::rows(proof).into_iter().collect(),
        /// Figures of the motion.
        figures: Vec<FigureRow> = proof.figures().iter().map(|own| FigureRow::of(own, proof)).collect(),
        /// Checks of the analytic solutions; `engines` has the checks of each engine.
        checks: Vec<CheckRow> = proof.checks.iter().map(|own| CheckRow::of(own, tell)).collect(),
        engines: Vec<Engine> = proof.engines.iter().map(|own| Engine::of(own, tell)).collect(),
        disputes["Vec::is_empty"]: Vec<DisputeRow> = proof.disputes.iter().map(DisputeRow::of).collect(),
        diagnosis["Option::is_none"]: Option<DiagnosisRow> = found.map(DiagnosisRow::of),
        /// Whether the search for the diagnosis stopped at its limit of work.
        diagnosis_cut["std::ops::Not::not"]: bool = proof.diagnosis_is_cut,
        recording["Option::is_none"]: Option<String> = recording,
        /// The parts of the mechanism on which no requested channel depends.
        left_out: Left = Left::of(left),
        /// The work of each part of the proof.
        work: Vec<Part> = proof.work.iter().map(Part::of).collect(),
    }

    struct FigureRow = |own: &ReportedFigure, proof: &Proof| {
        let run = &proof.reference_trajectory;
    } {
        /// The figure in the notation of sweeps and scenario files.
        figure: String = own.figure.clone(),
        words: String = own.label.clone(),
        value: f64 = own.value,
        unit: String = own.unit.clone(),
        /// Instants at which the figure occurs: time (s) and input.
        at: Vec<Keyed> = own.rows.iter().map(|row| {
            let mut at = keyed("", run.told(*row));
            at.insert("t_s".into(), run.times()[*row]);
            at
        }).collect(),
    }

    struct Left = |left: &LeftOut| {} {
        links: Vec<String> = left.links.clone(),
        joints: Vec<String> = left.joints.clone(),
        drives: Vec<String> = left.drives.clone(),
        loads: usize = left.loads,
    }

    struct Part = |entry: &LedgerEntry| {
        let counts = |work: &Work| work.iter().map(|(what, times)| (what.name(), times)).collect();
    } {
        part: String = entry.part.clone(),
        why: &'static str = entry.why,
        /// Exact counts by name; `null` for parts that were not needed.
        counts: Option<BTreeMap<&'static str, u64>> = entry.work.as_ref().map(counts),
    }

    struct Reference = |name: &'static str, times: &[f64]| {} {
        name: &'static str = name,
        samples: usize = times.len(),
        from_s: f64 = times.first().copied().unwrap_or(0.0),
        to_s: f64 = times.last().copied().unwrap_or(0.0),
    }

    struct Engine = |proof: &EngineProof, tell: Tell| {
        let info = &proof.info;
        let resolution = Some(info.settings.resolution);
        let own = proof.own_forces.as_ref();
    } {
        name: &'static str = info.name,
        version: String = info.version.clone(),
        dt_s["Option::is_none"]: Option<f64> = resolution.filter(|_| !info.controls_error),
        accuracy["Option::is_none"]: Option<f64> = resolution.filter(|_| info.controls_error),
        settings: Words = info.told.iter().cloned().collect(),
        /// The search for settings; omitted if all settings were given.
        search["Option::is_none"]: Option<SearchRow> = proof.search.as_ref().map(|own| SearchRow::of(own, info)),
        provides: Words = info.provides.iter().map(|(stage, how)| (*stage, provision(how))).collect(),
        verdict: &'static str = proof.verdict.word(),
        reason: Option<String> = proof.verdict.reason(tell),
        channels: Vec<Channel> = proof.channels.iter().map(|own| Channel::of(info, own, tell)).collect(),
        /// Forces that the engine itself exerts.
        /// They are judged in addition to the forces of `channels`, which are computed from the engine's motion.
        own_forces["Option::is_none"]: Option<OwnForcesRow> = own.map(|own| OwnForcesRow::of(proof, own, tell)),
        checks: Vec<CheckRow> = proof.checks.iter().map(|own| CheckRow::of(own, tell)).collect(),
        failure["Option::is_none"]: Option<String> = proof.failure.as_ref().map(|error| error.message().to_string()),
    }

    struct OwnForcesRow = |engine: &EngineProof, own: &EngineProof, tell: Tell| {
        let info = &own.info;
    } {
        route: &'static str = info.settings.route.name(),
        dt_s: f64 = info.settings.resolution,
        settings: Words = info.told.iter().cloned().collect(),
        search["Option::is_none"]: Option<SearchRow> = own.search.as_ref().map(|own| SearchRow::of(own, info)),
        verdict: &'static str = own.verdict.word(),
        reason: Option<String> = own.verdict.reason(tell),
        /// Which forces disagree: those from the motion (`reading`), those that the engine exerts (`exerted`), or both.
        fault: Option<&'static str> = engine.force_fault().map(|fault| match fault {
            ForceFault::Reading => "reading",
            ForceFault::Exerted => "exerted",
            ForceFault::Both => "both",
        }),
        channels: Vec<Channel> = own.channels.iter().map(|own| Channel::of(info, own, tell)).collect(),
        failure["Option::is_none"]: Option<String> = own.failure.as_ref().map(|error| error.message().to_string()),
    }

    struct SearchRow = |search: &SettingsSearch, info: &EngineInfo| {} {
        runs: usize = search.runs,
        effort_steps: f64 = search.effort,
        budget_steps: f64 = search.budget,
        end: &'static str = match search.end {
            SearchEnd::Decided => "decided",
            SearchEnd::Rounding => "rounding",
            SearchEnd::Budget => "budget",
            SearchEnd::Pace => "pace",
            SearchEnd::Nothing => sentences::NOTHING_LEFT_TO_CHOOSE,
        },
        extrapolated_times: usize = info.settings.extrapolated,
    }

    struct DisputeRow = |dispute: &Dispute| {} {
        channel: String = dispute.channel.clone(),
        pairs: Vec<[&'static str; 2]> = dispute.pairs.clone(),
        odd_one_out: Option<&'static str> = dispute.odd,
    }

    /// A diagnosis in the JSON report.
    pub struct DiagnosisRow = |diagnosis: &Diagnosis| {} {
        suspect: String = diagnosis.suspect.clone(),
        /// The party that disagrees with all other parties; `null` if no such party exists.
        alone: Option<String> = match &diagnosis.alone {
            PartyStanding::Alone(name) => Some(name.clone()),
            PartyStanding::Together | PartyStanding::Camps(_) | PartyStanding::Open(_) => None,
        },
        /// A sentence on the agreement of all parties.
        standing: String = standing(&diagnosis.alone),
        /// The channels that exceed their bounds, the earliest first.
        since: Vec<SinceRow> = diagnosis.since.iter().map(SinceRow::of).collect(),
        /// The cause in words; `null` if no simple cause explains any channel.
        cause: Option<String> = diagnosis.cause.as_ref().map(cause),
        /// Description of the error, if no cause explains all of it.
        error: Option<String> = diagnosis.nature.map(nature),
        /// Whether the cause explains all channels.
        explained: bool = diagnosis.is_explained(),
        /// Causes other than `cause` that explain as much as `cause`.
        also: Vec<String> = diagnosis.also.iter().map(cause).collect(),
        left_over: Vec<String> = diagnosis.left_over.iter().map(ToString::to_string).collect(),
        cases_tried: usize = diagnosis.solved,
    }

    struct SinceRow = |one: &Since| {} {
        channel: String = one.channel.to_string(),
        t_s: f64 = one.time,
        #[serde(flatten)]
        at: Keyed = keyed("", one.input.at(one.crank)),
        difference: f64 = one.difference,
        bound: f64 = one.bound,
        instants_beyond: usize = one.beyond,
    }

    struct Channel = |info: &EngineInfo, proof: &ChannelProof, tell: Tell| {
        let residual = &proof.residual;
        let stage = residual.channel.kind.stage.name();
        let source = info.provides.iter().find(|(own, _)| *own == stage).map(|(_, how)| provision(how));
    } {
        channel: String = residual.channel.to_string(),
        unit: &'static str = residual.channel.kind.unit.symbol(),
        /// Source of the engine's values.
        source: String = source.unwrap_or_default(),
        scale: f64 = residual.scale,
        max: f64 = residual.max,
        rms: f64 = residual.rms,
        q75: f64 = residual.q75,
        q99: f64 = residual.q99,
        bound: f64 = proof.bound,
        discretisation: f64 = proof.parts.discretisation,
        iteration: f64 = proof.parts.iteration,
        rounding: f64 = proof.parts.rounding,
        /// Error of the reference itself.
        reference: f64 = proof.parts.reference,
        /// Origin of the bound in one word, and its justification.
        origin: &'static str = proof.basis.origin().word(),
        basis: String = proof.basis.to_string(),
        verdict: &'static str = proof.verdict.word(),
        reason: Option<String> = proof.verdict.reason(tell),
        observed_order: f64 = proof.convergence.observed,
        limit: Option<f64> = proof.limit,
        worst_t_s: f64 = residual.worst_time,
        #[serde(flatten)]
        worst: Keyed = keyed("worst_", residual.input.at(residual.worst_crank)),
        /// Number of instants that are not judged: a drive or a loaded link reverses there, an acceleration or its rate
        /// jumps, the mechanism passes a change point, or a free motion begins.
        left_out: usize = proof.left_out,
    }

    struct CheckRow = |check: &Check, tell: Tell| {
        let expected = match &check.verdict {
            Verdict::Expected { finding, off } => Some((finding.clone(), *off)),
            Verdict::Agree { .. } | Verdict::Disagree { .. } | Verdict::Inconclusive { .. } => None,
        };
        let (finding, printed_off) = expected.unzip();
    } {
        name: String = check.name(),
        value: f64 = check.value,
        bound: f64 = check.bound,
        unit: &'static str = check.unit,
        /// Origin of the bound in one word, and its justification.
        origin: &'static str = check.basis.origin().word(),
        basis: String = check.basis.to_string(),
        verdict: &'static str = check.verdict.word(),
        reason: Option<String> = check.verdict.reason(tell),
        finding["Option::is_none"]: Option<String> = finding,
        /// Residual of the printed number that a finding calls wrong; `value` is the residual of the corrected number.
        printed_off["Option::is_none"]: Option<f64> = printed_off,
    }
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
    /// An entry for each error of a file, and a last entry with the number of errors that are not shown.
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
    /// An empty document. The advice in this document does not name command-line options.
    #[must_use]
    pub fn new() -> Self {
        Document::told_by(Advice::to_string)
    }

    /// An empty document; `tell` puts its advice into words.
    #[must_use]
    pub fn told_by(tell: Tell) -> Self {
        Document { schema: 2, runs: Vec::new(), errors: Vec::new(), tell }
    }

    /// Adds a proof and the path of its recording, if one was written.
    pub fn add(&mut self, proof: &Proof, recording: Option<String>) {
        self.runs.push(Run::of(proof, recording, self.tell));
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

/// How a channel is provided, in words.
#[must_use]
pub fn provision(provision: &Provision) -> String {
    match provision {
        Provision::Computed => "read".into(),
        Provision::Derived(how) => format!("derived: {how}"),
    }
}
