//! Settings confirmed by a proof.
//! The error measured against the reference may be small by chance.
//! A small error is also possible if the engine's runs show no order of convergence.
//! A proof at such settings may not agree.

use linkage::engine::Engine;
use linkage::error::{Advice, Result};
use linkage::trajectory::Channel;

use super::bench::Bench;
use super::candidate::{Candidate, Measured};
use prover::bounds::Verdict;
use prover::run::{EngineProof, Options, Reference, prove};
use scenario::Scenario;

/// Largest number of refinements.
const MOST: usize = 16;
/// Factor of the step from one trial to the next.
/// `TIGHTER` is the factor of the accuracy, for an engine that chooses its steps itself.
const FINER: f64 = 0.7;
const TIGHTER: f64 = 0.1;

/// Refines the candidate as little as necessary until a proof confirms its settings.
/// If no refined settings are confirmed, the unchanged candidate is returned, marked as unproven.
///
/// # Errors
/// The errors of [`prove`].
pub(super) fn confirmed(
    bench: &mut Bench,
    scenario: &Scenario,
    engine: &dyn Engine,
    candidate: Candidate,
    (within, reference): (f64, Reference),
) -> Result<Candidate> {
    let mut now = candidate.clone();
    for _ in 0..MOST {
        // The settings are given, so there is no search, and the smallest budget is enough.
        let options = Options::exactly(engine.with(now.settings).as_ref());
        let Some(options) = options.map(|options| options.reference(reference).budget(1.0)) else { break };
        let proof = prove(scenario, &options)?;
        let is_exact = now.verified <= within;
        match open(proof.engine(), bench.wanted, scenario) {
            None if is_exact => return Ok(Candidate { is_proven: true, ..now }),
            Some(advice)
                if advice.iter().any(|one| matches!(one, Advice::MoreSweeps { .. })) && now.settings.sweeps > 0 =>
            {
                now.settings.sweeps *= 2;
            }
            Some(_) | None => now.settings.resolution *= if now.controls_error { TIGHTER } else { FINER },
        }
        let Measured { error, worst, price } = bench.measure(engine, now.settings);
        if !price.is_finite() {
            break;
        }
        (now.verified, now.worst, now.price) = (error, worst, price);
    }
    Ok(candidate)
}

/// Advice for the requested channels that the proof does not confirm.
/// If all channels are requested, the advice of the proof's checks is included.
/// `None` if all these channels and checks agree.
fn open(proof: &EngineProof, wanted: &[Channel], scenario: &Scenario) -> Option<Vec<Advice>> {
    if proof.channels.is_empty() {
        return Some(Vec::new());
    }
    let channels = proof.channels.iter().filter(|own| wanted.contains(&own.residual.channel)).map(|own| &own.verdict);
    let is_all = wanted.len() == scenario.case.channels().len();
    let checks = proof.checks.iter().filter(|_| is_all).map(|check| &check.verdict);
    let of = |verdict: &Verdict| match verdict {
        Verdict::Agree { .. } | Verdict::Expected { .. } => None,
        Verdict::Disagree { .. } => Some(Vec::new()),
        Verdict::Inconclusive { advice, .. } => Some(advice.clone()),
    };
    let all: Vec<Vec<Advice>> = channels.chain(checks).filter_map(of).collect();
    (!all.is_empty()).then(|| all.concat())
}
