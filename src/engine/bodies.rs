//! What engines ask of links because they integrate bodies.

use crate::case::Case;
use crate::error::{Error, ErrorKind, Result};

/// Checks that every link has a mass and a moment of inertia. Under forces no stand-in will do: it would change the motion. `software`: what the engine's
/// users know it by.
///
/// # Errors
/// [`ErrorKind::Unsupported`] with the first link that lacks one of them.
pub(super) fn check_inertias(case: &Case, software: &str) -> Result<()> {
    let Some(bare) = case.mechanism.links()[1..].iter().find(|link| !(link.mass > 0.0 && link.inertia > 0.0)) else {
        return Ok(());
    };
    let message =
        format!("link \"{}\" has no mass or no moment of inertia: {software} cannot move it under forces", bare.name);
    Err(Error::new(ErrorKind::Unsupported, message)
        .key(format!("links.{}", bare.name))
        .help("give every link both, or solve the scenario with `linkproof solve --with newton`"))
}
