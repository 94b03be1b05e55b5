//! Forces as an engine itself exerts them, beside those that follow from its motion.

use super::cells::used;
use linkage::solver::Provision;
use linkage::trajectory::Stage;
use prover::numbers;

use prover::proof::{EngineProof, ForceFault};

/// Name of all of them.
pub fn of_all(engine: &EngineProof, several: bool) -> String {
    if several {
        format!("forces as {} itself exerts them", engine.info.name)
    } else {
        "the engine's own forces".into()
    }
}

/// Where the forces among an engine's channels come from.
pub fn source(engine: &EngineProof) -> &str {
    let own = engine.info.provides.iter().find(|(stage, _)| *stage == Stage::Reactions.name());
    match own {
        Some((_, Provision::Derived(how))) => how,
        Some((_, Provision::Computed)) | None => "read",
    }
}

/// Verdict, and the channel that uses most of its bound.
pub fn line(own: &EngineProof) -> String {
    let Some(worst) = own.channels.iter().max_by(|a, b| used(a).total_cmp(&used(b))) else { return "none".into() };
    let (residual, unit) = (&worst.residual, worst.residual.channel.kind.unit);
    let [error, bound] = [residual.max, worst.bound].map(|value| numbers::error_in(value, unit.symbol()));
    let numbers = format!("{error} of {bound} in {}", residual.channel);
    format!("{} channels {}, at most {numbers}", own.channels.len(), own.verdict.word())
}

/// What the two judgements say together.
pub fn sentence(fault: ForceFault) -> &'static str {
    match fault {
        ForceFault::Reading => {
            "The engine's motion and the forces that it exerts agree: wrong are the forces that Newton and Euler's \
             equations make of this motion."
        }
        ForceFault::Exerted => {
            "The engine's motion and the forces that belong to it agree: wrong are those that it exerts itself, or how \
             they are read."
        }
        ForceFault::Both => "The motion agrees, and the forces disagree in both ways: from the motion and as exerted.",
    }
}
