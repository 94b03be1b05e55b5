//! Forces as an engine itself exerts them, beside those that follow from its motion.

use std::fmt::Write;

use super::cells::used;
use super::text::{channels, found, seconds};
use crate::proof::{ChannelProof, EngineProof, ForceFault, OwnForces};
use linkage::solver::Provision;
use linkage::trajectory::Stage;

/// Name of a channel as the engine itself exerts it.
pub(super) fn name(channel: &ChannelProof) -> String {
    format!("{} as the engine exerts it", channel.residual.channel)
}

/// Name of all of them.
pub(super) fn of_all(engine: &EngineProof, several: bool) -> String {
    if several {
        format!("forces as {} itself exerts them", engine.info.name)
    } else {
        "the engine's own forces".into()
    }
}

/// The section on an engine's own forces, after the table of its channels: a table, or a line beside `several` engines.
pub(super) fn section(engine: &EngineProof, several: bool, text: &mut String) {
    let Some(own) = &engine.own_forces else { return };
    let route = own.info.settings.route.name();
    match &own.failure {
        Some(error) => {
            let _ = writeln!(
                text,
                "\nForces as {} itself exerts them (route {route}) failed: {}",
                engine.info.name,
                error.message()
            );
        }
        None if several => {
            let _ =
                writeln!(text, "\nForces as {} itself exerts them (route {route}): {}", engine.info.name, line(own));
        }
        None => {
            let _ = writeln!(text, "\nThe forces above: {}.", source(engine));
            let _ = writeln!(text, "Forces as the engine itself exerts them, by {}", how(own));
            let _ = writeln!(text, "{}", channels(&own.channels));
        }
    }
    if let Some(fault) = engine.force_fault() {
        let _ = writeln!(text, "\n{}", sentence(fault));
    }
}

/// Where the forces among an engine's channels come from.
fn source(engine: &EngineProof) -> &str {
    let own = engine.info.provides.iter().find(|(stage, _)| *stage == Stage::Reactions.name());
    match own {
        Some((_, Provision::Derived(how))) => how,
        Some((_, Provision::Computed)) | None => "read",
    }
}

/// Route, settings and work.
fn how(own: &OwnForces) -> String {
    let settings = &own.info.settings;
    let told = own.info.told.iter().find(|(name, _)| *name == "reactions");
    let told = told.map_or_else(|| settings.route.name().to_string(), |(_, told)| told.clone());
    let step = seconds(settings.resolution);
    let search = own.search.as_ref().map(|search| found(&own.info, search)).unwrap_or_default();
    format!("{told}\n(route {}, step {step} s; {search}):", settings.route.name())
}

/// Verdict, and the channel that uses most of its bound.
fn line(own: &OwnForces) -> String {
    let Some(worst) = own.channels.iter().max_by(|a, b| used(a).total_cmp(&used(b))) else { return "none".into() };
    let (residual, unit) = (&worst.residual, worst.residual.channel.kind.unit);
    let numbers = format!("{:.1e} {unit} of {:.1e} {unit} in {}", residual.max, worst.bound, residual.channel);
    format!("{} channels {}, at most {numbers}", own.channels.len(), own.verdict.word())
}

fn sentence(fault: ForceFault) -> &'static str {
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
