//! One model of what a proof has judged, for tables, test reports, logs and pages: every channel, every force that an
//! engine exerts itself, every check.

use prover::compare::Verdict;
use prover::proof::{ChannelProof, EngineProof, Proof};

/// What is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sort {
    /// A channel of an engine.
    Channel,
    /// A force as an engine itself exerts it.
    OwnForce,
    /// A check of a side or of an engine.
    Check,
}

/// A number with its bound and its verdict.
pub struct Judged<'a> {
    pub sort: Sort,
    /// The engine; `None` where the analytic sides are judged.
    pub engine: Option<&'a EngineProof>,
    /// Without the name of the engine.
    pub name: String,
    pub value: f64,
    pub bound: f64,
    pub unit: &'static str,
    /// Why the bound is what it is.
    pub basis: String,
    pub verdict: &'a Verdict,
    /// Instant (s) at which a channel is worst.
    pub worst: Option<f64>,
}

/// All that is judged: checks of the sides, then for each engine its channels, the forces that it exerts itself, and its
/// checks.
pub fn of(proof: &Proof) -> Vec<Judged<'_>> {
    let mut all = Vec::new();
    checks(None, proof, &mut all);
    for engine in &proof.engines {
        all.extend(of_engine(engine));
        checks(Some(engine), proof, &mut all);
    }
    all
}

/// The same, checks behind all else.
pub fn checks_last(proof: &Proof) -> Vec<Judged<'_>> {
    let mut all = of(proof);
    all.sort_by_key(|own| own.sort == Sort::Check);
    all
}

/// Channels of an engine, and the forces that it exerts itself.
pub fn of_engine(engine: &EngineProof) -> impl Iterator<Item = Judged<'_>> {
    let channels = engine.channels.iter().map(|own| (Sort::Channel, own));
    let forces = engine.own_forces.iter().flat_map(|own| &own.channels).map(|own| (Sort::OwnForce, own));
    channels.chain(forces).map(move |(sort, own)| channel(sort, engine, own))
}

fn channel<'a>(sort: Sort, engine: &'a EngineProof, own: &'a ChannelProof) -> Judged<'a> {
    let ChannelProof { residual, bound, basis, verdict, .. } = own;
    let name = residual.channel.to_string();
    let name = if sort == Sort::OwnForce { format!("{name} as the engine exerts it") } else { name };
    let (value, unit) = (residual.max, residual.channel.kind.unit.symbol());
    Judged {
        sort,
        engine: Some(engine),
        name,
        value,
        bound: *bound,
        unit,
        basis: basis.to_string(),
        verdict,
        worst: Some(residual.worst_time),
    }
}

fn checks<'a>(engine: Option<&'a EngineProof>, proof: &'a Proof, all: &mut Vec<Judged<'a>>) {
    let own = engine.map_or(&proof.checks, |engine| &engine.checks);
    all.extend(own.iter().map(|check| Judged {
        sort: Sort::Check,
        engine,
        name: check.name(),
        value: check.value,
        bound: check.bound,
        unit: check.unit,
        basis: check.basis.to_string(),
        verdict: &check.verdict,
        worst: None,
    }));
}
