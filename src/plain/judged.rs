//! The model behind every report of a proof.
//! The model contains each channel, each force that an engine itself exerts, and each check, with its verdict.
//! Text, JSON, JUnit, Markdown, logs and pages all use these verdicts.

use crate::sentences;
use std::cmp::{Ordering, Reverse};

use linkage::math::statistics::share;
use prover::bounds::{Check, Verdict};
use prover::run::{ChannelProof, EngineProof, Proof};

linkage::words! {
    /// Grade of a verdict; the most serious comes last.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Grade: capitals {
        /// The numbers agree, or a printed number is wrong as expected.
        Agree = "AGREE",
        /// Inconclusive.
        Open = "INCONCLUSIVE",
        /// The numbers disagree.
        Disagree = "DISAGREE",
    }
}

impl Grade {
    /// Selects the value for this grade from three values, which have the order of the grades.
    pub(crate) fn of<T>(self, [agree, open, disagree]: [T; 3]) -> T {
        match self {
            Grade::Agree => agree,
            Grade::Open => open,
            Grade::Disagree => disagree,
        }
    }
}

/// Grade of a verdict.
#[must_use]
pub fn grade(verdict: &Verdict) -> Grade {
    match verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => Grade::Agree,
        Verdict::Inconclusive { .. } => Grade::Open,
        Verdict::Disagree { .. } => Grade::Disagree,
    }
}

/// Numbers of verdicts of four kinds: agree, wrong as expected, disagree, open.
pub fn counts<'a>(verdicts: impl IntoIterator<Item = &'a Verdict>) -> [usize; 4] {
    let mut counts = [0; 4];
    for verdict in verdicts {
        counts[match verdict {
            Verdict::Agree { .. } => 0,
            Verdict::Expected { .. } => 1,
            Verdict::Disagree { .. } => 2,
            Verdict::Inconclusive { .. } => 3,
        }] += 1;
    }
    counts
}

/// Kind of a judged number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sort {
    /// A channel of an engine.
    Channel,
    /// A force that an engine itself exerts.
    OwnForce,
    /// A check of a side or of an engine.
    Check,
}

/// A number with its bound and its verdict.
pub struct JudgedNumber<'a> {
    pub sort: Sort,
    /// The engine; `None` for a check of the analytic sides.
    pub engine: Option<&'a EngineProof>,
    /// The name of the number, without the name of the engine.
    pub name: String,
    pub value: f64,
    pub bound: f64,
    pub unit: &'static str,
    /// Origin of the bound.
    pub basis: String,
    pub verdict: &'a Verdict,
    /// Instant (s) at which the channel's ratio of error to bound is largest.
    pub worst: Option<f64>,
}

/// All judged numbers of a proof: first the checks of the analytic sides.
/// Then for each engine its channels, the forces that it exerts itself, and its checks.
pub fn of(proof: &Proof) -> Vec<JudgedNumber<'_>> {
    let of_engine = |engine| of_engine(engine).chain(checks(Some(engine), &engine.checks));
    checks(None, &proof.checks).chain(proof.engines.iter().flat_map(of_engine)).collect()
}

/// Channels of an engine, and the forces that it exerts itself.
fn of_engine(engine: &EngineProof) -> impl Iterator<Item = JudgedNumber<'_>> {
    let channels = engine.channels.iter().map(|own| (Sort::Channel, own));
    let forces = engine.own_forces.iter().flat_map(|own| &own.channels).map(|own| (Sort::OwnForce, own));
    channels.chain(forces).map(|(sort, own)| {
        let ChannelProof { residual, bound, basis, verdict, .. } = own;
        let how = if sort == Sort::OwnForce { sentences::AS_THE_ENGINE_EXERTS_IT } else { "" };
        JudgedNumber {
            sort,
            engine: Some(engine),
            name: format!("{}{how}", residual.channel),
            value: residual.max,
            bound: *bound,
            unit: residual.channel.kind.unit.symbol(),
            basis: basis.to_string(),
            verdict,
            worst: Some(residual.worst_time),
        }
    })
}

fn checks<'a>(engine: Option<&'a EngineProof>, checks: &'a [Check]) -> impl Iterator<Item = JudgedNumber<'a>> {
    checks.iter().map(move |check| JudgedNumber {
        sort: Sort::Check,
        engine,
        name: check.name(),
        value: check.value,
        bound: check.bound,
        unit: check.unit,
        basis: check.basis.to_string(),
        verdict: &check.verdict,
        worst: None,
    })
}

/// All verdicts of a proof by name: channels, forces that engines exert themselves, and checks.
pub fn verdicts(proof: &Proof) -> Vec<(String, &Verdict)> {
    let several = proof.engines.len() > 1;
    // An engine without a valid run has no channels, so the verdict of the engine itself is listed.
    let without_run = proof.engines.iter().filter(|engine| engine.channels.is_empty() && engine.failure.is_none());
    let mut all: Vec<_> = without_run.map(|engine| (engine.info.name.to_string(), &engine.verdict)).collect();
    for engine in &proof.engines {
        let name = |name: String| if several { format!("{name} ({})", engine.info.name) } else { name };
        all.extend(of_engine(engine).map(|own| (name(own.name), own.verdict)));
        let failed = engine.own_forces.iter().filter(|own| own.failure.is_some());
        let whole = match several {
            true => sentences::forces_as_itself_exerts_them_2(&engine.info.name),
            false => sentences::THE_ENGINE_OWN_FORCES.into(),
        };
        all.extend(failed.map(|own| (whole.clone(), &own.verdict)));
    }
    all.extend(proof.all_checks().map(|check| (check.name(), &check.verdict)));
    all
}

/// All verdicts that disagree or are open, the most serious first.
pub fn unproven(proof: &Proof) -> Vec<(String, &Verdict)> {
    let mut all = verdicts(proof);
    all.retain(|(_, verdict)| grade(verdict) != Grade::Agree);
    all.sort_by_key(|(_, verdict)| Reverse(grade(verdict)));
    all
}

/// All channels of all engines: first those that disagree, then those that are open, then those that agree.
/// Each of these three sets is sorted by descending ratio of error to bound.
pub fn ranked(proof: &Proof) -> Vec<(&EngineProof, &ChannelProof)> {
    let engines = proof.engines.iter();
    let mut all: Vec<_> = engines.flat_map(|engine| engine.channels.iter().map(move |own| (engine, own))).collect();
    all.sort_by(|(_, a), (_, b)| by_rank(b, a));
    all
}

/// The worst channel: the first one in the order of [`ranked`].
pub fn worst<'a>(channels: impl IntoIterator<Item = &'a ChannelProof>) -> Option<&'a ChannelProof> {
    channels.into_iter().max_by(|a, b| by_rank(a, b))
}

/// Order of two channels: by the grade of the verdict, then by the ratio of error to bound.
fn by_rank(a: &ChannelProof, b: &ChannelProof) -> Ordering {
    let used = |own: &ChannelProof| share(own.residual.max, own.bound);
    grade(&a.verdict).cmp(&grade(&b.verdict)).then(used(a).total_cmp(&used(b)))
}
