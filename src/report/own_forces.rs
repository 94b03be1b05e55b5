//! Forces as an engine itself exerts them, beside those that follow from its motion.

use std::fmt::Write;

use super::text::{channels, found, seconds};
use crate::proof::EngineProof;

/// The section on an engine's own forces, after the table of its channels.
pub(super) fn section(engine: &EngineProof, several: bool, text: &mut String) {
    let Some(own) = &engine.own_forces else { return };
    let name = if several { format!(" {}", engine.info.name) } else { " the engine".into() };
    let route = own.info.settings.route.name();
    let _ = writeln!(text, "\nForces as{name} itself exerts them (route {route}, step {} s):", seconds(own.info.settings.resolution));
    match (&own.failure, &own.search) {
        (Some(error), _) => {
            let _ = writeln!(text, "failed: {}", error.message());
        }
        (None, search) => {
            if let Some(search) = search {
                let _ = writeln!(text, "{}", found(&own.info, search));
            }
            let _ = writeln!(text, "{}", channels(&own.channels));
        }
    }
}
